#include "coupling/acceleration.hpp"

#include <deque>

#include <Eigen/QR>

namespace perifrac {
namespace {

using Eigen::VectorXd;

class NoAcceleration final : public Acceleration {
 public:
  void reset() override {}
  VectorXd next(const VectorXd&, const VectorXd& answer) override { return answer; }
};

class Aitken final : public Acceleration {
 public:
  void reset() override {
    factor_ = 1.0;
    last_.resize(0);
  }

  VectorXd next(const VectorXd& used, const VectorXd& answer) override {
    const VectorXd residual = answer - used;
    if (last_.size() > 0) {
      const VectorXd change = residual - last_;
      const double square = change.squaredNorm();
      if (square > 0.0) factor_ *= -last_.dot(change) / square;
    }
    last_ = residual;
    return used + factor_ * residual;
  }

 private:
  double factor_ = 1.0;
  VectorXd last_;
};

class Anderson final : public Acceleration {
 public:
  void reset() override {
    steps_.clear();
    residual_.resize(0);
  }

  VectorXd next(const VectorXd& used, const VectorXd& answer) override {
    const VectorXd residual = answer - used;
    if (residual_.size() > 0) steps_.push_back({residual - residual_, answer - answer_});
    if (steps_.size() > anderson_depth) steps_.pop_front();
    residual_ = residual;
    answer_ = answer;
    if (steps_.empty()) return answer;

    const auto depth = static_cast<Eigen::Index>(steps_.size());
    Eigen::MatrixXd residuals(residual.size(), depth);
    Eigen::MatrixXd answers(residual.size(), depth);
    for (Eigen::Index i = 0; i < depth; ++i) {
      residuals.col(i) = steps_[i].residual;
      answers.col(i) = steps_[i].answer;
    }
    // Pivoting leaves out steps that say nothing new: near the solution they are all rounding.
    return answer - answers * residuals.colPivHouseholderQr().solve(residual);
  }

 private:
  struct Step {
    VectorXd residual;
    VectorXd answer;
  };

  std::deque<Step> steps_;
  VectorXd residual_;
  VectorXd answer_;
};

}  // namespace

std::unique_ptr<Acceleration> make_acceleration(AccelerationType type) {
  switch (type) {
    case AccelerationType::aitken:
      return std::make_unique<Aitken>();
    case AccelerationType::anderson:
      return std::make_unique<Anderson>();
    case AccelerationType::none:
      break;
  }
  return std::make_unique<NoAcceleration>();
}

}  // namespace perifrac
