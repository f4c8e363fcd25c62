#pragma once

#include <utility>
#include <variant>

#include "core/geometry/gaussian_influence.hpp"
#include "core/geometry/wendland_influence.hpp"

namespace perifrac {

/// The influence of moving points on each other, one of those that there are. Sums ask which once a
/// point and not once a pair.
class PairInfluence {
 public:
  // Either stands for itself wherever one of them is asked for.
  PairInfluence(GaussianInfluence influence) : one_(influence) {}  // NOLINT
  PairInfluence(WendlandInfluence influence) : one_(influence) {}  // NOLINT

  /// use(influence), of its own type.
  template <class Use>
  decltype(auto) with(Use&& use) const {
    if (const auto* gaussian = std::get_if<GaussianInfluence>(&one_)) return use(*gaussian);
    return use(*std::get_if<WendlandInfluence>(&one_));
  }

  /// omega at r^2 [m^2]
  double operator()(double r_square) const {
    return with([&](const auto& influence) { return influence(r_square); });
  }

 private:
  std::variant<GaussianInfluence, WendlandInfluence> one_;
};

}  // namespace perifrac
