#include "core/bonds/bond_weights.hpp"

#include <algorithm>
#include <bit>
#include <cmath>

namespace perifrac {

namespace {

constexpr std::size_t most_numbers = 256;  // that a byte tells apart

}  // namespace

BondWeightList::BondWeightList() {
  weights_.is_packed_ = true;
  weights_.table_ = {0.0};
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

bool BondWeightList::find_codes(std::span<const double> weights) {
  row_.clear();
  for (const double weight : weights) {
    const auto place = place_of(weight);
    if (!place) return false;
    row_.push_back(*place);
  }
  return true;
}

void BondWeightList::add(std::span<const double> weights) {
  if (is_packed()) {
    if (find_codes(weights)) {
      codes_.add(row_);
      return;
    }
    weights_.code_ = codes_.take();
    weights_.unpack();
  }
  weights_.all_.add(weights);
}

BondWeights BondWeightList::take() {
  if (is_packed()) weights_.code_ = codes_.take();
  return std::move(weights_);
}

void BondWeights::pack() {
  if (is_packed_) return;
  BondWeightList list;
  for (Index i = 0; i < all_.count(); ++i) {
    list.add(all_[i]);
    if (!list.is_packed()) return;
  }
  *this = list.take();
}

void BondWeights::unpack() {
  if (!is_packed_) return;
  all_.reserve(code_.count(), code_.total());
  std::vector<double> weights;
  for (Index i = 0; i < code_.count(); ++i) {
    weights.clear();
    for (const std::uint8_t code : code_[i]) weights.push_back(table_[code]);
    all_.add(weights);
  }
  is_packed_ = false;
  code_ = {};
  table_ = std::vector<double>();
}

void BondWeights::set(Index i, Index k, double weight) {
  if (is_packed_) {
    const auto found = std::ranges::find(table_, weight);
    const auto place = static_cast<std::size_t>(found - table_.begin());
    if (place < most_numbers) {
      if (found == table_.end()) table_.push_back(weight);
      code_.own(i)[k] = static_cast<std::uint8_t>(place);
      return;
    }
    unpack();
  }
  all_.own(i)[k] = weight;
}

bool BondWeights::operator==(const BondWeights& other) const {
  if (point_count() != other.point_count()) return false;
  for (Index i = 0; i < point_count(); ++i) {
    if (bond_count(i) != other.bond_count(i)) return false;
    for (Index k = 0; k < bond_count(i); ++k) {
      if ((*this)(i, k) != other(i, k)) return false;
    }
  }
  return true;
}

}  // namespace perifrac
