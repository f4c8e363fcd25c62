#include "python/bindings/python_module.hpp"

#include <stdexcept>

#include <fmt/format.h>

#include "python/bindings/errors.hpp"
#include "python/bindings/python_points.hpp"
#include "python/bindings/state_access.hpp"

namespace perifrac {

namespace py = pybind11;

namespace {

using Array = py::array_t<double, py::array::c_style>;

const PointSet* points_of(const AnyBody& any) {
  return std::visit([](const auto& body) { return body ? &body->point_set() : nullptr; }, any);
}

}  // namespace

PythonModule::PythonModule(py::object self, const AnyBody& body, std::string whole)
    : self_(std::move(self)),
      class_name_(py::type::of(self_).attr("__name__").cast<std::string>()),
      body_(body),
      whole_{.name = std::move(whole)} {
  for (const py::handle& port : self_.attr("ports")) ports_.push_back(port.cast<Port>());
  shown_.resize(ports_.size());
}

PythonModule::~PythonModule() {
  const py::gil_scoped_acquire gil;
  shown_.clear();
  earlier_.clear();
  self_ = {};
}

std::string PythonModule::who(const char* method) const { return class_name_ + "." + method; }

template <class Result, class... Arguments>
Result PythonModule::call(const char* method, Arguments&&... arguments) const {
  const py::gil_scoped_acquire gil;
  try {
    const py::object result = self_.attr(method)(std::forward<Arguments>(arguments)...);
    if constexpr (!std::is_void_v<Result>) return result.cast<Result>();
  } catch (py::error_already_set& error) {
    rethrow(error, who(method));
  } catch (const py::cast_error&) {
    throw std::runtime_error(who(method) + ": returned what is of another kind; expected " +
                             (std::is_same_v<Result, double>        ? "a number"
                              : std::is_same_v<Result, std::string> ? "a text"
                                                                    : "True or False"));
  }
}

std::span<double> PythonModule::span_of(const py::object& array, const Port& port, const char* part,
                                        double& number) const {
  if (!array || array.is_none()) return {};
  if (py::isinstance<py::float_>(array) || py::isinstance<py::int_>(array)) {
    number = array.cast<double>();
    return {&number, 1};
  }
  if (!py::isinstance<Array>(array)) {
    throw std::runtime_error(fmt::format(
        "{}(\"{}\"): its {} is no array of 8-byte numbers that lie in one piece; expected "
        "numpy.zeros(n), component by component",
        who("port"), port.name, part));
  }
  const auto values = py::reinterpret_borrow<Array>(array);
  if (port.direction == PortDirection::in && !values.writeable()) {
    throw std::runtime_error(
        fmt::format("{}(\"{}\"): its {} is read only; expected an array that the run may write",
                    who("port"), port.name, part));
  }
  return {const_cast<double*>(values.data()), static_cast<std::size_t>(values.size())};
}

PortView PythonModule::view_of(const py::object& shown, PortId id) {
  const Port& port = ports_[id];
  Shown& held = shown_[id];
  if (held.value && !held.value.is(shown)) earlier_.push_back(held);
  held = {.points = py::none(), .value = shown};
  if (py::hasattr(shown, "forecast")) {
    held = {.points = shown.attr("points"),
            .value = shown.attr("value"),
            .rate = shown.attr("rate"),
            .slope = shown.attr("slope"),
            .forecast = shown.attr("forecast")};
  }
  const bool on_points = port.role == PortRole::field || port.role == PortRole::property;
  const PointSet* points = on_points ? points_of(body_) : nullptr;
  if (!held.points.is_none()) points = &held.points.cast<PythonPoints&>().set();
  double unused = 0.0;
  PortView view{
      points != nullptr ? points : &whole_, span_of(held.value, port, "value", held.number),
      span_of(held.rate, port, "rate", unused), span_of(held.slope, port, "slope", unused),
      span_of(held.forecast, port, "forecast", unused)};
  if (held.points.is_none() && view.value.data() == &held.number) view.points = &whole_;
  return view;
}

PortView PythonModule::port(PortId id) {
  const py::gil_scoped_acquire gil;
  try {
    return view_of(self_.attr("port")(ports_[id].name), id);
  } catch (py::error_already_set& error) {
    rethrow(error, who("port"));
  }
}

void PythonModule::forget_earlier() {
  if (earlier_.empty()) return;
  const py::gil_scoped_acquire gil;
  earlier_.clear();
}

void PythonModule::initialize(double t) { call<void>("initialize", t); }

void PythonModule::connect(PortId in) { call<void>("connect", ports_[in].name); }

double PythonModule::stable_time_step() const { return call<double>("stable_time_step"); }

void PythonModule::prepare(const TimeWindow& window) {
  call<void>("prepare", window.begin, window.end);
}

double PythonModule::advance(const TimeWindow& window) {
  forget_earlier();
  return call<double>("advance", window.begin, window.end);
}

bool PythonModule::wants_another_pass() const { return call<bool>("wants_another_pass"); }

double PythonModule::conclude(const TimeWindow& window) {
  return call<double>("conclude", window.begin, window.end);
}

bool PythonModule::may_end_windows() const { return call<bool>("may_end_windows"); }

std::string PythonModule::path() const { return call<std::string>("path"); }

void PythonModule::visit_state(StateVisitor& visitor) {
  const py::gil_scoped_acquire gil;
  earlier_.clear();
  StateAccess access(visitor);
  call<void>("visit_state", py::cast(&access, py::return_value_policy::reference));
}

void PythonModule::on_restored(double t) {
  forget_earlier();
  call<void>("on_restored", t);
}

}  // namespace perifrac
