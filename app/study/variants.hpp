#pragma once

#include <string>
#include <vector>

#include "app/study/study_file.hpp"

namespace perifrac {

/// One point of the matrix: what is run.
struct Variant {
  std::string name;                 ///< readable, fit for a folder, the same in every expansion
  std::vector<std::size_t> choice;  ///< of each axis, the value; empty for the finer run
  std::string scene;                ///< file
  Overrides overrides;              ///< of the scene's keys
  int threads = 1;
  std::string problem{};  ///< why the scene refuses it; empty: it reads well
};

struct Matrix {
  std::vector<Variant> variants;      ///< the last axis runs fastest
  std::vector<std::string> left_out;  ///< names of the combinations skipped
};

/// All combinations of the axes but those skipped, and the finer run, `finer`, where errors are
/// against one. Each is held against the keys of scenes. Throws InputError where two have one name,
/// or where none can be read.
Matrix expand(const Study& study);

}  // namespace perifrac
