#pragma once

namespace perifrac {

/// Diffusion in a slab that is sealed at xi = 0 and, from T = 0 on, held at zero at xi = 1, from a
/// uniform 1; T = c t / H^2. Images (erfc) at short times, the Fourier series afterwards: Carslaw
/// and Jaeger, Conduction of Heat in Solids, sections 3.4 and 3.5.
namespace slab_drainage {

/// The value at xi; 1 at T <= 0.
double value(double xi, double T);
/// Its integral from 0 to xi.
double integral(double xi, double T);

}  // namespace slab_drainage

}  // namespace perifrac
