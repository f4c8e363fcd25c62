#include "modules/solid/equilibrium/learned_slope.hpp"

#include <utility>

#include <Eigen/Cholesky>

namespace perifrac {

void LearnedSlope::clear() {
  root_area_.resize(0);
  slope_.resize(0, 0);
}

Eigen::MatrixXd LearnedSlope::matrix() const {
  return root_area_.cwiseInverse().asDiagonal() * slope_ * root_area_.asDiagonal();
}

void LearnedSlope::extend(const Eigen::MatrixXd& stiffness, const Eigen::VectorXd& area) {
  const Eigen::Index count = stiffness.rows();
  if (size() == 0 && count > 0) {
    const Eigen::LLT<Eigen::MatrixXd> factor(stiffness);
    if (factor.info() == Eigen::Success) {
      slope_ = factor.solve(Eigen::MatrixXd::Identity(count, count));
    } else {
      slope_ = stiffness.diagonal().cwiseInverse().asDiagonal();
    }
  }
  while (slope_.rows() < count) add(stiffness.col(slope_.rows()).head(slope_.rows() + 1));
  root_area_ = area.cwiseSqrt();
}

/// Of the inverse, a facet that comes is a row and a column more: how it answers to openings of
/// others does not ask what else is cut.
void LearnedSlope::add(const Eigen::VectorXd& stiffness) {
  const Eigen::Index last = slope_.rows();
  Eigen::VectorXd others = slope_ * stiffness.head(last);
  double rest = stiffness[last] - stiffness.head(last).dot(others);
  constexpr double least = 0.05;
  if (!(rest > least * stiffness[last])) {
    rest = stiffness[last];
    others.setZero();
  }
  slope_.conservativeResize(last + 1, last + 1);
  slope_.topLeftCorner(last, last) += others * others.transpose() / rest;
  slope_.col(last).head(last) = -others / rest;
  slope_.row(last).head(last) = slope_.col(last).head(last).transpose();
  slope_(last, last) = 1.0 / rest;
}

void LearnedSlope::keep(Eigen::Index count) {
  while (size() > count) {
    const Eigen::Index last = size() - 1;
    const Eigen::VectorXd column = slope_.col(last).head(last);
    Eigen::MatrixXd rest = slope_.topLeftCorner(last, last);
    rest -= column * column.transpose() / slope_(last, last);
    slope_ = std::move(rest);
    root_area_.conservativeResize(last);
  }
}

void LearnedSlope::learn(const Eigen::VectorXd& pressure, const Eigen::VectorXd& opening) {
  const Eigen::VectorXd by = root_area_.cwiseProduct(pressure);
  const Eigen::VectorXd shown = root_area_.cwiseProduct(opening), guess = slope_ * by;
  const double work = shown.dot(by), guessed = guess.dot(by);
  if (!(work > 0.0 && guessed > 0.0)) return;
  slope_ += shown * shown.transpose() / work - guess * guess.transpose() / guessed;
}

void LearnedSlope::visit_state(StateVisitor& visitor) {
  visitor.visit("root_area", root_area_);
  Eigen::VectorXd all = slope_.reshaped();
  visitor.visit("slope", all);
  slope_ = all.reshaped(size(), size());
}

}  // namespace perifrac
