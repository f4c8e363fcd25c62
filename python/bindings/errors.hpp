#pragma once

#include <memory>
#include <pybind11/pybind11.h>
#include <stdexcept>
#include <string>
#include <utility>

namespace perifrac {

/// What code of Python raised, in one line that names the place: `MyFlow.advance (mine.py:12):
/// ValueError: ...`. The exception itself stays its cause.
class PythonError : public std::runtime_error {
 public:
  PythonError(const std::string& what, pybind11::error_already_set cause)
      : std::runtime_error(what),
        cause_(std::make_shared<pybind11::error_already_set>(std::move(cause))) {}

  const pybind11::object& cause() const { return cause_->value(); }

 private:
  std::shared_ptr<pybind11::error_already_set> cause_;
};

/// Throws what `error`, raised by `who`, is to a run: a NumericalError is one of the program's, so
/// that a window may be tried again; KeyboardInterrupt and SystemExit stay as they are; anything
/// else is a PythonError. Holds the GIL.
[[noreturn]] void rethrow(pybind11::error_already_set& error, const std::string& who);

/// Makes exceptions of the program those of perifrac.errors.
void bind_errors();

}  // namespace perifrac
