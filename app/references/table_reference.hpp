#pragma once

#include <memory>
#include <string>
#include <vector>

#include "app/references/reference.hpp"
#include "app/simulation/simulation.hpp"
#include "core/config/section.hpp"

namespace perifrac {

/// `reference.type: table`: the scalars of history.csv against a file of such columns, `time [s]`
/// first, as another program or an experiment has them. Between its rows values go straight; before
/// and after them nothing is known. Lines `# KEY = VALUE` before its columns say which scene it is
/// for, in SI; `none`: one that does not write the key. Null where the scene is another one. Throws
/// InputError.
std::unique_ptr<Reference> make_table_reference(const Section& scene, const Simulation& simulation);

/// Why it is not compared, or not to the end, one sentence each. Throws InputError.
std::vector<std::string> table_warnings(const Section& scene);

}  // namespace perifrac
