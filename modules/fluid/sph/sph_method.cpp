#include "modules/fluid/sph/sph_method.hpp"

#include "modules/fluid/sph/sph_moments.hpp"
#include "modules/fluid/sph/sph_momentum.hpp"

namespace perifrac {

namespace {

template <int D>
class SphMethod final : public FluidMethod<D> {
 public:
  explicit SphMethod(const FluidScheme& scheme)
      : wendland_(scheme.horizon), influence_(wendland_) {}

  const PairInfluence& influence() const override { return influence_; }
  void find_moments(const FluidPoints<D>& points, const NearWalls<D>& walls,
                    const FluidNeighbours<D>& neighbours, FluidMoments<D>& moments) override {
    moments_.find(points, walls, neighbours, wendland_, values_, moments);
  }
  void find_forces(const FluidStep<D>& step, FluidForces<D>& forces) override {
    find_sph_forces<D>(step, wendland_, values_, forces);
  }

 private:
  WendlandInfluence wendland_;
  PairInfluence influence_;
  SphMoments<D> moments_;
  FluidValues<D> values_;
};

template <int D>
std::unique_ptr<FluidMethod<D>> make_sph(const FluidScheme& scheme) {
  return std::make_unique<SphMethod<D>>(scheme);
}

}  // namespace

FluidMethodType sph_method() {
  return {.name = "sph",
          .meaning =
              "Free fluid by smoothed particle hydrodynamics, weakly compressible, with the "
              "density diffusion of delta-SPH; explicit.",
          .fallbacks = {{"horizon_ratio", "3"}, {"particle_shifting", "0.5"}},
          .make = {make_sph<2>, make_sph<3>}};
}

}  // namespace perifrac
