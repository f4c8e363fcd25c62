#pragma once

#include "modules/fluid/method/fluid_method.hpp"

namespace perifrac {

/// `sph`, weakly compressible smoothed particle hydrodynamics with the diffusion of density of
/// delta-SPH: Wendland's C2 kernel, and no shape tensors.
FluidMethodType sph_method();

}  // namespace perifrac
