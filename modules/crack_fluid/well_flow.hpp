#pragma once

#include <algorithm>
#include <span>
#include <vector>

#include <Eigen/Core>

#include "core/base/points.hpp"

namespace perifrac {

/// What a well brings to the facets that it feeds over a step. Its openings are at one pressure
/// p_w, and through each goes what that drives beyond the facet's,
///   p_w - p_f = (R |q| + r) q,   sum q = Q,
/// out of a crack as well as into one. The laminar r q is a few pascal of the whole rate: without
/// friction it shares the rate where nothing else does. The least p_w is the vapour pressure: a
/// well takes out no more than comes.
///
/// It is solved with the cracks' own balance, q and p_w eliminated by the law's tangent at a guess
/// of q: of what the last tangent and what the law make of the facets' new pressures the smaller
/// one. Either alone goes in circles or takes long, this takes four iterations and never more than
/// ten beside a crack that answers in proportion to what it gets.
class WellFlow {
 public:
  struct Opening {
    Index facet;
    double resistance;   ///< R [Pa s^2/m^6], in 2D [Pa s^2/m^4]
    double rate;         ///< where Newton begins [m^3/s], in 2D [m^2/s]; then the solution
    double part = 1.0;   ///< of the perforations that R is of
    double slope = 0.0;  ///< dq / d(p_w - p_f)
    double lost = 0.0;   ///< p_w - p_f that belongs to the rate by the tangent [Pa]
  };
  struct Law {
    double laminar;         ///< r [Pa s/m^3], in 2D [Pa s/m^2]
    double least_pressure;  ///< [Pa]
    double known_pressure;  ///< what pressures are known to a billionth of at least [Pa]
  };
  /// `rate` Q: as an opening's.
  WellFlow(std::vector<Opening> openings, double rate, const Law& law);

  /// Newton begins anew.
  void begin();
  /// To other pressures of the facets [Pa].
  void follow(const Eigen::VectorXd& pressure);
  /// The rates are those of the law, to a billionth of the pressure.
  bool is_settled() const { return is_settled_; }

  const std::vector<Opening>& openings() const { return openings_; }
  double pressure() const { return pressure_; }  ///< p_w [Pa]
  /// dq_a / dp_b, b the facet of another opening or the same.
  double slope(std::size_t a, std::size_t b) const;

 private:
  double loss(const Opening& opening) const;
  double driven_by(double fall, const Opening& opening) const;
  void guess(const Eigen::VectorXd& pressure);
  void take_tangents();
  void share(const Eigen::VectorXd& pressure);

  std::vector<Opening> openings_, at_begin_;
  double rate_;
  Law law_;
  bool has_begun_ = false, is_settled_ = false;
  bool brings_all_ = true;  ///< sum q = Q; else p_w is the least there is
  double pressure_ = 0.0, slopes_ = 0.0;
};

inline void begin(std::span<WellFlow> wells) {
  for (WellFlow& well : wells) well.begin();
}
inline bool are_settled(std::span<const WellFlow> wells) {
  return std::ranges::all_of(wells, &WellFlow::is_settled);
}

}  // namespace perifrac
