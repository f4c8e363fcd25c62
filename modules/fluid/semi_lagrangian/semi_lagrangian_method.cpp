#include "modules/fluid/semi_lagrangian/semi_lagrangian_method.hpp"

#include "modules/fluid/semi_lagrangian/find_moments.hpp"
#include "modules/fluid/semi_lagrangian/fluid_momentum.hpp"

namespace perifrac {

namespace {

template <int D>
class SemiLagrangianMethod final : public FluidMethod<D> {
 public:
  explicit SemiLagrangianMethod(const FluidScheme& scheme)
      : gaussian_(scheme.horizon), influence_(gaussian_) {}

  const PairInfluence& influence() const override { return influence_; }
  void find_moments(const FluidPoints<D>& points, const NearWalls<D>& walls,
                    const FluidNeighbours<D>& neighbours, FluidMoments<D>& moments) override {
    perifrac::find_moments<D>(points, walls, neighbours, gaussian_, moment_values_, moments);
  }
  void find_forces(const FluidStep<D>& step, FluidForces<D>& forces) override {
    find_pair_forces<D>(step, gaussian_, force_values_, forces);
  }

 private:
  GaussianInfluence gaussian_;
  PairInfluence influence_;
  FluidValues<D> moment_values_;
  ForceValues<D> force_values_;
};

template <int D>
std::unique_ptr<FluidMethod<D>> make_method(const FluidScheme& scheme) {
  return std::make_unique<SemiLagrangianMethod<D>>(scheme);
}

}  // namespace

FluidMethodType semi_lagrangian_method() {
  return {.name = "semi_lagrangian",
          .meaning = "Free fluid on moving points, weakly compressible; explicit.",
          .fallbacks = {},
          .make = {make_method<2>, make_method<3>}};
}

}  // namespace perifrac
