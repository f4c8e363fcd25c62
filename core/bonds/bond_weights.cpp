#include "core/bonds/bond_weights.hpp"

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>

namespace perifrac {

namespace {

constexpr std::size_t most_numbers = 256;  // that a byte tells apart

/// Finds places in a table of few numbers, most of them at once.
class TableSearch {
 public:
  explicit TableSearch(std::vector<double>& table) : table_(table) {}

  /// The place of a number, up to rounding; `most_numbers` where there is no room for it any more.
  std::size_t place_of(double number) {
    constexpr double rounding = 1e-12;
    const auto is_it = [&](double known) {
      return std::abs(known - number) <= rounding * std::abs(number);
    };
    std::uint8_t& guess = guess_[(std::bit_cast<std::uint64_t>(number) >> 32) % guess_.size()];
    if (is_it(table_[guess])) return guess;
    const auto found = std::ranges::find_if(table_, is_it);
    const auto place = static_cast<std::size_t>(found - table_.begin());
    if (place == most_numbers) return most_numbers;
    if (found == table_.end()) table_.push_back(number);
    guess = static_cast<std::uint8_t>(place);
    return place;
  }

 private:
  std::vector<double>& table_;
  std::array<std::uint8_t, 4096> guess_{};  ///< by leading digits
};

}  // namespace

void BondWeights::pack() {
  if (is_packed() || all_.empty()) return;
  std::vector<double> table = {0.0};
  std::vector<std::uint8_t> code;
  TableSearch search(table);
  for (const double weight : all_) {
    const std::size_t place = search.place_of(weight);
    if (place == most_numbers) return;
    if (code.empty()) code.reserve(all_.size());
    code.push_back(static_cast<std::uint8_t>(place));
  }
  code_ = std::move(code);
  table_ = std::move(table);
  all_ = std::vector<double>();  // gives its memory back, as {} would not
}

void BondWeights::set(std::size_t bond, double weight) {
  if (is_packed()) {
    const auto found = std::ranges::find(table_, weight);
    const auto place = static_cast<std::size_t>(found - table_.begin());
    if (place < most_numbers) {
      if (found == table_.end()) table_.push_back(weight);
      code_[bond] = static_cast<std::uint8_t>(place);
      return;
    }
    for (const std::uint8_t code : code_) all_.push_back(table_[code]);
    code_ = std::vector<std::uint8_t>();
    table_ = std::vector<double>();
  }
  all_[bond] = weight;
}

bool BondWeights::operator==(const BondWeights& other) const {
  if (size() != other.size()) return false;
  for (std::size_t bond = 0; bond < size(); ++bond) {
    if ((*this)[bond] != other[bond]) return false;
  }
  return true;
}

}  // namespace perifrac
