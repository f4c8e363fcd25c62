#pragma once

#include <span>

#include <Eigen/Core>

#include "core/module/time_window.hpp"
#include "modules/crack_fluid/leak_off.hpp"
#include "modules/crack_fluid/well_flow.hpp"

namespace perifrac {

/// How wide the facets would be if closed faces did not press on each other:
/// value + rate (t - end) + slope p at time t under the fluid's pressures p, of all facets. Where
/// that is negative, faces close: contact adds to p there what keeps them from overlapping.
struct CrackOpening {
  /// `compliance`: count * count values, row by row.
  CrackOpening(std::span<const double> opening, std::span<const double> opening_rate,
               std::span<const double> compliance, double window_end)
      : value(opening),
        rate(opening_rate),
        slope(Eigen::Map<const Eigen::Matrix<double, -1, -1, Eigen::RowMajor>>(
            compliance.data(), static_cast<Index>(value.size()), static_cast<Index>(value.size()))),
        end(window_end) {}

  std::span<const double> value;  ///< [m]
  std::span<const double> rate;   ///< [m/s]
  Eigen::MatrixXd slope;          ///< [m/Pa]
  double end;                     ///< [s]
};

/// Fluid that comes in at a facet over a step: `least` to `most` [kg], in 2D per metre, within
/// which it holds the pressure `target` [Pa], less `stiffness` [Pa m/kg] times what comes in; above
/// that it takes the least, below it the most.
struct FacetInflow {
  Index facet;
  double least;
  double most;
  double target;
  double stiffness = 0.0;
};

/// One step of the fluid in cracks.
struct CrackStep {
  TimeWindow time;
  CrackOpening opening;
  std::span<const double> mass;        ///< of the facets when it begins [kg/m]
  std::span<const double> aperture{};  ///< likewise, which tells what faces may touch; or empty [m]
  std::span<const FacetInflow> inflows{};
  std::span<WellFlow> wells{};  ///< at facets of their own; they are solved with the fluid
  LeakOff* leak_off = nullptr;  ///< may be null
};

}  // namespace perifrac
