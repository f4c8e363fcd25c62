#include "core/config/range.hpp"

#include <charconv>
#include <limits>
#include <stdexcept>

namespace perifrac {
namespace {

/// Reads a bound at `first` and moves `first` behind it.
double read_bound(const char*& first, const char* last) {
  double bound = 0.0;
  const auto [end, error] = std::from_chars(first, last, bound);
  if (error != std::errc{}) throw std::logic_error("a range needs two bounds");
  first = end;
  return bound;
}

}  // namespace

Range::Range(const std::string& declared)
    : lowest_(-std::numeric_limits<double>::infinity()),
      highest_(std::numeric_limits<double>::infinity()) {
  if (declared.empty()) return;
  const std::logic_error malformed("range '" + declared + "' is not as in '[0, 0.5)'");
  const char opening = declared.front();
  const char closing = declared.back();
  if ((opening != '(' && opening != '[') || (closing != ')' && closing != ']')) throw malformed;
  const char* first = declared.data() + 1;
  const char* last = declared.data() + declared.size() - 1;
  lowest_ = read_bound(first, last);
  if (last - first < 2 || first[0] != ',' || first[1] != ' ') throw malformed;
  first += 2;
  highest_ = read_bound(first, last);
  if (first != last || !(lowest_ <= highest_)) throw malformed;
  lowest_included_ = opening == '[';
  highest_included_ = closing == ']';
}

bool Range::holds(double value) const {
  const bool above = lowest_included_ ? value >= lowest_ : value > lowest_;
  const bool below = highest_included_ ? value <= highest_ : value < highest_;
  return above && below;
}

}  // namespace perifrac
