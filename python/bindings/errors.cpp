#include "python/bindings/errors.hpp"

#include <filesystem>

#include <fmt/format.h>

#include "core/base/errors.hpp"

namespace perifrac {

namespace py = pybind11;

namespace {

py::object error_type(const char* name) {
  return py::module_::import("perifrac.errors").attr(name);
}

/// Sets `type(arguments...)` as what is raised, with its cause where there is one.
template <class... Arguments>
void raise(const char* type, const py::object& cause, Arguments&&... arguments) {
  const py::object error = error_type(type)(std::forward<Arguments>(arguments)...);
  if (cause) error.attr("__cause__") = cause;
  PyErr_SetObject(py::type::of(error).ptr(), error.ptr());
}

/// ` (mine.py:12)`, where it was raised; empty where nothing is known.
std::string place_of(const py::error_already_set& error) {
  if (!error.trace()) return {};
  py::object trace = error.trace();
  while (!trace.attr("tb_next").is_none()) trace = trace.attr("tb_next");
  const auto file = trace.attr("tb_frame").attr("f_code").attr("co_filename").cast<std::string>();
  return fmt::format(" ({}:{})", std::filesystem::path(file).filename().string(),
                     trace.attr("tb_lineno").cast<int>());
}

std::string one_line(std::string text) {
  for (char& c : text) {
    if (c == '\n') c = ' ';
  }
  return text;
}

void translate(std::exception_ptr thrown) {
  try {
    if (thrown) std::rethrow_exception(thrown);
  } catch (const PythonError& error) {
    raise("ModuleError", error.cause(), error.what());
  } catch (const InputError& error) {
    raise("SceneError", {}, error.what());
  } catch (const NumericalError& error) {
    raise("NumericalError", {}, error.what(), error.field(), error.place(), error.time());
  } catch (const OutputError& error) {
    raise("OutputError", {}, error.what());
  }
}

}  // namespace

void rethrow(py::error_already_set& error, const std::string& who) {
  if (error.matches(PyExc_KeyboardInterrupt) || error.matches(PyExc_SystemExit)) throw error;
  if (error.matches(error_type("NumericalError"))) {
    const py::object& raised = error.value();
    throw NumericalError(raised.attr("field").cast<std::string>(),
                         raised.attr("place").cast<std::string>(),
                         raised.attr("time").cast<double>(), py::str(raised).cast<std::string>());
  }
  if (error.matches(error_type("SceneError"))) {
    throw InputError(py::str(error.value()).cast<std::string>());
  }
  const auto type = error.type().attr("__name__").cast<std::string>();
  throw PythonError(one_line(fmt::format("{}{}: {}: {}", who, place_of(error), type,
                                         py::str(error.value()).cast<std::string>())),
                    error);
}

void bind_errors() { py::register_exception_translator(translate); }

}  // namespace perifrac
