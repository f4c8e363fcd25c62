#pragma once

#include <filesystem>
#include <fstream>
#include <string>
#include <unistd.h>

#include "app/study/study_file.hpp"
#include "core/base/errors.hpp"

namespace perifrac::test {

/// A study of configs/mandel.yaml in a folder of its own.
class StudyFixture {
 public:
  StudyFixture()
      : folder_(std::filesystem::temp_directory_path() /
                ("unit_study." + std::to_string(getpid()))) {
    std::filesystem::create_directories(folder_);
  }
  ~StudyFixture() { std::filesystem::remove_all(folder_); }
  StudyFixture(const StudyFixture&) = delete;
  StudyFixture& operator=(const StudyFixture&) = delete;

  const std::filesystem::path& folder() const { return folder_; }

  Study read(const std::string& text) const {
    const auto file = folder_ / "study.yaml";
    std::ofstream(file) << text;
    return read_study(file.string());
  }

  /// What is said against it, without the folder; "accepted" for nothing.
  std::string refusal(const std::string& text) const {
    try {
      read(text);
    } catch (const InputError& error) {
      return without_folder(error.what());
    }
    return "accepted";
  }

  std::string without_folder(std::string text) const {
    const std::string prefix = folder_.string() + "/";
    for (auto at = text.find(prefix); at != text.npos; at = text.find(prefix)) {
      text.erase(at, prefix.size());
    }
    return text;
  }

 private:
  std::filesystem::path folder_;
};

inline const std::string scene_line =
    std::string("scene: ") + PERIFRAC_SOURCE_DIR + "/configs/mandel.yaml\n";

inline const std::string error_lines = "error: {against: reference, quantity: pressure_error}\n";

inline const std::string two_axes =
    "axes:\n"
    "  - name: integrator\n"
    "    values: {explicit: {pore_flow.integrator.type: explicit}, cvode: {}}\n"
    "  - name: dx\n"
    "    key: body.spacing\n"
    "    values: [2 m, 1 m, 50 cm]\n";

}  // namespace perifrac::test
