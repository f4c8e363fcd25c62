#include "app/run/failure.hpp"

#include <new>
#include <stdexcept>

#include <gtest/gtest.h>

#include "core/base/errors.hpp"

namespace perifrac {
namespace {

TEST(Failure, HasFieldPlaceTimeAndWhatToChange) {
  const NumericalError error("crack_pressure", "facet, point 3 at (1, 2) m", 91.0,
                             "no balance of mass, in however short a step,");
  const Failure failure = failure_of(error);
  EXPECT_EQ(failure.error, error.what());
  EXPECT_EQ(failure.field, "crack_pressure");
  EXPECT_EQ(failure.place, "facet, point 3 at (1, 2) m");
  EXPECT_EQ(failure.time, 91.0);
  EXPECT_NE(failure.advice.find("no room"), std::string::npos);
  EXPECT_NE(failure.advice.find("crack_fluid.residual_aperture"), std::string::npos);
  EXPECT_EQ(describe(failure), failure.error + "; " + failure.advice);
}

TEST(Failure, KnowsNothingThatHelpsAgainstAnythingElse) {
  const Failure failure = failure_of(std::runtime_error("the sparse matrix is too large"));
  EXPECT_EQ(describe(failure), "the sparse matrix is too large");
  EXPECT_FALSE(failure.time);
}

TEST(Failure, NamesMemory) { EXPECT_EQ(failure_of(std::bad_alloc()).error, "out of memory"); }

}  // namespace
}  // namespace perifrac
