#pragma once

#include <span>

#include <Eigen/Core>

#include "core/base/points.hpp"

namespace perifrac {

/// The distance from the diagonal of the entry other than 0 that is farthest from it, rows and
/// columns taken in `order`.
Eigen::Index half_bandwidth(const Eigen::MatrixXd& matrix, std::span<const Index> order);

/// Solves matrix * x = right, of a half bandwidth in that order, by elimination with row exchanges;
/// the work is that of the band.
Eigen::VectorXd solve_band(const Eigen::MatrixXd& matrix, std::span<const Index> order,
                           Eigen::Index half_bandwidth, const Eigen::VectorXd& right);

}  // namespace perifrac
