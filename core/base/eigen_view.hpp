#pragma once

#include <span>
#include <vector>

#include <Eigen/Core>

namespace perifrac {

/// Arrays as vectors of Eigen and back, without a copy.
inline Eigen::Map<const Eigen::VectorXd> view(std::span<const double> values) {
  return {values.data(), static_cast<Eigen::Index>(values.size())};
}

inline Eigen::Map<Eigen::VectorXd> view(std::span<double> values) {
  return {values.data(), static_cast<Eigen::Index>(values.size())};
}

inline Eigen::Map<Eigen::VectorXd> view(std::vector<double>& values) {
  return {values.data(), static_cast<Eigen::Index>(values.size())};
}

inline std::span<double> view(Eigen::VectorXd& values) {
  return {values.data(), static_cast<std::size_t>(values.size())};
}

inline std::span<const double> view(const Eigen::VectorXd& values) {
  return {values.data(), static_cast<std::size_t>(values.size())};
}

}  // namespace perifrac
