#pragma once

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <limits>
#include <vector>

#include <Eigen/Core>
#include <Eigen/SparseCore>

#include "core/solvers/sparse_cholesky.hpp"
#include "core/time/ode_system.hpp"

namespace perifrac::test {

/// Content z_i of uneven cells along a line, whose pressure (z - a t)/s_i drives flow between
/// neighbours, and out of the first cell into the last unknown: V z + outflow is conserved.
class LineDiffusion : public OdeSystem {
 public:
  explicit LineDiffusion(std::size_t cells, double conductance = 1.0) {
    for (std::size_t i = 0; i < cells; ++i) {
      volume.push_back(1.0 + 0.5 * std::sin(3.0 * static_cast<double>(i)));
      storage.push_back(1.0 + 0.3 * std::cos(5.0 * static_cast<double>(i)));
      link.push_back(conductance * (1.5 + std::sin(7.0 * static_cast<double>(i))));
    }
  }

  std::string_view name() const override { return "line/content"; }
  std::size_t size() const override { return volume.size() + 1; }
  std::size_t accumulators() const override { return 1; }
  std::uint64_t jacobian_version() const override { return version; }

  void rhs(double t, std::span<const double> y, std::span<double> dydt) override {
    flow(y, t, dydt);
    if (t >= poisoned_from) dydt[2] = std::numeric_limits<double>::quiet_NaN();
  }
  void jacobian_times(double, std::span<const double>, std::span<const double> v,
                      std::span<double> product) override {
    ++products;
    flow(v, 0.0, product);
  }

  void magnitudes(double, std::span<const double>, std::span<double> magnitude) override {
    std::fill(magnitude.begin(), magnitude.end() - 1, scale);
    magnitude.back() = std::numeric_limits<double>::infinity();
  }

  std::vector<double> start() const {
    std::vector<double> y(size(), 0.0);
    for (std::size_t i = 0; i + 1 < size(); ++i)
      y[i] = 1.0 + 0.5 * std::cos(static_cast<double>(i * i));
    return y;
  }

  double invariant(std::span<const double> y) const {
    long double sum = y[volume.size()];
    for (std::size_t i = 0; i < volume.size(); ++i)
      sum += static_cast<long double>(volume[i]) * y[i];
    return static_cast<double>(sum);
  }

  /// J by columns, from the right-hand side alone.
  Eigen::MatrixXd dense_jacobian() {
    Eigen::MatrixXd jacobian(size(), size());
    std::vector<double> unit(size(), 0.0), column(size());
    for (std::size_t j = 0; j < size(); ++j) {
      unit[j] = 1.0;
      flow(unit, 0.0, column);
      jacobian.col(static_cast<Eigen::Index>(j)) =
          Eigen::Map<Eigen::VectorXd>(column.data(), static_cast<Eigen::Index>(size()));
      unit[j] = 0.0;
    }
    return jacobian;
  }

  /// 2 / |largest eigenvalue| of J.
  double stable_step() const;

  /// y(t) from y(0), mode by mode.
  std::vector<double> exact(std::span<const double> y, double t) const;

  std::vector<double> volume, storage, link;  // link[i] joins cell i to cell i - 1 or the outside
  double scale = 1.0;                         // that errors are measured against
  double uptake = 0.0;                        // a
  double poisoned_from = std::numeric_limits<double>::infinity();
  std::uint64_t version = 1;
  int products = 0;

 private:
  void flow(std::span<const double> y, double t, std::span<double> dydt) const {
    const auto pressure = [&](std::size_t i) { return (y[i] - uptake * t) / storage[i]; };
    for (double& value : dydt) value = 0.0;
    for (std::size_t i = 0; i < volume.size(); ++i) {
      const double flux = link[i] * (pressure(i) - (i > 0 ? pressure(i - 1) : 0.0));
      dydt[i] -= flux / volume[i];
      if (i > 0)
        dydt[i - 1] += flux / volume[i - 1];
      else
        dydt[volume.size()] += flux;
    }
  }
};

/// I - gamma J of a LineDiffusion: exactly, by (s V + gamma H) q = V r and z = s q.
class LineCholesky : public NewtonMatrix {
 public:
  explicit LineCholesky(const LineDiffusion& line) : line_(line) {}

  bool exact() const override { return true; }

  void set_up(double, std::span<const double>, double gamma) override {
    const auto n = static_cast<int>(line_.volume.size());
    std::vector<Eigen::Triplet<double>> entries;
    for (int i = 0; i < n; ++i) {
      const auto at = static_cast<std::size_t>(i);
      const double link = gamma * line_.link[at];
      entries.emplace_back(i, i, line_.storage[at] * line_.volume[at] + link);
      if (i == 0) continue;
      entries.emplace_back(i - 1, i - 1, link);
      entries.emplace_back(i, i - 1, -link);
    }
    Eigen::SparseMatrix<double> lower(n, n);
    lower.setFromTriplets(entries.begin(), entries.end());
    cholesky_.factor(lower);
    gamma_ = gamma;
  }

  void solve(std::span<const double> r, std::span<double> solution) override {
    const auto n = static_cast<Eigen::Index>(line_.volume.size());
    const Eigen::Map<const Eigen::ArrayXd> volume(line_.volume.data(), n),
        storage(line_.storage.data(), n), rate(r.data(), n);
    const Eigen::VectorXd b = volume * rate;
    Eigen::VectorXd q(n);
    cholesky_.solve(b, q);
    Eigen::Map<Eigen::ArrayXd>(solution.data(), n) = storage * q.array();
    solution[line_.volume.size()] = r[line_.volume.size()] + gamma_ * line_.link[0] * q[0];
  }

 private:
  const LineDiffusion& line_;
  SparseCholesky cholesky_;
  double gamma_ = 0.0;
};

/// Roughly I - gamma J of a LineDiffusion: every cell by itself, draining into the outflow, so that
/// the invariant is kept.
class LineDiagonal : public NewtonMatrix {
 public:
  explicit LineDiagonal(LineDiffusion& line)
      : line_(line), jacobian_(line.dense_jacobian().diagonal()) {}

  bool exact() const override { return false; }
  void set_up(double, std::span<const double>, double gamma) override { gamma_ = gamma; }
  void solve(std::span<const double> r, std::span<double> solution) override {
    const std::size_t cells = line_.volume.size();
    solution[cells] = r[cells];
    for (std::size_t i = 0; i < cells; ++i) {
      solution[i] = r[i] / (1.0 - gamma_ * jacobian_[static_cast<Eigen::Index>(i)]);
      solution[cells] += line_.volume[i] * (r[i] - solution[i]);
    }
  }

 private:
  const LineDiffusion& line_;
  Eigen::VectorXd jacobian_;
  double gamma_ = 0.0;
};

inline double largest_difference(std::span<const double> a, std::span<const double> b) {
  double largest = 0.0;
  for (std::size_t i = 0; i < a.size(); ++i) largest = std::max(largest, std::abs(a[i] - b[i]));
  return largest;
}

}  // namespace perifrac::test
