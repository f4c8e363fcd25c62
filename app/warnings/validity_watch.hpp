#pragma once

#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "app/simulation/simulation.hpp"
#include "core/config/section.hpp"

namespace perifrac {

/// Looks at a run now and then for what its modules cannot do: large strains and rotations, fluid
/// under suction that it does not bear, or far from the density that it was taken to have,
/// pressures that swing from point to point, rock that has come apart, fluid points in the rock,
/// and fluid that artificial viscosity holds back. Modules have no part in it, so that steps cost
/// nothing.
class ValidityWatch {
 public:
  ValidityWatch(const Section& scene, const Simulation& simulation);

  /// What is beyond a limit now and never was before, one sentence each. `is_output`: who reads the
  /// outputs sees the run as it stands; what passes between them is only told.
  std::vector<std::string> look(bool is_output);

  /// Whether it is time to, after so many windows, where nothing else calls for it: what swings
  /// does so soon after a jump.
  static bool is_due(std::int64_t step) { return (step & (step - 1)) == 0; }

 private:
  struct Limit {
    std::function<std::optional<std::string>()> find;  ///< says what is wrong, if something is
    bool may_pass = false;                             ///< before anything is written
    bool is_told = false;
  };

  void watch_strains(const Section& scene, const Simulation& simulation);
  void watch_pores(const Section& scene, const Simulation& simulation);
  void watch_swings(const Section& scene, const Simulation& simulation);
  void watch_density(const Section& scene, const Simulation& simulation);
  void watch_rubble(const Section& scene, const Simulation& simulation);
  void watch_leaks(const Section& scene, const Simulation& simulation);
  void watch_viscosity(const Section& scene, const Simulation& simulation);

  std::vector<Limit> limits_;
};

}  // namespace perifrac
