#pragma once

#include <pybind11/pybind11.h>

namespace perifrac {

/// All that `_perifrac` holds, for the extension and for programs that embed Python.
void bind_all(pybind11::module_& module);

}  // namespace perifrac
