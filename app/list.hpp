#pragma once

namespace perifrac {

/// `perifrac list`: the modules that a scene may name, and all keys.
int list_modules(bool json);

/// The page docs/configuration.md, on standard output.
int print_reference_page();

}  // namespace perifrac
