#include "core/profile/profile.hpp"

#include <chrono>
#include <optional>
#include <stdexcept>
#include <string>
#include <thread>
#include <vector>

#include <gtest/gtest.h>

#include "tests/sanitized.hpp"

namespace perifrac {
namespace {

using Clock = std::chrono::steady_clock;

void spend(double seconds) {
  const auto begin = Clock::now();
  while (std::chrono::duration<double>(Clock::now() - begin).count() < seconds) {
  }
}

const Profile::Part& part(Profile& profile, const std::string& name) {
  for (const Profile::Part& each : profile.parts()) {
    if (each.name == name) return each;
  }
  throw std::logic_error("no part " + name);
}

TEST(Profile, IsNotThereUntilSomebodyAsks) {
  EXPECT_EQ(Profile::active(), nullptr);
  { const ProfilePart unseen("unseen"); }
  Profile profile;
  EXPECT_EQ(Profile::active(), &profile);
  EXPECT_EQ(profile.parts().size(), 1u);
}

/// A part that ends after its profile began belongs to nobody: it was not asked for.
TEST(Profile, LeavesOutWhatBeganBefore) {
  std::optional<Profile> profile;
  {
    const ProfileScope before("before");
    profile.emplace();
  }
  EXPECT_EQ(profile->parts().size(), 1u);
}

TEST(Profile, GivesEachPartWhatItTookItself) {
  Profile profile;
  for (int n = 0; n < 3; ++n) {
    const ProfilePart outer("outer");
    spend(0.002);
    const ProfileScope inner("inner");
    spend(0.004);
  }
  const Profile::Part inner = part(profile, "inner"), outer = part(profile, "outer");
  EXPECT_EQ(inner.calls, 3);
  EXPECT_EQ(outer.calls, 3);
  EXPECT_GE(inner.seconds, 0.012);
  EXPECT_GE(outer.seconds, 0.006);
  EXPECT_EQ(profile.parts()[inner.within].name, "outer");
  EXPECT_EQ(outer.within, 0);
}

TEST(Profile, TellsPartsOfOneNameApartByWhereTheyLie) {
  Profile profile;
  {
    const ProfileScope solid("solid");
    const ProfileScope solves("solves");
  }
  const ProfileScope solves("solves");
  EXPECT_EQ(profile.parts().size(), 4u);
}

/// With a sanitizer's heap there is nothing to weigh.
TEST(Profile, WeighsWhatIsHeld) {
  if (test::sanitized) GTEST_SKIP();
  Profile profile;
  std::vector<double> held, more;
  {
    const ProfilePart outer("outer");
    held.resize(1'000'000);
    {
      const ProfilePart inner("inner");
      more.resize(500'000);
      std::vector<double> for_a_while(2'000'000);
    }
    const ProfileScope timed("timed");
    more.resize(more.size());
  }
  EXPECT_NEAR(static_cast<double>(part(profile, "outer").bytes), 8e6, 1e5);
  EXPECT_NEAR(static_cast<double>(part(profile, "inner").bytes), 4e6, 1e5);
  EXPECT_EQ(part(profile, "timed").bytes, 0);
  {
    const ProfilePart later("later");
    held = {};
    held.shrink_to_fit();
  }
  EXPECT_NEAR(static_cast<double>(part(profile, "later").bytes), -8e6, 1e5);
  EXPECT_GT(profile.resident_at_start(), 0);
}

TEST(Profile, WatchesItsOwnThread) {
  Profile profile;
  std::thread other([] {
    EXPECT_EQ(Profile::active(), nullptr);
    const ProfilePart unseen("unseen");
  });
  other.join();
  EXPECT_EQ(profile.parts().size(), 1u);
}

}  // namespace
}  // namespace perifrac
