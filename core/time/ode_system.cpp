#include "core/time/ode_system.hpp"

#include "core/time/spectral_radius.hpp"

namespace perifrac {

double OdeSystem::fastest_rate(double t) {
  return spectral_radius(name(), t, size(), size() - accumulators(),
                         [&](std::span<const double> v, std::span<double> product) {
                           jacobian_times(t, {}, v, product);
                         });
}

}  // namespace perifrac
