#pragma once

#include <optional>
#include <string>

#include "app/simulation/simulation.hpp"
#include "core/config/section.hpp"

namespace perifrac {

/// Finds where fluid has hardly entered a crack when a run ends, or when what was pumped begins to
/// flow back or leak off: what fills a facet or two has no pressure and no opening yet that would
/// not depend on how long facets are.
class FillingWatch {
 public:
  FillingWatch(const Section& scene, const Simulation& simulation)
      : scene_(scene), simulation_(simulation) {}

  void look();
  std::optional<std::string> warning() const;

 private:
  Section scene_;
  const Simulation& simulation_;
  double time_ = 0.0;    ///< of the last look that counts [s]
  double filled_ = 0.0;  ///< a length, in 3D the radius of a disc; each wing's [m]
  double dry_ = 0.0;     ///< likewise, of what lags behind the tips
};

/// Where a good part of what leaks off does so from closed cracks that fluid has just come to: it
/// fills the facet before an open one at once, as there is hardly room in it. Where few are open,
/// few before them count as well.
std::optional<std::string> closed_front_warning(const Section& scene, const Simulation& simulation);

/// Where all that is pumped leaks off at once, so that no pressure builds up.
std::optional<std::string> leaked_away_warning(const Section& scene, const Simulation& simulation);

/// Where cracks that are pumped, and may grow, end hardly wider than what closed ones keep.
std::optional<std::string> residual_aperture_warning(const Section& scene,
                                                     const Simulation& simulation);

/// Where waves in rock with inertia have gone a few spacings by `time` [s]: what a blow has brought
/// in until then is what points so far apart take, not rock.
std::optional<std::string> wave_warning(const Section& scene, double time);

/// Where pressure has gone less than a spacing into the pores by `time` [s], from a face that holds
/// it or a crack: what seeps then is what points so far apart take, not rock.
std::optional<std::string> seepage_warning(const Section& scene, double time);
/// Of a run as it ends: not below free fluid where pressures fall evenly, as they do where the
/// scene begins with the flow that comes to be.
std::optional<std::string> seepage_warning(const Section& scene, const Simulation& simulation);

}  // namespace perifrac
