#pragma once

#include <string>

#include "core/io/output_folder.hpp"

namespace perifrac {

/// What `perifrac study` was asked for.
struct StudyRequest {
  std::string file;
  std::string output;    ///< folder; empty: runs/<study>
  std::string launcher;  ///< words before the command of every run
  Overwrite overwrite = Overwrite::own;
  int jobs = 1;
  bool retry = false;
  bool fresh = false;
  bool report = true;
  bool json = false;
};

/// Runs the study and returns the program's exit code: 0 also where variants failed, for that is a
/// result. Throws InputError, before anything is run where that is possible, and OutputError.
int run_study(const StudyRequest& request);

}  // namespace perifrac
