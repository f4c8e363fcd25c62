#include "coupling/acceleration.hpp"

#include <algorithm>
#include <cstdint>
#include <deque>

#include <Eigen/Dense>
#include <fmt/format.h>

namespace perifrac {
namespace {

using Eigen::MatrixXd;
using Eigen::VectorXd;

class NoAcceleration final : public Acceleration {
 public:
  void reset() override {}
  VectorXd next(const VectorXd&, const VectorXd& answer, const VectorXd&) override {
    return answer;
  }
};

class Aitken final : public Acceleration {
 public:
  void reset() override {
    factor_ = 1.0;
    last_.resize(0);
  }

  VectorXd next(const VectorXd& used, const VectorXd& answer, const VectorXd& scale) override {
    const VectorXd residual = scale.cwiseProduct(answer - used);
    if (last_.size() != residual.size()) reset();
    if (last_.size() > 0) {
      const VectorXd change = residual - last_;
      const double square = change.squaredNorm();
      if (square > 0.0) factor_ *= -last_.dot(change) / square;
    }
    last_ = residual;
    return used + factor_ * (answer - used);
  }

 private:
  double factor_ = 1.0;
  VectorXd last_;
};

/// One step from an input to the next: what residual and answer changed by.
struct Step {
  VectorXd residual;
  VectorXd answer;
};

/// The combination of steps whose residuals, scaled, come nearest to `residual`; steps come newest
/// first, and those that say next to nothing beyond newer ones are left out of `steps`.
VectorXd combine(std::deque<Step>& steps, const VectorXd& residual, const VectorXd& scale) {
  constexpr double new_part = 0.02;
  MatrixXd basis(residual.size(), std::ssize(steps));
  MatrixXd parts = MatrixXd::Zero(std::ssize(steps), std::ssize(steps));
  Eigen::Index used = 0;
  for (std::size_t i = 0; i < steps.size();) {
    VectorXd left = scale.cwiseProduct(steps[i].residual);
    const double whole = left.norm();
    double rest = whole;
    // Once leaves rounding of what it takes off, which counts where little is left.
    for (int twice = 0; twice < 2 && (twice == 0 || rest < 0.1 * whole); ++twice) {
      const VectorXd along = basis.leftCols(used).transpose() * left;
      left -= basis.leftCols(used) * along;
      parts.col(used).head(used) =
          twice == 0 ? along : VectorXd(parts.col(used).head(used) + along);
      rest = left.norm();
    }
    if (!(rest > new_part * whole)) {
      steps.erase(steps.begin() + static_cast<std::ptrdiff_t>(i));
      continue;
    }
    basis.col(used) = left / rest;
    parts(used, used) = rest;
    ++used, ++i;
  }
  const VectorXd along = basis.leftCols(used).transpose() * residual;
  return parts.topLeftCorner(used, used).triangularView<Eigen::Upper>().solve(along);
}

/// Answers as linear in the input as its steps say.
class Secants final : public Acceleration {
 public:
  /// At most `depth` steps; of windows before, as many as have `kept` numbers together.
  Secants(std::size_t depth, std::size_t kept) : depth_(depth), kept_(kept) {}

  void reset() override {
    steps_.clear();
    begin_window();
  }

  void begin_window() override {
    forget_old();
    residual_.resize(0);
  }

  bool remembers() const override { return kept_ > 0; }
  /// What is new has not been asked yet, and has answered nothing.
  void follow(std::span<const Eigen::Index> kept, Eigen::Index size) override {
    for (Step& step : steps_) {
      for (VectorXd* values : {&step.residual, &step.answer}) {
        VectorXd all = VectorXd::Zero(size);
        for (std::size_t i = 0; i < kept.size(); ++i) {
          all[kept[i]] = (*values)[static_cast<Eigen::Index>(i)];
        }
        *values = std::move(all);
      }
    }
  }

  VectorXd next(const VectorXd& used, const VectorXd& answer, const VectorXd& scale) override {
    const VectorXd residual = answer - used;
    if (!steps_.empty() && steps_.front().answer.size() != answer.size()) reset();
    if (residual_.size() == residual.size()) {
      steps_.push_front({residual - residual_, answer - answer_});
      if (steps_.size() > depth_) steps_.pop_back();
    }
    residual_ = residual;
    answer_ = answer;
    const VectorXd factors = combine(steps_, scale.cwiseProduct(residual), scale);
    VectorXd next = answer;
    for (Eigen::Index i = 0; i < factors.size(); ++i) next -= factors[i] * steps_[i].answer;
    return next;
  }

  void visit_state(StateVisitor& visitor) override {
    if (!remembers()) return;
    forget_old();
    auto count = std::ssize(steps_);
    visitor.visit("steps", count);
    steps_.resize(static_cast<std::size_t>(count));
    for (std::size_t i = 0; i < steps_.size(); ++i) {
      visitor.visit(fmt::format("residual_{}", i), steps_[i].residual);
      visitor.visit(fmt::format("answer_{}", i), steps_[i].answer);
    }
  }

 private:
  void forget_old() {
    constexpr std::size_t most = 24;  // older ones are of another crack
    if (steps_.empty()) return;
    const std::size_t size = static_cast<std::size_t>(steps_.front().residual.size());
    steps_.resize(std::min({steps_.size(), most, kept_ / std::max<std::size_t>(size, 1)}));
  }

  std::size_t depth_;
  std::size_t kept_;
  std::deque<Step> steps_;  ///< the newest first
  VectorXd residual_;
  VectorXd answer_;
};

}  // namespace

std::unique_ptr<Acceleration> make_acceleration(AccelerationType type) {
  switch (type) {
    case AccelerationType::aitken:
      return std::make_unique<Aitken>();
    case AccelerationType::anderson:
      return std::make_unique<Secants>(anderson_depth, 0);
    case AccelerationType::quasi_newton:
      return std::make_unique<Secants>(32, std::size_t{1} << 21);
    case AccelerationType::none:
      break;
  }
  return std::make_unique<NoAcceleration>();
}

}  // namespace perifrac
