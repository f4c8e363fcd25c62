#pragma once

#include <functional>
#include <string>

#include <Eigen/Core>
#include <Eigen/SparseCore>

#include "core/base/points.hpp"

namespace perifrac {

/// The product of a stiffness with a vector.
using StiffnessTimes = std::function<Eigen::VectorXd(const Eigen::VectorXd&)>;

/// Says in words which translation or rotation of the whole body costs no energy, or nothing where
/// the boundary resists them all. `stiffness` is applied to the free unknowns, which
/// `free_unknowns` takes to all: D blocks of point displacements, then face values. The last
/// `plates` of them are rigid plates, which follow no rotation but any translation.
template <int D>
std::string rigid_motion_without_energy(const Points<D>& points, const StiffnessTimes& stiffness,
                                        const Eigen::SparseMatrix<double>& free_unknowns,
                                        Eigen::Index plates);

}  // namespace perifrac
