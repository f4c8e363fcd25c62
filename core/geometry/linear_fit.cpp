#include "core/geometry/linear_fit.hpp"

#include <cmath>
#include <limits>

#include <Eigen/Dense>

#include "core/solvers/symmetric_spectrum.hpp"

namespace perifrac {

namespace {

// Of the reach: a point so near is at the place; one so far has no say, whichever side of the reach
// rounding puts it on; a spread so small says nothing of a gradient.
constexpr double at_the_place = 1e-9;
constexpr double no_say = 1.0 - 1e-6;
constexpr double no_spread = 0.05;

using Offsets = Eigen::MatrixXd;  // a row a point, from the place, over the reach

/// Unit vectors, columns, along which the points spread.
Eigen::MatrixXd spread_directions(const Offsets& offsets) {
  const Eigen::MatrixXd centred = offsets.rowwise() - offsets.colwise().mean();
  const Eigen::MatrixXd covariance = centred.transpose() * centred / double(offsets.rows());
  const auto [spread, directions] = symmetric_spectrum(covariance);
  Eigen::Index dropped = 0;  // eigenvalues rise
  while (dropped < covariance.rows() && spread[dropped] < no_spread * no_spread) {
    ++dropped;
  }
  return directions.rightCols(covariance.rows() - dropped);
}

/// Falls to 0 with its slope at the reach, and is all but infinite at the place.
double trust(double distance) {
  const double inside = std::max(0.0, 1.0 - distance);
  return inside * inside / (distance * distance + 1e-6);
}

}  // namespace

double PlaceWeights::value(std::span<const double> values) const {
  if (points.empty()) return std::numeric_limits<double>::quiet_NaN();
  double sum = 0.0;
  for (std::size_t n = 0; n < points.size(); ++n) sum += weights[n] * values[points[n]];
  return sum;
}

double square_distance(const PointSet& points, std::size_t i, std::span<const double> place) {
  double square = 0.0;
  for (std::size_t a = 0; a < place.size(); ++a) {
    const double along = points.position[a][i] - place[a];
    square += along * along;
  }
  return square;
}

PlaceWeights linear_fit(const PointSet& points, std::span<const Index> chosen,
                        std::span<const double> place, double reach) {
  std::vector<Index> near;
  for (const Index i : chosen) {
    const double square = square_distance(points, i, place);
    if (square < std::pow(at_the_place * reach, 2)) return {{i}, {1.0}};
    if (square < std::pow(no_say * reach, 2)) near.push_back(i);
  }
  if (near.empty()) return {};
  Offsets offsets(near.size(), place.size());
  for (std::size_t n = 0; n < near.size(); ++n) {
    for (std::size_t a = 0; a < place.size(); ++a) {
      offsets(n, a) = (points.position[a][near[n]] - place[a]) / reach;
    }
  }
  const Eigen::MatrixXd directions = spread_directions(offsets);
  Eigen::MatrixXd terms(near.size(), 1 + directions.cols());
  terms.col(0).setOnes();
  terms.rightCols(directions.cols()) = offsets * directions;
  const Eigen::VectorXd trusted = offsets.rowwise().norm().unaryExpr(&trust);
  const Eigen::MatrixXd normal = terms.transpose() * trusted.asDiagonal() * terms;
  // The place is the origin of the offsets: only the constant term is asked for.
  const Eigen::VectorXd row = normal.ldlt().solve(Eigen::VectorXd::Unit(terms.cols(), 0));
  const Eigen::VectorXd weights = trusted.asDiagonal() * (terms * row);
  return {std::move(near), {weights.begin(), weights.end()}};
}

}  // namespace perifrac
