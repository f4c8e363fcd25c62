#include "core/base/names.hpp"

#include <algorithm>
#include <cctype>

#include <fmt/format.h>
#include <fmt/ranges.h>

namespace perifrac {
namespace {

constexpr std::size_t shown_names = 8;
constexpr std::size_t shown_characters = 60;

std::size_t typing_slips(std::string_view a, std::string_view b) {
  std::vector<std::vector<std::size_t>> slips(a.size() + 1, std::vector<std::size_t>(b.size() + 1));
  for (std::size_t i = 0; i <= a.size(); ++i) {
    for (std::size_t j = 0; j <= b.size(); ++j) {
      if (i == 0 || j == 0) {
        slips[i][j] = i + j;
        continue;
      }
      const bool same = std::tolower(static_cast<unsigned char>(a[i - 1])) ==
                        std::tolower(static_cast<unsigned char>(b[j - 1]));
      slips[i][j] = std::min(
          {slips[i - 1][j] + 1, slips[i][j - 1] + 1, slips[i - 1][j - 1] + (same ? 0 : 1)});
      if (i > 1 && j > 1 && a[i - 1] == b[j - 2] && a[i - 2] == b[j - 1]) {
        slips[i][j] = std::min(slips[i][j], slips[i - 2][j - 2] + 1);
      }
    }
  }
  return slips[a.size()][b.size()];
}

}  // namespace

std::string printable(std::string_view text) {
  std::string shown;
  for (const char c : text.substr(0, shown_characters)) {
    shown += std::iscntrl(static_cast<unsigned char>(c)) ? '?' : c;
  }
  return text.size() > shown_characters ? shown + "..." : shown;
}

std::string in_quotes(std::string_view text) { return fmt::format("'{}'", printable(text)); }

std::string nearest_name(std::string_view written, const std::vector<std::string>& known) {
  // Far longer than any name: nothing is near, and the table of slips would be huge.
  if (written.size() > shown_characters) return {};
  std::size_t fewest = 1 + std::max<std::size_t>(1, written.size() / 3);
  std::string nearest;
  for (const std::string& name : known) {
    const std::size_t slips = typing_slips(written, name);
    if (slips < std::min(fewest, name.size())) {
      fewest = slips;
      nearest = name;
    }
  }
  return nearest;
}

std::string list_names(const std::vector<std::string>& names) {
  const auto shown = names.begin() + static_cast<long>(std::min(names.size(), shown_names));
  return fmt::format("{}{}", fmt::join(names.begin(), shown, ", "),
                     names.size() > shown_names ? ", ..." : "");
}

std::string expected_one_of(const std::vector<std::string>& known, std::string_view written) {
  if (known.empty()) return "expected none";
  const std::string nearest = nearest_name(written, known);
  return fmt::format("expected one of: {}{}", list_names(known),
                     nearest.empty() ? "" : fmt::format("; did you mean '{}'?", nearest));
}

}  // namespace perifrac
