#pragma once

#include <functional>
#include <span>
#include <string_view>

namespace perifrac {

/// product = J v, both of one length.
using MatrixProduct = std::function<void(std::span<const double> v, std::span<double> product)>;

/// Upper bound of the largest |eigenvalue| of a matrix J of `size` rows by power iteration, of its
/// first `coupled` rows and columns alone: the others must not act on them. The top of a lattice
/// operator's spectrum is crowded: the vector hardly converges, but the growth per iteration does,
/// from below, so the bound adds a margin over the tolerance and what slow convergence hides. A
/// pair of complex eigenvalues makes it go to and fro about their size: what counts is the largest
/// of ten, and, where that does not settle, of many. Throws NumericalError, in the name of the
/// field, where it is not found.
double spectral_radius(std::string_view field, double t, std::size_t size, std::size_t coupled,
                       const MatrixProduct& times);

/// Upper bound of the largest eigenvalue of M^-1 K, of `size` rows, K symmetric, M symmetric and
/// positive definite: by nine steps of Lanczos' method, whose largest value lies below it, and what
/// their rest may add. A mode that they do not see, because a few points alone take part in it,
/// exceeds the bound by few per cent: what stands out more comes out after nine steps however small
/// it was in the first. `times` is K's, `divide` M^-1's. Throws NumericalError, in the name of the
/// field, where it is not found.
double symmetric_spectral_radius(std::string_view field, double t, std::size_t size,
                                 const MatrixProduct& times, const MatrixProduct& divide);
/// The same with masses, M's diagonal.
double symmetric_spectral_radius(std::string_view field, double t, std::span<const double> mass,
                                 const MatrixProduct& times);

}  // namespace perifrac
