#pragma once

#include "core/body/body.hpp"
#include "core/config/section.hpp"

namespace perifrac {

/// Throws InputError, with a line a mistake, where inlets are not at a crack that is there from the
/// start or share a piece of one, and where boxes of `filled` and `sealed` hold none.
template <int D>
void check_crack_places(const Section& section, const Body<D>& body);

}  // namespace perifrac
