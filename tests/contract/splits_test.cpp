#include <cmath>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "core/base/errors.hpp"
#include "tests/contract/fake_modules.hpp"

namespace perifrac {
namespace {

using fake::Consolidation;
using fake::even_windows;
using testing::HasSubstr;

CouplingOptions options(double window, Split split, int iterations,
                        AccelerationType acceleration = AccelerationType::none) {
  CouplingOptions options = even_windows(window);
  options.split = split;
  options.max_iterations = iterations;
  options.tolerance = 1e-9;
  options.acceleration = acceleration;
  return options;
}

/// Storage that gives the drained split this strength with the fake's stiffness of 1.
Consolidation::Setup strength(double value) { return {.storage = 1.0 / value}; }

double order(double coarse, double fine) { return std::log2(coarse / fine); }

double content_error(double window, const CouplingOptions& options) {
  Consolidation consolidation({}, options);
  consolidation.run(2.0);
  EXPECT_DOUBLE_EQ(consolidation.manager.time(), 2.0);
  EXPECT_EQ(consolidation.manager.step(), std::lround(2.0 / window));
  return consolidation.content_error(2.0);
}

TEST(Splits, FixedStressInOnePassIsSecondOrderInTheWindow) {
  const auto error = [](double window) {
    return content_error(window, options(window, Split::fixed_stress, 1));
  };
  EXPECT_LT(error(0.0125), 1e-4);
  EXPECT_GE(order(error(0.05), error(0.025)), 1.9);
  EXPECT_GE(order(error(0.025), error(0.0125)), 1.9);
}

TEST(Splits, IteratedIsSecondOrderInTheWindow) {
  for (const Split split : {Split::fixed_stress, Split::drained}) {
    const auto error = [&](double window) {
      CouplingOptions iterated = options(window, split, 200, AccelerationType::anderson);
      return content_error(window, iterated);
    };
    EXPECT_GE(order(error(0.05), error(0.025)), 1.9);
  }
}

TEST(Splits, SettledPressureIsTheMonolithicOne) {
  Consolidation consolidation({}, options(0.1, Split::fixed_stress, 1));
  consolidation.manager.settle();
  EXPECT_LT(consolidation.pressure_error(0.0), 1e-9);
  EXPECT_EQ(consolidation.manager.step(), 0);
}

TEST(Splits, IteratedWindowsEndInAgreement) {
  Consolidation consolidation({}, options(0.1, Split::fixed_stress, 100));
  consolidation.run(1.0);
  for (std::size_t i = 0; i < consolidation.setup.stiffness.size(); ++i) {
    const double pressure = consolidation.pores->pressure()[i];
    const double dilatation = consolidation.springs->dilatation()[i];
    EXPECT_NEAR(pressure,
                (consolidation.pores->content()[i] - dilatation) / consolidation.setup.storage,
                1e-8);
    EXPECT_NEAR(dilatation,
                (pressure - consolidation.load.at(1.0)) / consolidation.setup.stiffness[i], 1e-8);
  }
}

TEST(Splits, FixedStressConvergesAtAnyStrength) {
  for (const double value : {0.01, 1.0, 100.0, 1e6}) {
    Consolidation consolidation(strength(value), options(0.1, Split::fixed_stress, 60));
    EXPECT_TRUE(consolidation.manager.warnings().empty());
    EXPECT_NO_THROW(consolidation.run(1.0)) << value;
  }
}

TEST(Splits, FixedStressInOnePassWarnsOfAStrongCoupling) {
  const Consolidation strong(strength(50.0), options(0.1, Split::fixed_stress, 1));
  ASSERT_EQ(strong.manager.warnings().size(), 1u);
  EXPECT_THAT(strong.manager.warnings()[0], HasSubstr("coupling.iterations.max"));
  EXPECT_TRUE(Consolidation(strength(1.5), options(0.1, Split::fixed_stress, 1))
                  .manager.warnings()
                  .empty());
}

/// Pressures that springs hardly answer, as those that vary from point to point: of an error of
/// theirs a pass leaves nearly s / (1 + s).
TEST(Splits, OnePassIsStableInWindowsOfAnyLength) {
  for (const double value : {2.9, 5.7, 1e3, 1e9}) {
    const Consolidation::Setup setup{
        .stiffness = {1.0, 2.0, 100.0}, .storage = 1.0 / value, .conductance = 1.0 + 1.0 / value};
    for (double window = 1e-4; window < 2e4; window *= std::sqrt(10.0)) {
      Consolidation consolidation(
          setup, options(window, Split::fixed_stress, 1, AccelerationType::anderson));
      consolidation.run(1000.0 * window);
      for (const double pressure : consolidation.pores->pressure()) {
        EXPECT_LT(std::abs(pressure), 2.0) << "the load; " << value << ", windows of " << window;
      }
    }
  }
}

TEST(Splits, OnePassAtAStrongCouplingIsFirstOrderInTheWindow) {
  const auto error = [](double window) {
    const Consolidation::Setup setup{.stiffness = {1.0, 2.0, 100.0}, .storage = 0.01};
    Consolidation consolidation(
        setup, options(window, Split::fixed_stress, 1, AccelerationType::anderson));
    consolidation.run(2.0);
    return consolidation.content_error(2.0);
  };
  EXPECT_GE(order(error(0.02), error(0.01)), 0.9);
  EXPECT_GE(order(error(0.01), error(0.005)), 0.9);
  EXPECT_LT(error(0.005), 0.02);
}

TEST(Splits, IteratesByItselfWhereOnePassWouldNotHold) {
  CouplingOptions left_out = options(0.01, Split::fixed_stress, 1, AccelerationType::anderson);
  left_out.max_iterations.reset();
  left_out.tolerance = 1e-4;
  for (const double value : {1.0, 50.0}) {
    Consolidation consolidation(strength(value), left_out);
    EXPECT_TRUE(consolidation.manager.warnings().empty());
    consolidation.run(1.0);
    EXPECT_LT(consolidation.content_error(1.0), 1e-3) << value;
    EXPECT_EQ(consolidation.manager.pairs_too_strong_for_one_pass().empty(), value == 1.0);
  }
}

TEST(Splits, IteratesWhereAWindowWasNotForetold) {
  const auto work = [](double window, Split split, std::optional<int> iterations) {
    CouplingOptions left_out = options(window, split, 1, AccelerationType::anderson);
    left_out.max_iterations = iterations;
    Consolidation consolidation(strength(0.3), left_out);
    consolidation.manager.settle();
    const auto settling = consolidation.manager.work().passes;
    while (consolidation.manager.time() < 2.0) consolidation.manager.advance(2.0);
    return std::pair{consolidation.manager.work().passes - settling,
                     consolidation.content_error(2.0)};
  };
  for (const Split split : {Split::fixed_stress, Split::drained}) {
    EXPECT_EQ(work(0.01, split, {}), work(0.01, split, 1)) << "foretold well, the same bits";
  }
  const auto [passes, error] = work(0.5, Split::fixed_stress, {});
  const auto [one_each, error_of_one] = work(0.5, Split::fixed_stress, 1);
  EXPECT_GT(passes, one_each);
  EXPECT_LT(error, 0.5 * error_of_one);
  EXPECT_EQ(work(0.5, Split::drained, {}).first, one_each) << "which diverges at other strengths";
}

TEST(Splits, DrainedConvergesBelowStrengthOne) {
  Consolidation consolidation(strength(0.8), options(0.1, Split::drained, 200));
  EXPECT_TRUE(consolidation.manager.warnings().empty());
  consolidation.run(1.0);
  EXPECT_LT(consolidation.content_error(1.0), 1e-2);
}

TEST(Splits, DrainedWarnsAndDivergesFromStrengthOne) {
  Consolidation consolidation(strength(1.25), options(0.1, Split::drained, 200));
  ASSERT_EQ(consolidation.manager.warnings().size(), 1u);
  EXPECT_THAT(consolidation.manager.warnings()[0], HasSubstr("1.25"));
  EXPECT_THAT(consolidation.manager.warnings()[0], HasSubstr("fixed_stress"));
  try {
    consolidation.run(1.0);
    FAIL() << "did not diverge";
  } catch (const NumericalError& error) {
    EXPECT_EQ(error.field(), "dilatation");
    EXPECT_THAT(error.what(), HasSubstr("diverges"));
    EXPECT_THAT(error.what(), HasSubstr("coupling strength 1.25"));
  }
}

/// Extrapolating the inputs brings the limit of the drained split down to 1/3.
TEST(Splits, DrainedInOnePassIsBoundedBelowAThirdAndWarnsAbove) {
  const auto late_error = [](double value, bool expect_warning) {
    Consolidation consolidation(strength(value), options(0.02, Split::drained, 1));
    EXPECT_EQ(consolidation.manager.warnings().empty(), !expect_warning) << value;
    consolidation.run(4.0);
    return consolidation.content_error(4.0);
  };
  EXPECT_LT(late_error(0.30, false), 1e-3);
  EXPECT_GT(late_error(0.40, true), 1.0);
}

TEST(Splits, IterationsThatRunOutNameTheLink) {
  Consolidation consolidation(strength(0.8), options(0.1, Split::drained, 3));
  try {
    consolidation.run(1.0);
    FAIL() << "converged";
  } catch (const NumericalError& error) {
    EXPECT_THAT(error.what(), HasSubstr("does not converge (3 tries"));
    EXPECT_THAT(error.what(), HasSubstr("solid.dilatation -> pore_flow"));
  }
}

TEST(Splits, AccelerationSavesPasses) {
  const auto passes = [](AccelerationType type) {
    Consolidation consolidation(strength(0.9), options(0.1, Split::drained, 400, type));
    consolidation.run(1.0);
    return consolidation.manager.work().passes;
  };
  const auto plain = passes(AccelerationType::none);
  EXPECT_LT(passes(AccelerationType::aitken), plain / 2);
  EXPECT_LT(passes(AccelerationType::anderson), plain / 4);
}

TEST(Splits, OnePassAdvancesEachModuleOncePerWindow) {
  Consolidation consolidation({}, options(0.1, Split::fixed_stress, 1));
  consolidation.manager.settle();
  const auto before = consolidation.manager.modules()[1].advances;
  while (consolidation.manager.time() < 1.0) consolidation.manager.advance(1.0);
  EXPECT_EQ(consolidation.manager.modules()[1].advances - before, 10);
}

}  // namespace
}  // namespace perifrac
