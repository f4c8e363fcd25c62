// For builds without CHOLMOD.
#include <algorithm>

#include <Eigen/SparseCholesky>

#include "core/solvers/cholesky_backend.hpp"

namespace perifrac {
namespace {

class EigenBackend final : public CholeskyBackend {
 public:
  void analyze(const Eigen::SparseMatrix<double>& a) override { ldlt_.analyzePattern(a); }

  std::optional<Eigen::Index> factor(const Eigen::SparseMatrix<double>& a) override {
    ldlt_.factorize(a);
    // It stops at a pivot of zero only, and leaves the later ones undefined.
    const Eigen::VectorXd pivots = ldlt_.vectorD();
    const auto bad =
        std::find_if_not(pivots.begin(), pivots.end(), [](double pivot) { return pivot > 0.0; });
    if (bad == pivots.end()) return std::nullopt;
    return ldlt_.permutationPinv().indices()[bad - pivots.begin()];
  }

  void solve(const Eigen::Ref<const Eigen::MatrixXd>& b, Eigen::Ref<Eigen::MatrixXd> x) override {
    x = ldlt_.solve(b);
  }

  void solve_part(std::span<const int> rows, const Eigen::Ref<const Eigen::MatrixXd>& b,
                  std::span<const int> wanted, Eigen::Ref<Eigen::MatrixXd> x) override {
    Eigen::MatrixXd all = Eigen::MatrixXd::Zero(ldlt_.rows(), b.cols());
    for (std::size_t k = 0; k < rows.size(); ++k) all.row(rows[k]) = b.row(k);
    all = ldlt_.solve(all).eval();
    for (std::size_t k = 0; k < wanted.size(); ++k) x.row(k) = all.row(wanted[k]);
  }

  /// No way through a part of it: all waits for what comes later.
  void begin(const Eigen::VectorXd& b, Eigen::VectorXd& begun) override { begun = b; }
  void part(const Eigen::VectorXd& begun, std::span<const int> wanted,
            Eigen::VectorXd& x) override {
    const Eigen::VectorXd all = ldlt_.solve(begun);
    x.resize(std::ssize(wanted));
    for (std::size_t k = 0; k < wanted.size(); ++k) x[k] = all[wanted[k]];
  }
  void finish(const Eigen::VectorXd& begun, std::span<const int> rows, const Eigen::VectorXd& c,
              Eigen::VectorXd& x) override {
    Eigen::VectorXd all = begun;
    for (std::size_t k = 0; k < rows.size(); ++k) all[rows[k]] += c[k];
    x = ldlt_.solve(all);
  }

 private:
  Eigen::SimplicialLDLT<Eigen::SparseMatrix<double>, Eigen::Lower> ldlt_;
};

}  // namespace

std::unique_ptr<CholeskyBackend> CholeskyBackend::make() {
  return std::make_unique<EigenBackend>();
}

const char* CholeskyBackend::name() { return "Eigen LDLT"; }

}  // namespace perifrac
