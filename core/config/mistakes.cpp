#include "core/config/mistakes.hpp"

#include <algorithm>
#include <cctype>

#include <fmt/format.h>
#include <fmt/ranges.h>

namespace perifrac {

namespace {

constexpr std::size_t most_shown = 50;

/// Line and column of `file:line:column: ...`; the largest there are where there is no such place,
/// as behind --set.
std::pair<unsigned long, unsigned long> place_of(const std::string& mistake) {
  const auto number_at = [&](std::size_t& at) {
    unsigned long number = 0;
    const std::size_t first = at;
    while (at < mistake.size() && at < first + 9 && std::isdigit(mistake[at]) != 0) {
      number = 10 * number + static_cast<unsigned long>(mistake[at++] - '0');
    }
    return at > first && at < mistake.size() && mistake[at] == ':' ? number : -1UL;
  };
  for (std::size_t colon = mistake.find(':'); colon != std::string::npos;
       colon = mistake.find(':', colon + 1)) {
    std::size_t at = colon + 1;
    const unsigned long line = number_at(at);
    if (line == -1UL) continue;
    ++at;
    if (const unsigned long column = number_at(at); column != -1UL) return {line, column};
  }
  return {-1UL, -1UL};
}

}  // namespace

void Mistakes::add(std::string_view lines) {
  while (!lines.empty()) {
    const auto end = std::min(lines.find('\n'), lines.size());
    std::string line(lines.substr(0, end));
    lines.remove_prefix(std::min(end + 1, lines.size()));
    if (std::ranges::find(lines_, line) == lines_.end()) lines_.push_back(std::move(line));
  }
  if (lines_.size() < most_shown) return;
  lines_.resize(most_shown);
  lines_.push_back(fmt::format("only the first {} mistakes are shown", most_shown));
  throw_if_any();
}

void Mistakes::throw_if_any() const {
  if (lines_.empty()) return;
  std::vector<std::string> sorted = lines_;
  std::ranges::stable_sort(sorted, {}, place_of);
  throw InputError(fmt::format("{}", fmt::join(sorted, "\n")));
}

}  // namespace perifrac
