#pragma once

namespace perifrac {

/// Diffusion into a slab that is held at 0 at xi = 0 and, from T = 0 on, at 1 at xi = 1, from 0 all
/// over; T = c t / L^2. Images at short times, the Fourier series afterwards: Carslaw and Jaeger,
/// Conduction of Heat in Solids, sections 3.4 and 12.5. All are 0 at T <= 0.
namespace slab_inflow {

/// The value at xi.
double value(double xi, double T);
/// Its integral over time from 0: the answer to a boundary value that grows as T.
double value_integral(double xi, double T);
/// What has come in at xi = 1: the integral of the gradient there over time.
double inflow(double T);
/// Its integral over time from 0.
double inflow_integral(double T);

}  // namespace slab_inflow

}  // namespace perifrac
