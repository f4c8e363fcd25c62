#include "coupling/summed_input.hpp"

#include <algorithm>

namespace perifrac {

std::size_t SummedInput::add(std::string source) {
  shares_.push_back({.source = std::move(source), .values = {}, .passed = {}});
  return shares_.size() - 1;
}

void SummedInput::add_up(std::size_t begin, std::size_t end, std::span<double> sum) const {
  std::ranges::fill(sum, 0.0);
  for (std::size_t place = begin; place < end; ++place) {
    const std::vector<double>& values = shares_[place].values;
    if (values.empty()) continue;
    require(values.size() == sum.size(), "a share on other points than the in-port's");
    for (std::size_t i = 0; i < sum.size(); ++i) sum[i] += values[i];
  }
}

void SummedInput::accept(std::size_t place) {
  for (const double value : shares_[place].values) shares_[place].passed.add(value);
}

}  // namespace perifrac
