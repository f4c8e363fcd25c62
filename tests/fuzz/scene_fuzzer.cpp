#include "tests/fuzz/read_any_scene.hpp"
#include "tests/fuzz/scratch_file.hpp"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  static const perifrac::ScratchFile scratch("scene");
  perifrac::read_any_scene(scratch.hold({data, size}));
  return 0;
}
