#include "core/time/cvode_integrator.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <memory>
#include <stdexcept>
#include <vector>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "core/base/errors.hpp"
#include "tests/unit/time/line_diffusion.hpp"

namespace perifrac {
namespace {

using test::largest_difference;
using test::LineCholesky;
using test::LineDiagonal;
using test::LineDiffusion;

/// A stiff line (stable explicit step about 2e-4 of the run), by either linear solver.
class CvodeIntegratorTest : public testing::TestWithParam<bool> {
 protected:
  CvodeIntegratorTest() {
    line_.uptake = 0.3;
    matrix_ = make_matrix();
  }

  std::unique_ptr<NewtonMatrix> make_matrix() {
    if (GetParam()) return std::make_unique<LineCholesky>(line_);
    return std::make_unique<LineDiagonal>(line_);
  }

  CvodeIntegrator make(double tolerance) { return CvodeIntegrator(line_, *matrix_, tolerance); }

  LineDiffusion line_{40, 1000.0};
  std::unique_ptr<NewtonMatrix> matrix_;
};

INSTANTIATE_TEST_SUITE_P(LinearSolver, CvodeIntegratorTest, testing::Bool(),
                         [](const auto& info) { return info.param ? "Direct" : "Krylov"; });

TEST_P(CvodeIntegratorTest, ErrorAgainstTheMatrixExponentialFallsWithTheTolerance) {
  const std::vector<double> start = line_.start(), exact = line_.exact(start, 0.5);
  double coarser = 1.0, coarsest = 0.0;
  for (const double tolerance : {1e-3, 1e-5, 1e-7, 1e-9}) {
    CvodeIntegrator cvode = make(tolerance);
    std::vector<double> y = start;
    cvode.reset(0.0, y);
    cvode.advance(0.5, y);
    const double error = largest_difference(y, exact);
    EXPECT_LT(error, 100.0 * tolerance);
    EXPECT_LT(error, 0.2 * coarser);
    coarser = error;
    coarsest = std::max(coarsest, error);
    EXPECT_LT(cvode.statistics().steps, 2000) << "an explicit method needs 5000";
  }
  EXPECT_LT(coarser, 1e-4 * coarsest) << "over six decades of tolerance";
}

TEST_P(CvodeIntegratorTest, GoesOnWithItsHistoryFromWindowToWindow) {
  CvodeIntegrator at_once = make(1e-6), in_windows = make(1e-6), afresh = make(1e-6);
  std::vector<double> a = line_.start(), b = a, c = a;
  at_once.reset(0.0, a);
  at_once.advance(0.5, a);
  in_windows.reset(0.0, b);
  afresh.reset(0.0, c);
  for (int window = 1; window <= 10; ++window) {
    in_windows.advance(0.05 * window, b);
    afresh.advance(0.05 * window, c);
    afresh.reset(0.05 * window, c);
  }
  const std::vector<double> exact = line_.exact(line_.start(), 0.5);
  EXPECT_LT(largest_difference(b, exact), 1e-4);
  EXPECT_LT(largest_difference(c, exact), 1e-4);
  // Numbers of steps follow the last digits: by 10 % or so, as by what the tolerance is rounded to.
  EXPECT_LT(in_windows.statistics().steps, 1.4 * at_once.statistics().steps);
  EXPECT_GT(afresh.statistics().steps, 1.1 * in_windows.statistics().steps);
}

TEST_P(CvodeIntegratorTest, EndsAtTheEndOfTheWindowNotBeyond) {
  struct Watched final : LineDiffusion {
    using LineDiffusion::LineDiffusion;
    void rhs(double t, std::span<const double> y, std::span<double> dydt) override {
      latest = std::max(latest, t);
      LineDiffusion::rhs(t, y, dydt);
    }
    double latest = 0.0;
  } watched(10, 1.0);
  LineCholesky matrix(watched);
  CvodeIntegrator cvode(watched, matrix, 1e-4);
  std::vector<double> y = watched.start();
  cvode.reset(0.0, y);
  for (const double end : {0.1, 0.3, 1.0 / 3.0, 7.7}) {
    cvode.advance(end, y);
    EXPECT_LE(watched.latest, end);
    EXPECT_GT(watched.latest, 0.99 * end);
  }
  const std::vector<double> before = y;
  cvode.advance(7.7, y);
  EXPECT_EQ(y, before) << "a window without length changes nothing";
}

TEST_P(CvodeIntegratorTest, DependsOnTimeAndStateAloneAfterReset) {
  CvodeIntegrator with_history = make(1e-6);
  std::vector<double> y = line_.start();
  with_history.reset(0.0, y);
  with_history.advance(0.013, y);
  with_history.advance(0.2, y);
  const std::vector<double> restored = y;
  with_history.advance(0.21, y);  // a window that is rolled back
  with_history.reset(0.2, restored);

  const std::unique_ptr<NewtonMatrix> other_matrix = make_matrix();
  CvodeIntegrator fresh(line_, *other_matrix, 1e-6);
  fresh.reset(0.2, restored);
  std::vector<double> a = restored, b = restored;
  for (const double end : {0.2001, 0.25, 0.5}) {
    with_history.advance(end, a);
    fresh.advance(end, b);
    EXPECT_EQ(a, b) << "at " << end;
  }
}

TEST_P(CvodeIntegratorTest, CountsOverResets) {
  CvodeIntegrator cvode = make(1e-5);
  std::vector<double> y = line_.start();
  cvode.reset(0.0, y);
  cvode.advance(0.1, y);
  const IntegratorStatistics first = cvode.statistics();
  EXPECT_GT(first.steps, 0);
  EXPECT_GT(first.rhs_evaluations, first.steps);
  EXPECT_GT(first.matrix_set_ups, 0);
  EXPECT_EQ(first.linear_iterations > 0, !GetParam());
  cvode.reset(0.1, y);
  EXPECT_EQ(cvode.statistics().steps, first.steps);
  cvode.advance(0.2, y);
  EXPECT_GT(cvode.statistics().steps, first.steps);
}

TEST_P(CvodeIntegratorTest, NamesFieldEntryAndTimeOfARateThatIsNotFinite) {
  line_.poisoned_from = 0.25;
  CvodeIntegrator cvode = make(1e-5);
  std::vector<double> y = line_.start();
  cvode.reset(0.0, y);
  cvode.advance(0.2, y);
  try {
    cvode.advance(0.5, y);
    FAIL() << "no exception";
  } catch (const NumericalError& error) {
    EXPECT_EQ(error.field(), "line/content");
    EXPECT_EQ(error.place(), "entry 2");
    EXPECT_GE(error.time(), 0.25);
    EXPECT_LT(error.time(), 0.3);
    EXPECT_THAT(error.what(), testing::HasSubstr("the rate of change is not finite"));
  }
}

TEST_P(CvodeIntegratorTest, PassesOnWhatTheSystemThrows) {
  struct Throwing final : LineDiffusion {
    using LineDiffusion::LineDiffusion;
    void rhs(double t, std::span<const double> y, std::span<double> dydt) override {
      if (t > 0.1) throw NumericalError("porosity", "point 7", t, "it is negative");
      LineDiffusion::rhs(t, y, dydt);
    }
  } throwing(10);
  LineDiagonal matrix(throwing);
  CvodeIntegrator cvode(throwing, matrix, 1e-5);
  std::vector<double> y = throwing.start();
  cvode.reset(0.0, y);
  EXPECT_THROW(cvode.advance(1.0, y), NumericalError);
}

TEST_P(CvodeIntegratorTest, KeepsALinearInvariantToRoundOffIfTheMatrixDoes) {
  CvodeIntegrator cvode = make(1e-4);
  std::vector<double> y = line_.start();
  const double before = line_.invariant(y);
  cvode.reset(0.0, y);
  for (int window = 1; window <= 20; ++window) {
    cvode.advance(0.1 * window, y);
    EXPECT_NEAR(line_.invariant(y) / before, 1.0, 1e-13);
  }
  EXPECT_GT(std::abs(y.back()), 1.0);
}

TEST(CvodeIntegrator, DirectAndKrylovAgreeToTheTolerance) {
  LineDiffusion line(40, 1000.0);
  LineCholesky exact(line);
  LineDiagonal diagonal(line);
  CvodeIntegrator direct(line, exact, 1e-7), krylov(line, diagonal, 1e-7);
  std::vector<double> a = line.start(), b = a;
  direct.reset(0.0, a);
  direct.advance(0.5, a);
  krylov.reset(0.0, b);
  krylov.advance(0.5, b);
  EXPECT_LT(largest_difference(a, b), 3e-6);
}

TEST(CvodeIntegrator, MeasuresErrorsAgainstTheSystemsMagnitudes) {
  LineDiffusion line(10);
  LineCholesky matrix(line);
  const auto error_and_steps = [&](double scale) {
    line.scale = scale;
    CvodeIntegrator cvode(line, matrix, 1e-6);
    std::vector<double> y = line.start();
    const std::vector<double> exact = line.exact(y, 1.0);
    cvode.reset(0.0, y);
    cvode.advance(1.0, y);
    return std::pair(largest_difference(y, exact), cvode.statistics().steps);
  };
  const auto [fine, many] = error_and_steps(1.0);
  const auto [coarse, few] = error_and_steps(1e3);
  EXPECT_LT(fine, 1e-4);
  EXPECT_GT(coarse, 3.0 * fine);
  EXPECT_LT(few, many);
}

/// Two unknowns that fade towards `target`, one of them at once; small beside what they fade to.
struct Fading final : OdeSystem {
  std::string_view name() const override { return "fading"; }
  std::size_t size() const override { return 2; }
  std::uint64_t jacobian_version() const override { return 0; }
  void rhs(double, std::span<const double> y, std::span<double> dydt) override {
    for (std::size_t i = 0; i < 2; ++i) dydt[i] = -rate[i] * (y[i] - target[i]);
  }
  void jacobian_times(double, std::span<const double>, std::span<const double> v,
                      std::span<double> product) override {
    for (std::size_t i = 0; i < 2; ++i) product[i] = -rate[i] * v[i];
  }
  void magnitudes(double, std::span<const double> y, std::span<double> magnitude) override {
    const double left = std::max(std::abs(y[0] - target[0]), std::abs(y[1] - target[1]));
    std::ranges::fill(magnitude, std::max(left, 1e-14));
  }

