#include <filesystem>

#include <gtest/gtest.h>

#include "tests/fuzz/read_any_checkpoint.hpp"
#include "tests/fuzz/read_any_scene.hpp"

namespace perifrac {
namespace {

std::vector<std::string> files_in(const std::string& folder) {
  std::vector<std::string> files;
  for (const auto& entry : std::filesystem::directory_iterator(PERIFRAC_SOURCE_DIR "/" + folder)) {
    if (entry.is_regular_file()) files.push_back(entry.path());
  }
  EXPECT_FALSE(files.empty()) << folder;
  return files;
}

TEST(FuzzReplay, ScenesThatOnceWentWrongAreReadOrRefused) {
  for (const char* folder : {"tests/fuzz/regressions/scene", "configs", "tests/config_errors"}) {
    for (const std::string& file : files_in(folder)) {
      EXPECT_NO_THROW(read_any_scene(file)) << file;
    }
  }
}

TEST(FuzzReplay, CheckpointsThatOnceWentWrongAreReadOrRefused) {
  for (const std::string& file : files_in("tests/fuzz/regressions/checkpoint")) {
    EXPECT_NO_THROW(read_any_checkpoint(file)) << file;
  }
}

}  // namespace
}  // namespace perifrac
