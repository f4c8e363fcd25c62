// The only source file that includes CHOLMOD.
#include <cassert>
#include <cblas.h>
#include <new>
#include <optional>
#include <span>
#include <stdexcept>

#include <cholmod.h>
#include <omp.h>

#include "core/solvers/cholesky_backend.hpp"
#include "core/solvers/openblas_kernels.hpp"
#include "core/solvers/supernodal_part.hpp"

namespace perifrac {
namespace {

/// OpenBLAS and CHOLMOD on one thread. On two, OpenBLAS gives other bits; CHOLMOD's loops ask for
/// four threads per supernode, however small, which costs more than the factorisation itself.
/// These settings, OpenMP's number of threads among them, are everybody's: all are put back.
class OneThread {
 public:
  OneThread() {
    omp_set_max_active_levels(0);
    openblas_set_num_threads(1);
  }
  ~OneThread() {
    openblas_set_num_threads(blas_threads_);
    omp_set_num_threads(openmp_threads_);
    omp_set_max_active_levels(openmp_levels_);
  }
  OneThread(const OneThread&) = delete;
  OneThread& operator=(const OneThread&) = delete;

 private:
  int openmp_levels_ = omp_get_max_active_levels();
  int openmp_threads_ = omp_get_max_threads();
  int blas_threads_ = openblas_get_num_threads();
};

/// Somebody else's array as CHOLMOD sees it; CHOLMOD does not write to inputs.
cholmod_dense dense_view(const double* data, Eigen::Index rows, Eigen::Index columns,
                         Eigen::Index stride) {
  cholmod_dense view{};
  view.nrow = static_cast<std::size_t>(rows);
  view.ncol = static_cast<std::size_t>(columns);
  view.d = static_cast<std::size_t>(stride);
  view.nzmax = view.d * view.ncol;
  view.x = const_cast<double*>(data);
  view.xtype = CHOLMOD_REAL;
  view.dtype = CHOLMOD_DOUBLE;
  return view;
}

cholmod_sparse lower_half_view(const Eigen::SparseMatrix<double>& a) {
  cholmod_sparse view{};
  view.nrow = static_cast<std::size_t>(a.rows());
  view.ncol = static_cast<std::size_t>(a.cols());
  view.nzmax = static_cast<std::size_t>(a.nonZeros());
  view.p = const_cast<int*>(a.outerIndexPtr());
  view.i = const_cast<int*>(a.innerIndexPtr());
  view.x = const_cast<double*>(a.valuePtr());
  view.stype = -1;
  view.itype = CHOLMOD_INT;
  view.xtype = CHOLMOD_REAL;
  view.dtype = CHOLMOD_DOUBLE;
  view.sorted = 1;
  view.packed = 1;
  return view;
}

class CholmodBackend final : public CholeskyBackend {
 public:
  CholmodBackend() {
    choose_openblas_kernels();
    cholmod_start(&common_);
    common_.print = 0;
    common_.supernodal = CHOLMOD_SUPERNODAL;
  }
  ~CholmodBackend() override {
    cholmod_free_dense(&work_y_, &common_);
    cholmod_free_dense(&work_e_, &common_);
    cholmod_free_factor(&factor_, &common_);
    cholmod_finish(&common_);
  }
  CholmodBackend(const CholmodBackend&) = delete;
  CholmodBackend& operator=(const CholmodBackend&) = delete;

  void analyze(const Eigen::SparseMatrix<double>& a) override {
    cholmod_sparse view = lower_half_view(a);
    cholmod_free_factor(&factor_, &common_);
    factor_ = cholmod_analyze(&view, &common_);
    check();
    part_.reset();
  }

  std::optional<Eigen::Index> factor(const Eigen::SparseMatrix<double>& a) override {
    const OneThread one_thread;
    cholmod_sparse view = lower_half_view(a);
    cholmod_factorize(&view, factor_, &common_);
    check();
    if (factor_->minor == factor_->n) return std::nullopt;
    return static_cast<const int*>(factor_->Perm)[factor_->minor];
  }

  void solve(const Eigen::Ref<const Eigen::MatrixXd>& b, Eigen::Ref<Eigen::MatrixXd> x) override {
    assert(factor_ && factor_->minor == factor_->n);
    if (x.cols() == 1) {
      part().solve(values(), b.col(0), x.col(0));
      return;
    }
    const OneThread one_thread;
    // CHOLMOD writes columns without gaps between them only: others one at a time.
    const Eigen::Index together = x.outerStride() == x.rows() ? x.cols() : 1;
    for (Eigen::Index first = 0; first < x.cols(); first += together) {
      cholmod_dense rhs = dense_view(b.col(first).data(), b.rows(), together, b.outerStride());
      cholmod_dense solution = dense_view(x.col(first).data(), x.rows(), together, x.rows());
      cholmod_dense* handle = &solution;  // of the right size, so CHOLMOD writes into it
      cholmod_solve2(CHOLMOD_A, factor_, &rhs, nullptr, &handle, nullptr, &work_y_, &work_e_,
                     &common_);
      check();
    }
  }

  void solve_part(std::span<const int> rows, const Eigen::Ref<const Eigen::MatrixXd>& b,
                  std::span<const int> wanted, Eigen::Ref<Eigen::MatrixXd> x) override {
    part().solve(values(), rows, b, wanted, x);
  }

  void begin(const Eigen::VectorXd& b, Eigen::VectorXd& begun) override {
    part().begin(values(), b, begun);
  }
  void part(const Eigen::VectorXd& begun, std::span<const int> wanted,
            Eigen::VectorXd& x) override {
    part().part(values(), begun, wanted, x);
  }
  void finish(const Eigen::VectorXd& begun, std::span<const int> rows, const Eigen::VectorXd& c,
              Eigen::VectorXd& x) override {
    part().finish(values(), begun, rows, c, x);
  }

 private:
  const double* values() const { return static_cast<const double*>(factor_->x); }
  SupernodalPart& part() {
    assert(factor_ && factor_->minor == factor_->n && factor_->is_super);
    if (!part_) part_.emplace(supernodes());
    return *part_;
  }

  Supernodes supernodes() const {
    const auto span_of = [](const void* data, std::size_t count) {
      return std::span(static_cast<const int*>(data), count);
    };
    return {.columns = span_of(factor_->super, factor_->nsuper + 1),
            .rows_begin = span_of(factor_->pi, factor_->nsuper + 1),
            .values_begin = span_of(factor_->px, factor_->nsuper + 1),
            .rows = span_of(factor_->s, factor_->ssize),
            .permutation = span_of(factor_->Perm, factor_->n)};
  }

  void check() const {
    if (common_.status == CHOLMOD_OUT_OF_MEMORY) throw std::bad_alloc();
    if (common_.status < CHOLMOD_OK)
      throw std::runtime_error("the sparse matrix is too large for CHOLMOD, or not valid");
  }

  cholmod_common common_{};
  cholmod_factor* factor_ = nullptr;
  std::optional<SupernodalPart> part_;  ///< made when it is first asked for
  cholmod_dense* work_y_ = nullptr;
  cholmod_dense* work_e_ = nullptr;
};

}  // namespace

std::unique_ptr<CholeskyBackend> CholeskyBackend::make() {
  return std::make_unique<CholmodBackend>();
}

const char* CholeskyBackend::name() { return "CHOLMOD supernodal (GPL-2+)"; }

}  // namespace perifrac
