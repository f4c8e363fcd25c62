#pragma once

#include <bit>
#include <cstdint>
#include <ranges>

namespace perifrac {

/// A number that other values all but never have.
class Digest {
 public:
  void add(const std::ranges::range auto& values) {
    for (const auto value : values) {
      hash_ = std::rotl(hash_ ^ std::bit_cast<std::uint64_t>(value), 29);
      hash_ *= 0x9e3779b97f4a7c15;  // an odd number without a pattern
    }
  }
  /// Such that its negative is a number, too.
  std::int64_t value() const { return static_cast<std::int64_t>(hash_ >> 1); }

 private:
  std::uint64_t hash_ = 0;
};

}  // namespace perifrac
