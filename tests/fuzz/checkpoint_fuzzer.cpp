#include "tests/fuzz/read_any_checkpoint.hpp"
#include "tests/fuzz/scratch_file.hpp"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  static const perifrac::ScratchFile scratch("checkpoint");
  perifrac::read_any_checkpoint(scratch.hold({data, size}));
  return 0;
}
