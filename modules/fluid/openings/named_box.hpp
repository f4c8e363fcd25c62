#pragma once

#include "core/config/key.hpp"
#include "core/config/section.hpp"
#include "core/geometry/region.hpp"

namespace perifrac {

/// The keys `<list>[].name`, `.from` and `.to` of boxes that each are `meaning`.
KeyTable named_box_keys(const std::string& list, const std::string& meaning);

/// The box at `path`. Throws InputError where it holds nothing.
template <int D>
Region<D> read_named_box(const Section& section, const std::string& path);

}  // namespace perifrac
