#include "core/solvers/not_converged.hpp"

#include <fmt/format.h>

namespace perifrac {

NotConverged::NotConverged(int iterations, double residual)
    : std::runtime_error(fmt::format("conjugate gradients do not converge: {:.1e} of the load is "
                                     "left after {} iterations",
                                     residual, iterations)) {}

}  // namespace perifrac
