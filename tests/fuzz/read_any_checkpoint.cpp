#include "tests/fuzz/read_any_checkpoint.hpp"

#include "core/base/errors.hpp"
#include "core/io/checkpoint.hpp"

namespace perifrac {

void read_any_checkpoint(const std::string& file) {
  try {
    read_checkpoint(file);
  } catch (const InputError&) {
  }
}

}  // namespace perifrac
