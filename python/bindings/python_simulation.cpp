#include "python/bindings/python_simulation.hpp"

#include <algorithm>
#include <pybind11/stl.h>

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include "app/report/report.hpp"
#include "app/run/memory.hpp"
#include "app/run/output_times.hpp"
#include "app/warnings/scene_warnings.hpp"
#include "core/base/errors.hpp"
#include "core/base/names.hpp"
#include "core/config/mistakes.hpp"
#include "core/io/log.hpp"
#include "python/bindings/arrays.hpp"
#include "python/bindings/errors.hpp"

namespace perifrac {

namespace py = pybind11;

namespace {

/// Says for the time of its life that the simulation is at work.
class Busy {
 public:
  explicit Busy(bool& busy) : busy_(busy) { busy_ = true; }
  Busy(const Busy&) = delete;
  Busy& operator=(const Busy&) = delete;
  ~Busy() { busy_ = false; }

 private:
  bool& busy_;
};

/// Where the schedule stands that multiplies what is at `path`.
std::string schedule_of(const std::string& path) {
  return path + (path.ends_with("body_force") ? "_schedule" : ".schedule");
}

}  // namespace

PythonSimulation::PythonSimulation(const PythonScene& scene, SimulationRequest request)
    : request_(std::move(request)), scene_name_(scene.name()), text_(scene.text()) {
  GivenFactors factors;
  for (const std::string& path : request_.loads) {
    loads_[path] = std::make_shared<double>(1.0);
    factors[schedule_of(path)] = loads_[path];
  }
  const Section section = scene.section().with_given(std::move(factors));
  const py::gil_scoped_release others_may_run;
  build(section);
}

void PythonSimulation::build(const Section& scene) {
  forget_logged_warnings();
  require_memory(scene);
  std::vector<double> outputs;
  Mistakes mistakes;
  mistakes.note([&] {
    std::vector<ModuleSlot> first;
    if (!request_.inputs.empty()) {
      auto given = std::make_unique<GivenInputs>(request_.inputs);
      given_ = given.get();
      first.push_back({GivenInputs::module_name, std::move(given)});
    }
    simulation_ = make_simulation(scene, std::move(first));
    if (given_ != nullptr) given_->find(manager());
    require_loads();
    initialize(scene, simulation_);
  });
  mistakes.note(
      [&] { outputs = read_output_times(scene.at("output"), scene.number("time.end"), {}); });
  mistakes.throw_if_any();
  const auto warnings = scene_warnings(scene, regime_of(scene, simulation_));
  run_.emplace(scene, text_, simulation_, outputs);
  if (!request_.output.empty()) {
    folder_ = std::make_unique<OutputFolder>(request_.output,
                                             request_.overwrite ? Overwrite::any : Overwrite::own);
    folder_->remove_earlier_results();
  }
  for (const std::string& warning : warnings) log_warning(warning);
  run_->start(folder_ ? folder_->path() : std::filesystem::path());
}

/// A path that no module took up would change nothing without a word.
void PythonSimulation::require_loads() const {
  for (const auto& [path, factor] : loads_) {
    constexpr int held_here_and_by_the_scene = 2;
    if (factor.use_count() > held_here_and_by_the_scene) continue;
    throw InputError(
        fmt::format("loads: {} takes no schedule in this scene; expected a face, a source, an "
                    "inlet or what else "
                    "has one, as in solid.boundary.top",
                    in_quotes(path)));
  }
}

bool PythonSimulation::advance(std::optional<double> stop) {
  refuse_while_busy();
  if (ended_ || is_done()) return false;
  const Busy busy(busy_);
  try {
    const py::gil_scoped_release others_may_run;
    if (load_changed_) run_->settle();
    load_changed_ = false;
    run_->advance(stop.value_or(std::numeric_limits<double>::infinity()));
    run_->write_checkpoint(true);
    if (is_done()) conclude({});
  } catch (const py::error_already_set&) {
    throw;  // KeyboardInterrupt: who called may close it
  } catch (const InputError&) {
    throw;
  } catch (const OutputError&) {
    ended_.emplace();
    throw;
  } catch (const std::exception& error) {
    conclude(run_->fail(error));
    throw;
  }
  return true;
}

void PythonSimulation::close(const std::string& error) {
  refuse_while_busy();
  if (ended_) return;
  const py::gil_scoped_release others_may_run;
  conclude(error.empty() ? RunEnd{.outcome = RunOutcome::stopped}
                         : run_->fail(std::runtime_error(error)));
}

/// What the program does after its last window.
void PythonSimulation::conclude(const RunEnd& end) {
  ended_ = end;
  if (end.outcome != RunOutcome::failed) run_->finish(end.outcome == RunOutcome::stopped);
  if (!folder_) return;
  const std::chrono::duration<double> whole = std::chrono::steady_clock::now() - begin_;
  write_summary(folder_->path(), run_->summary(scene_name_, end, whole.count()));
  if (request_.report && end.outcome != RunOutcome::stopped &&
      make_report(folder_->path(), true) != 0) {
    log_warning("no report was made of the results; `perifrac report` tries again");
  }
  folder_.reset();  // others may write there now
}

void PythonSimulation::refuse_while_busy() const {
  if (busy_) throw std::runtime_error("the simulation is advancing: one thread at a time");
}

py::list PythonSimulation::ports() {
  refuse_while_busy();
  py::list list;
  for (const ModuleSlot& slot : manager().modules()) {
    const auto ports = slot.module->ports();
    for (std::size_t id = 0; id < ports.size(); ++id) {
      const PortId port = static_cast<PortId>(id);
      const PointSet& points = *slot.module->port(port).points;
      const bool is_linked = std::ranges::any_of(manager().links(), [&](const Link& link) {
        return (link.source().module == slot.module.get() && link.source().port == port) ||
               (link.target().module == slot.module.get() && link.target().port == port);
      });
      list.append(py::make_tuple(slot.name, ports[id], points.name, points.count, is_linked));
    }
  }
  return list;
}

PythonSimulation::Found PythonSimulation::find(const std::string& name) const {
  std::vector<std::string> known;
  for (const Field& field : fields_of(manager())) {
    if (field.port.name == name) return {field.module, field.id, field.port};
    known.push_back(field.port.name);
  }
  for (const ModuleSlot& slot : manager().modules()) {
    const auto ports = slot.module->ports();
    for (std::size_t id = 0; id < ports.size(); ++id) {
      known.push_back(slot.name + "." + ports[id].name);
      if (known.back() == name) return {slot.module.get(), static_cast<PortId>(id), ports[id]};
    }
  }
  throw py::key_error(fmt::format("no port {}; {}", in_quotes(name), expected_one_of(known, name)));
}

py::array PythonSimulation::port(const std::string& name, const std::string& part,
                                 py::handle self) {
  refuse_while_busy();
  const Found found = find(name);
  const PortView view = found.module->port(found.id);
  const std::map<std::string, std::span<double>> parts = {{"value", view.value},
                                                          {"rate", view.rate},
                                                          {"slope", view.slope},
                                                          {"forecast", view.forecast}};
  const auto values = parts.find(part);
  if (values == parts.end()) {
    throw py::value_error("part: expected value, rate, slope or forecast");
  }
  const bool is_by_point = values->second.size() == found.port.components * view.points->count;
  return view_of(values->second, is_by_point ? found.port.components : 1, self, false);
}

py::array PythonSimulation::points(const std::string& name) {
  refuse_while_busy();
  const Found found = find(name);
  const PointSet& set = *found.module->port(found.id).points;
  return positions_of(std::span(set.position).first(set.dimension),
                      set.dimension == 0 ? 0 : set.count);
}

py::array PythonSimulation::input(const std::string& name, py::handle self) {
  refuse_while_busy();
  if (given_ == nullptr) {
    throw InputError(
        fmt::format("inputs: {} was not asked for; expected it in inputs=[...]", in_quotes(name)));
  }
  return view_of(given_->values(name), given_->components(name), self, true);
}

double& PythonSimulation::factor_at(const std::string& path) {
  const auto load = loads_.find(path);
  if (load != loads_.end()) return *load->second;
  throw InputError(
      fmt::format("loads: {} was not asked for; expected it in loads=[...]", in_quotes(path)));
}

double PythonSimulation::load(const std::string& path) { return factor_at(path); }

void PythonSimulation::set_load(const std::string& path, double factor) {
  refuse_while_busy();
  if (!std::isfinite(factor)) throw py::value_error("a load's factor: expected a finite number");
  double& held = factor_at(path);
  load_changed_ = load_changed_ || held != factor;
  held = factor;
}

py::object PythonSimulation::summary() const {
  refuse_while_busy();
  const std::chrono::duration<double> whole = std::chrono::steady_clock::now() - begin_;
  const auto json = run_->summary(scene_name_, ended_.value_or(RunEnd{}), whole.count());
  return py::module_::import("json").attr("loads")(json_text(json));
}

void bind_simulation(py::module_& module) {
  py::class_<PythonSimulation>(module, "Simulation")
      .def(
          py::init([](const PythonScene& scene, std::string output, std::vector<std::string> inputs,
                      std::vector<std::string> loads, bool overwrite, bool report) {
            return std::make_unique<PythonSimulation>(scene,
                                                      SimulationRequest{.output = std::move(output),
                                                                        .inputs = std::move(inputs),
                                                                        .loads = std::move(loads),
                                                                        .overwrite = overwrite,
                                                                        .report = report});
          }),
          py::arg("scene"), py::arg("output"), py::arg("inputs"), py::arg("loads"),
          py::arg("overwrite"), py::arg("report"))
      .def("_advance", &PythonSimulation::advance, py::arg("stop") = py::none())
      .def("_close", &PythonSimulation::close, py::arg("error") = "")
      .def_property_readonly("time", &PythonSimulation::time, "[s]")
      .def_property_readonly("end", &PythonSimulation::end, "Of the scene [s].")
      .def_property_readonly("step", &PythonSimulation::step, "Windows since the start.")
      .def_property_readonly("done", &PythonSimulation::is_done, "The end is reached.")
      .def("_ports", &PythonSimulation::ports)
      .def(
          "_port",
          [](py::object self, const std::string& name, const std::string& part) {
            return self.cast<PythonSimulation&>().port(name, part, self);
          },
          py::arg("name"), py::arg("part"))
      .def("points", &PythonSimulation::points, py::arg("name"),
           "Where the values of a port lie, a row a point [m]; a copy.")
      .def("_input",
           [](py::object self, const std::string& name) {
             return self.cast<PythonSimulation&>().input(name, self);
           })
      .def("_set_load", &PythonSimulation::set_load)
      .def("_load", &PythonSimulation::load)
      .def("summary", &PythonSimulation::summary, "What summary.json holds, as it stands.");
}

}  // namespace perifrac
