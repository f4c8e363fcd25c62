#include "core/time/cvode_integrator.hpp"

#include <algorithm>
#include <cmath>
#include <exception>
#include <limits>
#include <memory>
#include <new>
#include <optional>
#include <string>

#include <cvode/cvode.h>
#include <fmt/format.h>
#include <nvector/nvector_serial.h>
#include <sundials/sundials_context.h>
#include <sunlinsol/sunlinsol_spgmr.h>

#include "core/base/errors.hpp"

namespace perifrac {
namespace {

/// So many steps in one window mean that something else is wrong.
constexpr long most_steps = 10'000;

std::span<double> span_of(N_Vector v) {
  return {N_VGetArrayPointer(v), static_cast<std::size_t>(N_VGetLength(v))};
}

std::string describe(int flag) {
  switch (flag) {
    case CV_TOO_MUCH_WORK:
      return "too many steps were needed to reach the end of the window";
    case CV_TOO_MUCH_ACC:
      return "the tolerances ask for more accuracy than double precision has";
    case CV_ERR_FAILURE:
      return "the step became too small for the tolerances to be met";
    case CV_CONV_FAILURE:
      return "Newton's method did not converge however small the step";
    case CV_TOO_CLOSE:
      return "the window is too short to be told from none";
    case CV_ILL_INPUT:
      return "an error weight is not a number";
    default:
      return fmt::format("CVODE stopped with flag {}", flag);
  }
}

template <class Handle>
Handle allocated(Handle handle) {
  if (!handle) throw std::bad_alloc();
  return handle;
}

}  // namespace

/// CVODE's memory, and the functions that it calls back. Its vectors are serial: sums over OpenMP
/// threads would change with their number.
class CvodeIntegrator::Cvode {
 public:
  Cvode(OdeSystem& system, NewtonMatrix& matrix, double tolerance);
  ~Cvode();
  Cvode(const Cvode&) = delete;
  Cvode& operator=(const Cvode&) = delete;

  void reset(double t, std::span<const double> y);
  void advance(double t_end, std::span<double> y);
  /// Earlier starts included.
  IntegratorStatistics statistics() const;

 private:
  void create(double t);
  double first_step(double t_end);
  bool stop_before(double t_end);
  void attach_direct_solver();
  void attach_krylov_solver();
  IntegratorStatistics since_reset() const;
  [[noreturn]] void fail(int flag);

  /// Runs body and turns an exception, which must not pass through C, into an unrecoverable error.
  template <class Body>
  static int guarded(void* self, Body body) {
    auto& cvode = *static_cast<Cvode*>(self);
    try {
      return body(cvode);
    } catch (...) {
      cvode.thrown_ = std::current_exception();
      return -1;
    }
  }
  static int rhs(double t, N_Vector y, N_Vector dydt, void* self);
  static int error_weights(N_Vector y, N_Vector weight, void* self);
  static int set_up_system(double t, N_Vector y, N_Vector, SUNMatrix, int, int* jacobian_is_current,
                           double gamma, void* self, N_Vector, N_Vector, N_Vector);
  static int solve_system(SUNLinearSolver solver, SUNMatrix, N_Vector solution, N_Vector r, double);
  static int jacobian_times(N_Vector v, N_Vector product, double t, N_Vector y, N_Vector,
                            void* self, N_Vector);
  static int set_up_preconditioner(double t, N_Vector y, N_Vector, int, int* jacobian_is_current,
                                   double gamma, void* self);
  static int precondition(double t, N_Vector, N_Vector, N_Vector r, N_Vector solution, double,
                          double, int, void* self);

