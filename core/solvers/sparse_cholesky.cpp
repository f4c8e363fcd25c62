#include "core/solvers/sparse_cholesky.hpp"

#include <algorithm>
#include <atomic>
#include <cassert>
#include <cmath>

#include <fmt/format.h>

#include "core/profile/profile.hpp"
#include "core/solvers/cholesky_backend.hpp"

namespace perifrac {

namespace {

std::atomic<std::int64_t> factorisations = 0, solves = 0;

}  // namespace

NotPositiveDefinite::NotPositiveDefinite(Eigen::Index row)
    : std::runtime_error(fmt::format("the matrix is not positive definite (row {})", row)),
      row_(row) {}

SparseCholesky::SparseCholesky() : backend_(CholeskyBackend::make()) {}
SparseCholesky::~SparseCholesky() = default;
SparseCholesky::SparseCholesky(SparseCholesky&&) noexcept = default;
SparseCholesky& SparseCholesky::operator=(SparseCholesky&&) noexcept = default;

void SparseCholesky::factor(const Eigen::SparseMatrix<double>& a) {
  const ProfileScope profiled("factorisation");
  assert(a.isCompressed() && a.rows() == a.cols());
  // A factorisation carries what is not finite along without a word.
  const double* end = a.valuePtr() + a.nonZeros();
  const double* bad =
      std::find_if_not(a.valuePtr(), end, [](double v) { return std::isfinite(v); });
  if (bad != end) throw NotPositiveDefinite(a.innerIndexPtr()[bad - a.valuePtr()]);

  if (!has_analysed_pattern_of(a)) {
    backend_->analyze(a);
    starts_.assign(a.outerIndexPtr(), a.outerIndexPtr() + a.outerSize() + 1);
    rows_.assign(a.innerIndexPtr(), a.innerIndexPtr() + a.nonZeros());
  }
  factorisations.fetch_add(1, std::memory_order_relaxed);
  if (const auto row = backend_->factor(a)) throw NotPositiveDefinite(*row);
}

void SparseCholesky::solve(const Eigen::Ref<const Eigen::MatrixXd>& b,
                           Eigen::Ref<Eigen::MatrixXd> x) const {
  assert(b.rows() == x.rows() && b.cols() == x.cols());
  const ProfileScope profiled("solves");
  solves.fetch_add(1, std::memory_order_relaxed);
  backend_->solve(b, x);
}

void SparseCholesky::solve_part(std::span<const int> rows,
                                const Eigen::Ref<const Eigen::MatrixXd>& b,
                                std::span<const int> wanted, Eigen::Ref<Eigen::MatrixXd> x) const {
  assert(b.rows() == std::ssize(rows) && x.rows() == std::ssize(wanted) && b.cols() == x.cols());
  const ProfileScope profiled("solves");
  solves.fetch_add(1, std::memory_order_relaxed);
  backend_->solve_part(rows, b, wanted, x);
}

Eigen::VectorXd SparseCholesky::begin(const Eigen::VectorXd& b) const {
  const ProfileScope profiled("solves");
  solves.fetch_add(1, std::memory_order_relaxed);
  Eigen::VectorXd begun;
  backend_->begin(b, begun);
  return begun;
}

Eigen::VectorXd SparseCholesky::part(const Eigen::VectorXd& begun,
                                     std::span<const int> wanted) const {
  const ProfileScope profiled("solves");
  Eigen::VectorXd x;
  backend_->part(begun, wanted, x);
  return x;
}

Eigen::VectorXd SparseCholesky::finish(const Eigen::VectorXd& begun, std::span<const int> rows,
                                       const Eigen::VectorXd& c) const {
  assert(c.size() == std::ssize(rows));
  const ProfileScope profiled("solves");
  Eigen::VectorXd x;
  backend_->finish(begun, rows, c, x);
  return x;
}

CholeskyWork SparseCholesky::work() { return {factorisations, solves}; }

const char* SparseCholesky::backend() { return CholeskyBackend::name(); }

bool SparseCholesky::has_analysed_pattern_of(const Eigen::SparseMatrix<double>& a) const {
  return std::equal(starts_.begin(), starts_.end(), a.outerIndexPtr(),
                    a.outerIndexPtr() + a.outerSize() + 1) &&
         std::equal(rows_.begin(), rows_.end(), a.innerIndexPtr(),
                    a.innerIndexPtr() + a.nonZeros());
}

}  // namespace perifrac
