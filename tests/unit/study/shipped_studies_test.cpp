#include <filesystem>

#include <gtest/gtest.h>

#include "app/study/variants.hpp"

namespace perifrac {
namespace {

TEST(shipped_studies, set_what_their_scenes_have) {
  int count = 0;
  for (const auto& entry :
       std::filesystem::directory_iterator(PERIFRAC_SOURCE_DIR "/configs/studies")) {
    const Study study = read_study(entry.path().string());
    for (const Variant& variant : expand(study).variants) {
      EXPECT_EQ(variant.problem, "") << study.title << ": " << variant.name;
    }
    ++count;
  }
  EXPECT_EQ(count, 15);
}

}  // namespace
}  // namespace perifrac