  OdeSystem& system_;
  NewtonMatrix& newton_matrix_;
  double tolerance_;
  SUNContext context_ = nullptr;
  void* memory_ = nullptr;
  N_Vector y_ = nullptr;
  SUNMatrix no_matrix_ = nullptr;  // the NewtonMatrix holds it; CVODE only wants to see one
  SUNLinearSolver solver_ = nullptr;
  double t_ = 0.0;
  bool is_fresh_ = true;  ///< no step since the last start
  struct NotFinite {
    std::size_t entry;
    double t;
  };
  std::optional<NotFinite> not_finite_;
  std::exception_ptr thrown_;
  IntegratorStatistics before_reset_;
};

CvodeIntegrator::Cvode::Cvode(OdeSystem& system, NewtonMatrix& matrix, double tolerance)
    : system_(system), newton_matrix_(matrix), tolerance_(tolerance) {}

CvodeIntegrator::Cvode::~Cvode() {
  CVodeFree(&memory_);
  if (newton_matrix_.exact() && solver_)
    SUNLinSolFreeEmpty(solver_);
  else if (solver_)
    SUNLinSolFree(solver_);
  if (no_matrix_) SUNMatFreeEmpty(no_matrix_);
  if (y_) N_VDestroy(y_);
  SUNContext_Free(&context_);
}

void CvodeIntegrator::Cvode::create(double t) {
  memory_ = allocated(CVodeCreate(CV_BDF, context_));
  CVodeSetErrHandlerFn(
      memory_, [](int, const char*, const char*, char*, void*) {}, nullptr);
  CVodeSetUserData(memory_, this);
  if (const int flag = CVodeInit(memory_, &Cvode::rhs, t, y_); flag != CV_SUCCESS) fail(flag);
  // An input that jumps brings in modes as fast as the shortest bond: from the step before, a
  // tenth at a time, there may be fifteen decades to go.
  constexpr int most_rejected = 25;
  CVodeSetMaxErrTestFails(memory_, most_rejected);
  CVodeWFtolerances(memory_, &Cvode::error_weights);
  if (newton_matrix_.exact())
    attach_direct_solver();
  else
    attach_krylov_solver();
}

void CvodeIntegrator::Cvode::attach_direct_solver() {
  solver_ = allocated(SUNLinSolNewEmpty(context_));
  solver_->content = this;
  solver_->ops->gettype = [](SUNLinearSolver) { return SUNLINEARSOLVER_DIRECT; };
  solver_->ops->solve = &Cvode::solve_system;
  no_matrix_ = allocated(SUNMatNewEmpty(context_));
  if (const int flag = CVodeSetLinearSolver(memory_, solver_, no_matrix_); flag != CV_SUCCESS)
    fail(flag);
  CVodeSetLinSysFn(memory_, &Cvode::set_up_system);
}

void CvodeIntegrator::Cvode::attach_krylov_solver() {
  constexpr int largest_space = 30;
  // Of what Newton's iteration may leave. Five times as much, CVODE's own, the error test sees: a
  // tenth more steps where a cycle of multigrid leaves most of that.
  constexpr double beside_newton = 0.01;
  solver_ = allocated(SUNLinSol_SPGMR(y_, SUN_PREC_RIGHT, largest_space, context_));
  if (const int flag = CVodeSetLinearSolver(memory_, solver_, nullptr); flag != CV_SUCCESS)
    fail(flag);
  CVodeSetJacTimes(memory_, nullptr, &Cvode::jacobian_times);
  CVodeSetPreconditioner(memory_, &Cvode::set_up_preconditioner, &Cvode::precondition);
  CVodeSetEpsLin(memory_, beside_newton);
}

void CvodeIntegrator::Cvode::reset(double t, std::span<const double> y) {
  t_ = t;
  is_fresh_ = true;
  if (!context_) {
    SUNContext_Create(nullptr, &context_);
    y_ = allocated(N_VNew_Serial(static_cast<sunindextype>(system_.size()), allocated(context_)));
  }
  std::copy(y.begin(), y.end(), span_of(y_).begin());
  if (!memory_) {
    create(t);
    return;
  }
  before_reset_ = statistics();
  if (const int flag = CVodeReInit(memory_, t, y_); flag != CV_SUCCESS) fail(flag);
}

void CvodeIntegrator::Cvode::advance(double t_end, std::span<double> y) {
  if (t_end == t_) return;
  not_finite_.reset();
  thrown_ = nullptr;
  for (long steps = 0; t_ != t_end; ++steps) {
    if (steps == most_steps) fail(CV_TOO_MUCH_WORK);
    const bool is_last = stop_before(t_end);
    const int flag = CVode(memory_, t_end, y_, &t_, CV_ONE_STEP);
    if (flag < 0) fail(flag);
    if (is_last && flag == CV_TSTOP_RETURN) t_ = t_end;
  }
  const auto reached = span_of(y_);
  std::copy(reached.begin(), reached.end(), y.begin());
}

/// Sets where CVODE must stop; false: on its way to t_end. A rest of less than two steps is halved:
/// CVODE alone would leave a sliver, whose length is noise and from which its next steps grow, so
/// that rounding would decide on them, and where windows end. It also forgets that it means to
/// change its order where the step to the stop is to the bit as long as the last one.
bool CvodeIntegrator::Cvode::stop_before(double t_end) {
  constexpr double rounding = 1e-6;  // of a step: a rest of one step is one step
  constexpr double held_back = 1.0 - 4.0 * std::numeric_limits<double>::epsilon();  // as CVODE does
  double step = 0.0, last = 0.0, now = t_;
  if (is_fresh_) {
    step = first_step(t_end);
    CVodeSetInitStep(memory_, step);
  } else {
    CVodeGetCurrentStep(memory_, &step);
    CVodeGetLastStep(memory_, &last);
    CVodeGetCurrentTime(memory_, &now);
  }
  is_fresh_ = false;
  const double rest = t_end - t_;
  const bool leaves_sliver = rest > step * (1.0 + rounding) && rest < 2.0 * step;
  double stop = leaves_sliver ? t_ + 0.5 * rest : t_end;
  while ((stop - now) * held_back == last) stop = std::nextafter(stop, now);
  CVodeSetStopTime(memory_, stop);
  return !leaves_sliver;
}

/// One whose error, half the second derivative times its square, is an eighth of what is allowed.
/// CVODE's own guess takes that derivative from steps so short that rounding decides on it, and
/// with it on all steps to come; here the state moves by what is allowed, which is no noise.
double CvodeIntegrator::Cvode::first_step(double t_end) {
  const double whole = t_end - t_;
  const auto like_y = [&] {
    return std::unique_ptr<_generic_N_Vector, void (*)(N_Vector)>(allocated(N_VClone(y_)),
                                                                  &N_VDestroy);
  };
  const auto rate = like_y(), later = like_y(), weight = like_y();
  if (rhs(t_, y_, rate.get(), this) != 0 || error_weights(y_, weight.get(), this) != 0) {
    fail(CV_RHSFUNC_FAIL);
  }
  const double speed = N_VWrmsNorm(rate.get(), weight.get());
  const double ahead = speed * whole > 1.0 ? 1.0 / speed : whole;
  N_VLinearSum(1.0, y_, ahead, rate.get(), later.get());
  const auto rate_later = like_y();
  if (rhs(t_ + ahead, later.get(), rate_later.get(), this) != 0) fail(CV_RHSFUNC_FAIL);
  N_VLinearSum(1.0 / ahead, rate_later.get(), -1.0 / ahead, rate.get(), later.get());
  const double curvature = N_VWrmsNorm(later.get(), weight.get());
  const double step = 0.5 * std::sqrt(2.0 / curvature);
  return step < whole ? step : whole;
}

void CvodeIntegrator::Cvode::fail(int flag) {
  if (thrown_) std::rethrow_exception(thrown_);
  const std::string field(system_.name());
  if (not_finite_)
    throw NumericalError(field, system_.place(not_finite_->entry), not_finite_->t,
                         "the rate of change is not finite");
  double t = t_;
  if (memory_) CVodeGetCurrentTime(memory_, &t);
  throw NumericalError(field, "the implicit integrator", t, describe(flag));
}

IntegratorStatistics CvodeIntegrator::Cvode::since_reset() const {
  long steps = 0, evaluations = 0, set_ups = 0, rejected = 0, iterations = 0, failures = 0;
  long linear_iterations = 0;
  CVodeGetNumSteps(memory_, &steps);
  CVodeGetNumRhsEvals(memory_, &evaluations);
  CVodeGetNumLinSolvSetups(memory_, &set_ups);
  CVodeGetNumErrTestFails(memory_, &rejected);
  CVodeGetNonlinSolvStats(memory_, &iterations, &failures);
  CVodeGetNumLinIters(memory_, &linear_iterations);
  return {.steps = steps,
          .rejected_steps = rejected,
          .rhs_evaluations = evaluations,
          .newton_iterations = iterations,
          .newton_failures = failures,
          .matrix_set_ups = set_ups,
          .linear_iterations = linear_iterations};
}

IntegratorStatistics CvodeIntegrator::Cvode::statistics() const {
  IntegratorStatistics sum = before_reset_;
  if (!memory_) return sum;
  const IntegratorStatistics now = since_reset();
  sum.steps += now.steps;
  sum.rejected_steps += now.rejected_steps;
  sum.rhs_evaluations += now.rhs_evaluations;
  sum.newton_iterations += now.newton_iterations;
  sum.newton_failures += now.newton_failures;
  sum.matrix_set_ups += now.matrix_set_ups;
  sum.linear_iterations += now.linear_iterations;
  return sum;
}

int CvodeIntegrator::Cvode::rhs(double t, N_Vector y, N_Vector dydt, void* self) {
  return guarded(self, [&](Cvode& cvode) {
    const auto rate = span_of(dydt);
    cvode.system_.rhs(t, span_of(y), rate);
    const auto bad =
        std::find_if_not(rate.begin(), rate.end(), [](double v) { return std::isfinite(v); });
    if (bad == rate.end()) return 0;
    cvode.not_finite_ = {static_cast<std::size_t>(bad - rate.begin()), t};
    return -1;  // a shorter step would only creep up to the trouble
  });
}

int CvodeIntegrator::Cvode::error_weights(N_Vector y, N_Vector weight, void* self) {
  // As good as none; CVODE divides by it.
  constexpr double no_weight = 1e-30;
  // What is left of y once nearly all has faded is no more accurate than y was, and rounding comes
  // in through the fastest modes.
  constexpr double noise = 1e-12;
  return guarded(self, [&](Cvode& cvode) {
    double t = cvode.t_;
    CVodeGetCurrentTime(cvode.memory_, &t);
    const auto weights = span_of(weight);
    cvode.system_.magnitudes(t, span_of(y), weights);
    const auto values = span_of(y);
    for (std::size_t i = 0; i < weights.size(); ++i) {
      const double error = cvode.tolerance_ * weights[i] + noise * std::abs(values[i]);
      weights[i] = std::max(1.0 / error, no_weight);
    }
    return 0;
  });
}

int CvodeIntegrator::Cvode::set_up_system(double t, N_Vector y, N_Vector, SUNMatrix, int,
                                          int* jacobian_is_current, double gamma, void* self,
                                          N_Vector, N_Vector, N_Vector) {
  return set_up_preconditioner(t, y, nullptr, 0, jacobian_is_current, gamma, self);
}

int CvodeIntegrator::Cvode::solve_system(SUNLinearSolver solver, SUNMatrix, N_Vector solution,
                                         N_Vector r, double) {
  return precondition(0.0, nullptr, nullptr, r, solution, 0.0, 0.0, 0, solver->content);
}

int CvodeIntegrator::Cvode::jacobian_times(N_Vector v, N_Vector product, double t, N_Vector y,
                                           N_Vector, void* self, N_Vector) {
  return guarded(self, [&](Cvode& cvode) {
    cvode.system_.jacobian_times(t, span_of(y), span_of(v), span_of(product));
    return 0;
  });
}

int CvodeIntegrator::Cvode::set_up_preconditioner(double t, N_Vector y, N_Vector, int,
                                                  int* jacobian_is_current, double gamma,
                                                  void* self) {
  *jacobian_is_current = 1;
  return guarded(self, [&](Cvode& cvode) {
    cvode.newton_matrix_.set_up(t, span_of(y), gamma);
    return 0;
  });
}

int CvodeIntegrator::Cvode::precondition(double, N_Vector, N_Vector, N_Vector r, N_Vector solution,
                                         double, double, int, void* self) {
  return guarded(self, [&](Cvode& cvode) {
    cvode.newton_matrix_.solve(span_of(r), span_of(solution));
    return 0;
  });
}

CvodeIntegrator::CvodeIntegrator(OdeSystem& system, NewtonMatrix& matrix, double tolerance)
    : cvode_(std::make_unique<Cvode>(system, matrix, tolerance)) {}
CvodeIntegrator::~CvodeIntegrator() = default;
void CvodeIntegrator::reset(double t, std::span<const double> y) { cvode_->reset(t, y); }
void CvodeIntegrator::advance(double t_end, std::span<double> y) { cvode_->advance(t_end, y); }
double CvodeIntegrator::longest_step() const { return std::numeric_limits<double>::infinity(); }
IntegratorStatistics CvodeIntegrator::statistics() const { return cvode_->statistics(); }

}  // namespace perifrac
