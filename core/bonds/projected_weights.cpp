#include "core/bonds/projected_weights.hpp"

#include <algorithm>
#include <cmath>

#include <Eigen/SparseCore>
#include <fmt/format.h>

#include "core/base/errors.hpp"
#include "core/base/small_vector.hpp"
#include "core/bonds/bond_traversal.hpp"
#include "core/bonds/shape_tensor.hpp"
#include "core/solvers/sparse_cholesky.hpp"

namespace perifrac {

namespace {

constexpr double moment_tolerance = 1e-12;  // of the moments, relative to k
constexpr int most_steps = 40;
constexpr double longest_step = 2.0;  // the most that one step may change ln s
constexpr double least_factor = 1e-4, largest_factor = 1e2;

/// Of all factors that give the moments the projection takes those nearest to 1, in the sense of
///   least sum_i sum_j V_i w_ij (s ln s - s + 1),
/// which are s_ij = exp(t . (z_i + parity z_j)), t = (xi, xi xi^T): positive whatever the
/// multipliers z, one a point and moment. The multipliers minimise a convex function; Newton's
/// method finds them.
template <int D>
class MomentProjection {
 public:
  static constexpr int T = D + D * (D + 1) / 2;
  using Moments = std::array<double, T>;

  MomentProjection(Family<D>& family, std::span<const Face> faces, FaceSet mirrored, double horizon)
      : family_(family), plain_(family.weight), length_(horizon), number_(family.point_count, -1) {
    for (Index i = 0; i < family.point_count; ++i) {
      bool complete = true;
      for (std::size_t f = 0; f < faces.size(); ++f) {
        const Face& face = faces[f];
        const double depth = face.direction * (face.coordinate - family.position[face.axis][i]);
        complete = complete && (contains(mirrored, static_cast<int>(f)) || depth >= horizon);
      }
      if (complete) number_[i] = complete_count_++;
    }
  }

  WeightProjection project() {
    WeightProjection done;
    done.complete_points = complete_count_;
    if (complete_count_ == 0) return done;
    target_ = mean_moment();
    const Index size = T * complete_count_;
    Eigen::MatrixXd multiplier = Eigen::MatrixXd::Zero(size, 1), residual(size, 1), step(size, 1);
    SparseCholesky newton;
    while (find_residual(residual) > moment_tolerance) {
      if (++done.steps > most_steps) refuse("do not exist");
      try {
        newton.factor(derivative());
      } catch (const NotPositiveDefinite&) {
        refuse("do not exist");
      }
      newton.solve(residual, step);
      multiplier -= std::min(1.0, longest_step / largest_exponent(step)) * step;
      set_weights(multiplier);
      find_range(done);
    }
    return done;
  }

 private:
  [[noreturn]] static void refuse(const std::string& problem) {
    throw BodyError("the factors that would give its points the moments of a lattice " + problem,
                    "a larger horizon_ratio, a more regular cloud, or weights: plain");
  }

  /// Where no factors would do, those of Newton's steps grow beyond bounds.
  void find_range(WeightProjection& done) const {
    done.least_factor = done.largest_factor = 1.0;
    for (std::size_t bond = 0; bond < plain_.size(); ++bond) {
      const double factor = family_.weight[bond] / plain_[bond];
      done.least_factor = std::min(done.least_factor, factor);
      done.largest_factor = std::max(done.largest_factor, factor);
    }
    if (done.least_factor < least_factor || done.largest_factor > largest_factor) {
      refuse(fmt::format("range from {:.2g} to {:.2g}", done.least_factor, done.largest_factor));
    }
  }

  double mean_moment() const {
    double sum = 0.0, volume = 0.0;
    for (Index i = 0; i < family_.point_count; ++i) {
      if (number_[i] < 0) continue;
      const auto shape = shape_tensor_at(family_, i);
      for (int a = 0; a < D; ++a) sum += family_.volume[i] * shape[a * D + a];
      volume += family_.volume[i];
    }
    return sum / (D * volume * length_ * length_);
  }

  Moments moments_of(const Vector<D>& xi) const {
    Moments t;
    int k = 0;
    for (int a = 0; a < D; ++a) t[k++] = xi[a] / length_;
    for (int a = 0; a < D; ++a) {
      for (int b = a; b < D; ++b) t[k++] = t[a] * t[b];
    }
    return t;
  }

  Vector<D> bond_vector(Index i, Index j) const {
    return vector_at(family_.position, j) - vector_at(family_.position, i);
  }

  Index source_of(Index node) const {
    return node < family_.point_count ? node : family_.ghost_source[node - family_.point_count];
  }

