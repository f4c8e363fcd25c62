#include "modules/pore_flow/flow_multigrid.hpp"

#include <limits>
#include <utility>

#include "core/base/for_each_point.hpp"
#include "core/solvers/smoothed_aggregation.hpp"

namespace perifrac {

namespace {

/// So many unknowns are factored in no time.
constexpr Eigen::Index few = 500;

using Sparse = Eigen::SparseMatrix<double>;

/// Of a column and a vector.
double product(const Sparse& matrix, Eigen::Index column, const Eigen::VectorXd& u) {
  double sum = 0.0;
  for (Sparse::InnerIterator entry(matrix, column); entry; ++entry) {
    sum += entry.value() * u[entry.row()];
  }
  return sum;
}

}  // namespace

/// Of a symmetric matrix columns are rows, which threads can share.
class FlowMultigrid::Level final : public MultigridLevel {
 public:
  Level(AggregatedMatrix aggregated, std::vector<bool> held)
      : flow_(std::move(aggregated.matrix)),
        from_coarser_(std::move(aggregated.from_coarser)),
        to_coarser_(from_coarser_.transpose()),
        held_(std::move(held)),
        inverse_diagonal_(flow_.cols()) {}

  void set(const Eigen::VectorXd& storage, double gamma) {
    storage_ = storage;
    gamma_ = gamma;
    inverse_diagonal_ = (storage_ + gamma_ * flow_.diagonal()).cwiseInverse();
    for (Eigen::Index i = 0; i < size(); ++i) {
      if (held_[i]) inverse_diagonal_[i] = 0.0;
    }
  }

  Sparse assemble() const {
    Sparse sum = gamma_ * flow_;
    for (Eigen::Index i = 0; i < size(); ++i) sum.coeffRef(i, i) += storage_[i];
    for (Eigen::Index i = 0; i < size(); ++i) {
      for (Sparse::InnerIterator entry(sum, i); entry; ++entry) {
        if (held_[i] || held_[entry.row()]) entry.valueRef() = entry.row() == i ? 1.0 : 0.0;
      }
    }
    return sum;
  }

  Eigen::Index size() const override { return flow_.cols(); }
  void apply(const Eigen::VectorXd& u, Eigen::VectorXd& result) override {
    for_each_point(static_cast<Index>(size()), [&](Index i) {
      result[i] = storage_[i] * u[i] + gamma_ * product(flow_, i, u);
    });
  }
  const Eigen::VectorXd& inverse_diagonal() const override { return inverse_diagonal_; }
  void restrict_residual(const Eigen::VectorXd& residual, Eigen::VectorXd& coarse) const override {
    for_each_point(static_cast<Index>(from_coarser_.cols()),
                   [&](Index i) { coarse[i] = product(from_coarser_, i, residual); });
  }
  void add_correction(const Eigen::VectorXd& coarse, Eigen::VectorXd& u) const override {
    for_each_point(static_cast<Index>(size()),
                   [&](Index i) { u[i] += product(to_coarser_, i, coarse); });
  }

 private:
  Sparse flow_, from_coarser_, to_coarser_;
  std::vector<bool> held_;
  double gamma_ = 0.0;
  Eigen::VectorXd storage_, inverse_diagonal_;
};

FlowMultigrid::FlowMultigrid(Eigen::SparseMatrix<double> flow, std::vector<bool> held) {
  // Hardly any storage makes the largest eigenvalue of D^-1 (S + gamma H) as large as it can be.
  constexpr double hardly_any = 1e-3;
  const Eigen::VectorXd storage =
      hardly_any * flow.diagonal().cwiseMax(std::numeric_limits<double>::min());
  std::vector<std::unique_ptr<MultigridLevel>> levels;
  for (AggregatedMatrix& matrix : aggregate(std::move(flow), held, few)) {
    std::vector<bool> held_here(matrix.matrix.cols(), false);
    if (levels_.empty()) held_here = std::move(held);
    auto level = std::make_unique<Level>(std::move(matrix), std::move(held_here));
    levels_.push_back(level.get());
    levels.push_back(std::move(level));
  }
  set_levels(storage, 1.0);
  multigrid_ = std::make_unique<Multigrid>(std::move(levels), levels_.back()->assemble());
}

FlowMultigrid::~FlowMultigrid() = default;

void FlowMultigrid::set(const Eigen::VectorXd& storage, double gamma) {
  set_levels(storage, gamma);
  multigrid_->take_coarsest(levels_.back()->assemble());
}

void FlowMultigrid::set_levels(const Eigen::VectorXd& storage, double gamma) {
  Eigen::VectorXd here = storage, coarser;
  for (std::size_t k = 0; k < levels_.size(); ++k) {
    levels_[k]->set(here, gamma);
    if (k + 1 == levels_.size()) break;
    coarser.resize(levels_[k + 1]->size());
    levels_[k]->restrict_residual(here, coarser);
    here.swap(coarser);
  }
}

}  // namespace perifrac
