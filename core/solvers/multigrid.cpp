#include "core/solvers/multigrid.hpp"

#include <cmath>

#include <Eigen/Eigenvalues>

#include "core/profile/profile.hpp"

namespace perifrac {

namespace {

constexpr int most_iterations = 300;
/// What smoothing has to damp: eigenvalues of D^-1 A from the largest down to this part of it.
constexpr double smoothed_part(int steps) { return 0.4 / steps; }
/// Steps of Lanczos' iteration find the largest eigenvalue from below, to some hundredths.
constexpr int lanczos_steps = 8;
constexpr double beyond_lanczos = 1.1;

/// Components of all frequencies, the same ones in every run.
Eigen::VectorXd mixed_vector(Eigen::Index size) {
  Eigen::VectorXd v(size);
  std::uint64_t bits = 0x9e3779b97f4a7c15;
  for (Eigen::Index k = 0; k < size; ++k) {
    bits = bits * 6364136223846793005u + 1442695040888963407u;
    v[k] = static_cast<double>(bits >> 11) * 0x1p-52 - 1.0;
  }
  return v;
}

}  // namespace

Multigrid::Multigrid(std::vector<std::unique_ptr<MultigridLevel>> levels,
                     const Eigen::SparseMatrix<double>& coarsest, int smoothing_steps)
    : smoothing_steps_(smoothing_steps), levels_(std::move(levels)), work_(levels_.size()) {
  coarsest_.factor(coarsest);
  for (std::size_t k = 0; k < levels_.size(); ++k) {
    const Eigen::Index size = levels_[k]->size();
    for (auto vector : {&Work::residual, &Work::correction, &Work::step, &Work::image}) {
      (work_[k].*vector).setZero(size);
    }
  }
  find_largest();
}

void Multigrid::find_largest() {
  for (std::size_t k = 0; k + 1 < levels_.size(); ++k) {
    work_[k].largest = largest_eigenvalue(*levels_[k], work_[k]);
  }
}

/// By Lanczos' iteration in the scalar product of D: conjugate gradients' own, without its answer.
double Multigrid::largest_eigenvalue(MultigridLevel& level, Work& work) const {
  const Eigen::VectorXd& inverse = level.inverse_diagonal();
  Eigen::VectorXd residual = mixed_vector(level.size());
  residual = (inverse.array() > 0.0).select(residual, 0.0);
  Eigen::VectorXd preconditioned = inverse.cwiseProduct(residual);
  work.step = preconditioned;
  double square = residual.dot(preconditioned);
  Eigen::VectorXd diagonal = Eigen::VectorXd::Zero(lanczos_steps);
  Eigen::VectorXd beside = Eigen::VectorXd::Zero(lanczos_steps);
  double previous_step = 0.0, previous_ratio = 0.0;
  int taken = 0;
  for (; taken < lanczos_steps && square > 0.0; ++taken) {
    level.apply(work.step, work.image);
    const double step = square / work.step.dot(work.image);
    diagonal[taken] = 1.0 / step;
    if (taken > 0) diagonal[taken] += previous_ratio / previous_step;
    residual -= step * work.image;
    preconditioned = inverse.cwiseProduct(residual);
    const double next = residual.dot(preconditioned);
    const double ratio = next / square;
    beside[taken] = std::sqrt(ratio) / step;
    work.step = preconditioned + ratio * work.step;
    square = next;
    previous_step = step;
    previous_ratio = ratio;
  }
  Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd> spectrum;
  spectrum.computeFromTridiagonal(diagonal.head(taken), beside.head(taken - 1),
                                  Eigen::EigenvaluesOnly);
  return beyond_lanczos * spectrum.eigenvalues().maxCoeff();
}

void Multigrid::take_off_image(std::size_t level, const Eigen::VectorXd& step) {
  Work& work = work_[level];
  levels_[level]->apply(step, work.image);
  work.residual -= work.image;
}

/// Chebyshev's iteration on `residual`, whose answer is added to `correction`. The residual is kept
/// as it becomes.
void Multigrid::smooth(std::size_t level, bool from_zero) {
  Work& work = work_[level];
  const Eigen::VectorXd& inverse = levels_[level]->inverse_diagonal();
  const double part = smoothed_part(smoothing_steps_);
  const double middle = 0.5 * (1.0 + part) * work.largest;
  const double half = 0.5 * (1.0 - part) * work.largest;
  double ratio = half / middle;
  work.step = inverse.cwiseProduct(work.residual) / middle;
  if (from_zero) {
    work.correction = work.step;
  } else {
    work.correction += work.step;
  }
  for (int k = 1; k < smoothing_steps_; ++k) {
    take_off_image(level, work.step);
    const double next = 1.0 / (2.0 * middle / half - ratio);
    work.step =
        next * ratio * work.step + (2.0 * next / half) * inverse.cwiseProduct(work.residual);
    ratio = next;
    work.correction += work.step;
  }
}

/// correction = B residual, B being near to A^-1, symmetric.
void Multigrid::cycle(std::size_t level) {
  Work& work = work_[level];
  if (level + 1 == levels_.size()) {
    coarsest_.solve(work.residual, work.correction);
    return;
  }
  smooth(level, true);
  take_off_image(level, work.step);
  levels_[level]->restrict_residual(work.residual, work_[level + 1].residual);
  cycle(level + 1);
  work.step.setZero();
  levels_[level]->add_correction(work_[level + 1].correction, work.step);
  work.correction += work.step;
  take_off_image(level, work.step);
  smooth(level, false);
}

int Multigrid::solve(const Eigen::VectorXd& b, Eigen::VectorXd& x, double tolerance) {
  Eigen::VectorXd residual(b.size());
  levels_.front()->apply(x, residual);
  residual = b - residual;
  return correct(residual, x, tolerance * b.norm());
}

int Multigrid::correct(Eigen::VectorXd& residual, Eigen::VectorXd& x, double target) {
  const ProfileScope profiled("solves");
  const auto apply = [this](const Eigen::VectorXd& u, Eigen::VectorXd& image) {
    levels_.front()->apply(u, image);
  };
  return gradients_.correct(residual, x, target, most_iterations, apply,
                            [this](const Eigen::VectorXd& left, Eigen::VectorXd& correction) {
                              precondition(left, correction);
                            });
}

void Multigrid::precondition(const Eigen::VectorXd& residual, Eigen::VectorXd& correction) {
  work_.front().residual = residual;
  cycle(0);
  correction = work_.front().correction;
}

}  // namespace perifrac