  /// What the multipliers of a bond's other end are taken times. Seen from there the bond's first
  /// moment has changed sign; a ghost's multipliers are its source's, reflected.
  Moments end_signs(Index node) const {
    const bool real = node < family_.point_count;
    const FaceSet faces = real ? 0 : family_.ghost_faces[node - family_.point_count];
    Vector<D> reflected;
    for (int a = 0; a < D; ++a) {
      reflected[a] = contains(faces, 2 * a) != contains(faces, 2 * a + 1) ? -1.0 : 1.0;
    }
    Moments sign;
    int k = 0;
    for (int a = 0; a < D; ++a) sign[k++] = -reflected[a];
    for (int a = 0; a < D; ++a) {
      for (int b = a; b < D; ++b) sign[k++] = reflected[a] * reflected[b];
    }
    return sign;
  }

  /// Calls use(bond, ln s) for every bond of a point.
  template <class Use>
  void for_exponents(const Eigen::MatrixXd& multiplier, Index i, Use&& use) const {
    for (Index bond = family_.offset[i]; bond < family_.offset[i + 1]; ++bond) {
      const Index node = family_.other[bond];
      const Index own = T * number_[i], other = T * number_[source_of(node)];
      const Moments t = moments_of(bond_vector(i, node));
      const Moments sign = end_signs(node);
      double sum = 0.0;
      for (int k = 0; k < T; ++k) {
        const double at_own = own < 0 ? 0.0 : multiplier(own + k);
        const double at_other = other < 0 ? 0.0 : sign[k] * multiplier(other + k);
        sum += t[k] * (at_own + at_other);
      }
      use(bond, sum);
    }
  }

  double largest_exponent(const Eigen::MatrixXd& multiplier) const {
    double largest = 0.0;
    for (Index i = 0; i < family_.point_count; ++i) {
      for_exponents(multiplier, i,
                    [&](Index, double e) { largest = std::max(largest, std::abs(e)); });
    }
    return largest;
  }

  void set_weights(const Eigen::MatrixXd& multiplier) {
    for_each_point(family_.point_count, [&](Index i) {
      for_exponents(multiplier, i, [&](Index bond, double e) {
        family_.weight.set(bond, plain_[bond] * std::exp(e));
      });
    });
  }

  /// What the moments are off, times V_i; returns the largest of them relative to k.
  double find_residual(Eigen::MatrixXd& residual) const {
    double largest = 0.0;
    for (Index i = 0; i < family_.point_count; ++i) {
      if (number_[i] < 0) continue;
      Moments r = sum_over_bonds<T>(family_, i, [&](Index, const Vector<D>& xi, double w) {
        Moments t = moments_of(xi);
        for (double& value : t) value *= w;
        return t;
      });
      for (int a = 0, k = D; a < D; k += D - a++) r[k] -= target_;
      for (int k = 0; k < T; ++k) {
        residual(T * number_[i] + k) = family_.volume[i] * r[k];
        largest = std::max(largest, std::abs(r[k]) / target_);
      }
    }
    return largest;
  }

  /// The derivative of the residual by the multipliers, its lower half: symmetric and positive
  /// definite, as the second derivative of what they minimise.
  Eigen::SparseMatrix<double> derivative() const {
    std::vector<Eigen::Triplet<double>> entries;
    for (Index i = 0; i < family_.point_count; ++i) {
      if (number_[i] < 0) continue;
      const Index row = T * number_[i];
      Moments sign;
      sign.fill(1.0);
      const auto add = [&](Index column, const Moments& t, double c, const Moments& signs) {
        for (int k = 0; k < T; ++k) {
          for (int l = 0; l < (row == column ? k + 1 : T); ++l) {
            entries.emplace_back(row + k, column + l, c * t[k] * t[l] * signs[l]);
          }
        }
      };
      for (Index bond = family_.offset[i]; bond < family_.offset[i + 1]; ++bond) {
        const Index node = family_.other[bond];
        const Moments t = moments_of(bond_vector(i, node));
        const double c = family_.volume[i] * family_.weight[bond];
        add(row, t, c, sign);
        const Index column = T * number_[source_of(node)];
        if (column >= 0 && column <= row) add(column, t, c, end_signs(node));
      }
    }
    Eigen::SparseMatrix<double> matrix(T * complete_count_, T * complete_count_);
    matrix.setFromTriplets(entries.begin(), entries.end());
    return matrix;
  }

  Family<D>& family_;
  const BondWeights plain_;    ///< the weights before
  double length_;              ///< bond vectors are measured in it
  std::vector<Index> number_;  ///< of a complete point, -1 at others
  Index complete_count_ = 0;
  double target_ = 0.0;  ///< k
};

}  // namespace

template <int D>
WeightProjection project_weights(Family<D>& family, std::span<const Face> faces, FaceSet mirrored,
                                 double horizon) {
  return MomentProjection<D>(family, faces, mirrored, horizon).project();
}

template WeightProjection project_weights<2>(Family<2>&, std::span<const Face>, FaceSet, double);
template WeightProjection project_weights<3>(Family<3>&, std::span<const Face>, FaceSet, double);

}  // namespace perifrac
