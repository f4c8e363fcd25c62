#pragma once

#include <string>

namespace perifrac {

/// `perifrac explain KEY`: what is known of a key, by its whole path (`pore_flow.porosity`,
/// `crack_fluid.inlets[0].rate`) or its end (`porosity`), or what there is in a section. Throws
/// InputError with the nearest names where there is none.
int explain(const std::string& key);

}  // namespace perifrac
