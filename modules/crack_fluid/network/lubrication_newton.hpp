#pragma once

#include "modules/crack_fluid/network/lubrication.hpp"

namespace perifrac {

/// Semi-smooth Newton for one step of lubrication, exact in the openings' answer to pressure. A
/// facet that would fill or drain in an iteration is put to the edge between the two, and an
/// iteration changes no aperture more than a few times, for the cubic law forgives nothing; where
/// it leads in circles all the same, its slope is left out for a while.
/// Begins and ends with `v`.
FlowReport solve(Lubrication& lubrication, const CrackLiquid& liquid, const CrackStep& step,
                 Eigen::VectorXd& v);

}  // namespace perifrac
