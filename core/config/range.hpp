#pragma once

#include <string>

namespace perifrac {

/// An interval of numbers, declared as in `(0, inf)` or `[0, 0.5)`; the empty text holds any.
class Range {
 public:
  /// Throws std::logic_error: ranges come from tables of keys, not from users.
  explicit Range(const std::string& declared);

  bool holds(double value) const;

  double lowest() const { return lowest_; }
  double highest() const { return highest_; }
  bool includes_lowest() const { return lowest_included_; }
  bool includes_highest() const { return highest_included_; }

 private:
  double lowest_;
  double highest_;
  bool lowest_included_ = false;
  bool highest_included_ = false;
};

}  // namespace perifrac
