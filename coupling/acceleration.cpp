#include "coupling/acceleration.hpp"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <deque>
#include <vector>

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

/// Which combination of steps comes nearest to a residual, by the products of their residuals, all
/// scaled. The products are found once a window, and those of a step when it comes.
class StepFit {
 public:
  /// Steps come newest first; at most `most` will be there at once.
  void start(const std::deque<Step>& steps, const VectorXd& scale, std::size_t most) {
    const Eigen::Index known = std::ssize(steps);
    columns_.resize(scale.size(), static_cast<Eigen::Index>(most));
    places_.clear();
    free_.clear();
    for (Eigen::Index k = columns_.cols() - 1; k >= known; --k) free_.push_back(k);
    for (Eigen::Index k = 0; k < known; ++k) {
      columns_.col(k) = scale.cwiseProduct(steps[static_cast<std::size_t>(k)].residual);
      places_.push_back(k);
    }
    products_.setZero(columns_.cols(), columns_.cols());
    auto between = products_.topLeftCorner(known, known);
    between.selfadjointView<Eigen::Lower>().rankUpdate(columns_.leftCols(known).transpose());
    between.triangularView<Eigen::StrictlyUpper>() = between.transpose();
  }

  void add_newest(const VectorXd& scaled_residual) {
    const Eigen::Index place = free_.back();
    free_.pop_back();
    places_.push_front(place);
    columns_.col(place) = scaled_residual;
    for (const Eigen::Index other : places_) {
      products_(place, other) = products_(other, place) = columns_.col(other).dot(scaled_residual);
    }
  }

  void drop(std::size_t step) {
    free_.push_back(places_[step]);
    places_.erase(places_.begin() + static_cast<std::ptrdiff_t>(step));
  }

  /// A factor by step; those that say next to nothing beyond newer ones are dropped here and there.
  VectorXd factors(std::deque<Step>& steps, const VectorXd& scaled_residual) {
    constexpr double new_part = 0.02;
    MatrixXd lower(std::ssize(places_), std::ssize(places_));  // Cholesky's, of the products
    VectorXd along(std::ssize(places_));
    Eigen::Index used = 0;
    for (std::size_t i = 0; i < places_.size();) {
      VectorXd row(used);
      for (Eigen::Index k = 0; k < used; ++k) {
        row[k] = products_(places_[static_cast<std::size_t>(k)], places_[i]);
      }
      const auto known = lower.topLeftCorner(used, used);
      known.triangularView<Eigen::Lower>().solveInPlace(row);
      const double whole = products_(places_[i], places_[i]);
      const double rest = whole - row.squaredNorm();
      if (!(rest > new_part * new_part * whole)) {
        drop(i);
        steps.erase(steps.begin() + static_cast<std::ptrdiff_t>(i));
        continue;
      }
      const double pivot = std::sqrt(rest);
      const double wanted = columns_.col(places_[i]).dot(scaled_residual);
      along[used] = (wanted - row.dot(along.head(used))) / pivot;
      lower.row(used).head(used) = row.transpose();
      lower(used, used) = pivot;
      ++used, ++i;
    }
    const auto all = lower.topLeftCorner(used, used);
    return all.transpose().triangularView<Eigen::Upper>().solve(along.head(used));
  }

 private:
  MatrixXd columns_;                 ///< the steps' residuals; those of none are anything
  MatrixXd products_;                ///< of columns
  std::deque<Eigen::Index> places_;  ///< the column of each step
  std::vector<Eigen::Index> free_;   ///< columns of none
};

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
      if (steps_.size() == depth_) {
        steps_.pop_back();
        fit_.drop(steps_.size());
      }
      steps_.push_front({residual - residual_, answer - answer_});
      fit_.add_newest(scale.cwiseProduct(steps_.front().residual));
    } else {
      fit_.start(steps_, scale, depth_);
    }
    residual_ = residual;
    answer_ = answer;
    const VectorXd factors = fit_.factors(steps_, scale.cwiseProduct(residual));
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
  StepFit fit_;             ///< in the window at hand
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
