#pragma once

#include <cstdint>
#include <memory>
#include <vector>

#include "tests/unit/solid/elastic.hpp"

namespace perifrac::test {

/// The materials whose bonds may break.
enum class Rock { linear_exact, lps };
inline constexpr std::array rocks = {Rock::linear_exact, Rock::lps};
inline const char* name(Rock rock) { return rock == Rock::lps ? "lps" : "linear_exact"; }

template <int D>
std::shared_ptr<BreakableElasticity<D>> breakable(Rock rock, std::shared_ptr<Family<D>> family,
                                                  const MirrorCondition<D, D>& mirror,
                                                  IsotropicElasticity<D> law) {
  using Law = IsotropicElasticity<D>;
  if (rock == Rock::lps) {
    const std::vector<std::uint8_t> regions(family->point_count, 0);
    return std::make_shared<LpsElasticity<D>>(family, mirror, LawByRegion<Law>{{law}, regions});
  }
  return std::make_shared<LinearExactElasticity<D, Law>>(
      LinearExactOperator<D, Law>(family, mirror, law));
}

}  // namespace perifrac::test
