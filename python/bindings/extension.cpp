#include "python/bindings/bindings.hpp"

PYBIND11_MODULE(_perifrac, module) { perifrac::bind_all(module); }