  std::vector<double> rate = {1.0, 1e10};
  std::vector<double> target = {1.0, 1.0};
};

struct FadingMatrix final : NewtonMatrix {
  explicit FadingMatrix(const Fading& of) : system(of) {}
  bool exact() const override { return true; }
  void set_up(double, std::span<const double>, double new_gamma) override { gamma = new_gamma; }
  void solve(std::span<const double> r, std::span<double> solution) override {
    for (std::size_t i = 0; i < 2; ++i) solution[i] = r[i] / (1.0 + gamma * system.rate[i]);
  }
  const Fading& system;
  double gamma = 0.0;
};

/// From a step as long as the slow unknown lasts to one as short as the fast: ten decades.
TEST(CvodeIntegrator, FollowsAnInputThatJumpsInTheFastestMode) {
  Fading system;
  FadingMatrix matrix(system);
  CvodeIntegrator cvode(system, matrix, 1e-6);
  std::vector<double> y = {2.0, 1.0};
  cvode.reset(0.0, y);
  cvode.advance(1.0, y);
  system.target[1] = 1.5;
  cvode.advance(2.0, y);
  EXPECT_NEAR(y[0], 1.0 + std::exp(-2.0), 1e-4);
  EXPECT_NEAR(y[1], 1.5, 1e-5);
}

/// What is left is below what y can hold: nothing more is asked of it than that.
TEST(CvodeIntegrator, GoesOnAfterAllButRoundingHasFaded) {
  for (const double tolerance : {1e-5, 1e-7, 1e-9}) {
    Fading system;
    FadingMatrix matrix(system);
    CvodeIntegrator cvode(system, matrix, tolerance);
    std::vector<double> y = {2.0, 1.0};
    cvode.reset(0.0, y);
    for (double t = 1.0; t <= 100.0; t += 1.0) ASSERT_NO_THROW(cvode.advance(t, y)) << tolerance;
    EXPECT_NEAR(y[0], 1.0, 1e-11);
    EXPECT_LT(cvode.statistics().steps, 2000);
  }
}

}  // namespace
}  // namespace perifrac
