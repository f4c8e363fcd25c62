#include "app/report/export.hpp"

#include <algorithm>
#include <array>
#include <charconv>
#include <filesystem>

#include <fmt/format.h>

#include "app/installation/data_folder.hpp"
#include "app/report/drawing.hpp"
#include "core/base/errors.hpp"
#include "core/config/units.hpp"

namespace perifrac {

namespace {

/// As the script takes it: a word, a number of a frame, or `t=SECONDS`.
std::string frame_words(const std::string& frame) {
  constexpr std::array words = {"first", "last", "all"};
  if (std::ranges::find(words, frame) != words.end()) return frame;
  if (!frame.empty() && std::ranges::all_of(frame, [](char c) { return c >= '0' && c <= '9'; })) {
    return frame;
  }
  try {
    return fmt::format("t={}", to_si(frame, "s"));
  } catch (const QuantityError& error) {
    throw InputError(fmt::format(
        "--frame: {}; expected first, last, all, a number from 0, or a time such as '5 ms'",
        error.what()));
  }
}

}  // namespace

int export_frames(const ExportRequest& request) {
  const std::string output = request.output.empty()
                                 ? (std::filesystem::path(request.folder) / "export").string()
                                 : request.output;
  return draw(data_folder() / "app/report/export.py",
              {request.folder, frame_words(request.frame), request.to, output}, false);
}

}  // namespace perifrac
