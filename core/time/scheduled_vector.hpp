#pragma once

#include <algorithm>
#include <utility>
#include <vector>

#include <Eigen/Core>
#include <Eigen/SparseCore>

#include "core/time/schedule.hpp"

namespace perifrac {

/// A sum of vectors, each multiplied by a schedule of its own: what a boundary prescribes on all
/// unknowns at a time. Zeros, as most are, take no room.
class ScheduledVector {
 public:
  explicit ScheduledVector(Eigen::Index size) : constant_(size) {}

  void add(const Schedule& schedule, const Eigen::VectorXd& vector) {
    add(schedule, Entries(vector.sparseView()));
  }

  /// Adds matrix * other.
  void add(const Eigen::SparseMatrix<double>& matrix, const ScheduledVector& other) {
    constant_ += matrix * other.constant_;
    for (const auto& [schedule, vector] : other.parts_) add(schedule, Entries(matrix * vector));
  }

  Eigen::Index size() const { return constant_.size(); }
  bool is_constant() const { return parts_.empty(); }
  /// Other than 0 at some time.
  bool is_anything() const { return constant_.nonZeros() > 0 || !parts_.empty(); }

  /// The entry is other than 0 at some time.
  bool has(Eigen::Index entry) const {
    const auto is_there = [&](const Entries& entries) { return entries.coeff(entry) != 0.0; };
    return is_there(constant_) ||
           std::ranges::any_of(parts_, [&](const auto& part) { return is_there(part.second); });
  }

  /// Of all its schedules, sorted [s].
  std::vector<double> break_points() const {
    std::vector<double> all;
    for (const auto& [schedule, vector] : parts_) {
      all.insert(all.end(), schedule.break_points().begin(), schedule.break_points().end());
    }
    std::ranges::sort(all);
    all.erase(std::unique(all.begin(), all.end()), all.end());
    return all;
  }

  /// `sum`, of the right size already, at time t [s].
  void at(double t, Eigen::VectorXd& sum) const {
    sum = constant_;
    for (const auto& [schedule, vector] : parts_) sum += schedule.factor(t) * vector;
  }

  Eigen::VectorXd at(double t) const {
    Eigen::VectorXd sum(size());
    at(t, sum);
    return sum;
  }

 private:
  using Entries = Eigen::SparseVector<double>;

  void add(const Schedule& schedule, const Entries& entries) {
    if (schedule.is_constant()) {
      constant_ += entries;
    } else {
      parts_.emplace_back(schedule, entries);
    }
  }

  Entries constant_;
  std::vector<std::pair<Schedule, Entries>> parts_;
};

}  // namespace perifrac
