#pragma once

#include <memory>

#include "app/references/reference.hpp"
#include "app/simulation.hpp"
#include "core/config/section.hpp"

namespace perifrac {

/// `reference.type: table`: the scalars of history.csv against a file of such columns, `time [s]`
/// first, as another program or an experiment has them. Between its rows values go straight; before
/// and after them nothing is known. Throws InputError.
std::unique_ptr<Reference> make_table_reference(const Section& scene, const Simulation& simulation);

}  // namespace perifrac
