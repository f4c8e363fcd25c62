#pragma once

#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "core/base/errors.hpp"

namespace perifrac {

/// Gathers what is wrong with a scene, so that all of it is told at once.
class Mistakes {
 public:
  /// Does a step of reading and keeps what it has to say; false where it did not get to its end.
  template <class Step>
  bool note(Step&& step) {
    try {
      std::forward<Step>(step)();
      return true;
    } catch (const InputError& error) {
      add(error.what());
      return false;
    }
  }

  /// One line or more; what is there already is not said twice. Throws InputError once there are
  /// more than anybody reads.
  void add(std::string_view lines);

  bool any() const { return !lines_.empty(); }
  /// Throws InputError with a line a mistake, in the order of the file.
  void throw_if_any() const;

 private:
  std::vector<std::string> lines_;
};

}  // namespace perifrac
