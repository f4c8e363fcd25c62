#include "core/bonds/bond_weights.hpp"

#include <algorithm>
#include <bit>
#include <cmath>

namespace perifrac {

namespace {

constexpr std::size_t most_numbers = 256;  // that a byte tells apart

}  // namespace

BondWeightList::BondWeightList(std::size_t bonds) : bonds_(bonds) {
  weights_.table_ = {0.0};
  weights_.code_.reserve(bonds);
}

std::optional<std::uint8_t> BondWeightList::place_of(double weight) {
  std::vector<double>& table = weights_.table_;
  constexpr double rounding = 1e-12;
  const auto is_it = [&](double known) {
    return std::abs(known - weight) <= rounding * std::abs(weight);
  };
  std::uint8_t& guess = guess_[(std::bit_cast<std::uint64_t>(weight) >> 32) % guess_.size()];
  if (is_it(table[guess])) return guess;
  const auto found = std::ranges::find_if(table, is_it);
  const auto place = static_cast<std::size_t>(found - table.begin());
  if (place == most_numbers) return {};
  if (found == table.end()) table.push_back(weight);
  guess = static_cast<std::uint8_t>(place);
  return guess;
}

void BondWeightList::add(std::span<const double> weights) {
  for (const double weight : weights) {
    if (weights_.all_.empty()) {
      if (const auto place = place_of(weight)) {
        weights_.code_.push_back(*place);
        continue;
      }
      weights_.unpack();
      weights_.all_.reserve(bonds_);
    }
    weights_.all_.push_back(weight);
  }
}

void BondWeights::pack() {
  if (is_packed() || all_.empty()) return;
  BondWeightList list(all_.size());
  for (const double& weight : all_) {
    list.add({&weight, 1});
    if (!list.is_packed()) return;
  }
  *this = list.take();
}

void BondWeights::unpack() {
  if (!is_packed()) return;
  all_.reserve(code_.size());
  for (const std::uint8_t code : code_) all_.push_back(table_[code]);
  code_ = std::vector<std::uint8_t>();  // gives its memory back, as {} would not
  table_ = std::vector<double>();
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
    unpack();
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
