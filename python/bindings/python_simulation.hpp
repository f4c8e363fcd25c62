#pragma once

#include <chrono>
#include <map>
#include <memory>
#include <optional>
#include <pybind11/numpy.h>
#include <pybind11/pybind11.h>
#include <string>
#include <vector>

#include "app/run/scene_run.hpp"
#include "core/io/output_folder.hpp"
#include "python/bindings/given_inputs.hpp"
#include "python/bindings/python_scene.hpp"

namespace perifrac {

/// What a simulation in the process is made with.
struct SimulationRequest {
  std::string output{};               ///< folder; empty: nothing is written
  std::vector<std::string> inputs{};  ///< in-ports that Python writes, as `solid.interface_impulse`
  std::vector<std::string> loads{};   ///< what Python changes on the way: `solid.boundary.top`
  bool overwrite = false;             ///< files that no run wrote may be replaced
  bool report = false;                ///< make the picture and the page at the end
};

/// A scene that runs in this process, window by window, with the bits of the program. One thread at
/// a time may use it; the GIL is free while it advances.
class PythonSimulation {
 public:
  /// Settled at t = 0. Throws InputError, NumericalError, OutputError.
  PythonSimulation(const PythonScene& scene, SimulationRequest request);

  /// One window, not past `stop` [s] where that is given; at the scene's end it writes what is left
  /// to write. False: there was nothing left to run.
  bool advance(std::optional<double> stop);
  /// Ends it where it stands: checkpoint and summary say that it was stopped, or why it failed.
  void close(const std::string& error);

  double time() const { return manager().time(); }  ///< [s]
  double end() const { return simulation_.end; }    ///< [s]
  std::int64_t step() const { return manager().step(); }
  bool is_done() const { return run_->is_done(); }

  pybind11::list ports();
  /// `module.name`, or a field by its name alone; `part` is value, rate, slope or forecast.
  pybind11::array port(const std::string& name, const std::string& part, pybind11::handle self);
  pybind11::array points(const std::string& name);
  pybind11::array input(const std::string& name, pybind11::handle self);

  /// Factor on what the scene prescribes there; the instant answer to it comes with the next
  /// window.
  void set_load(const std::string& path, double factor);
  double load(const std::string& path);

  pybind11::object summary() const;

 private:
  struct Found {
    PhysicsModule* module;
    PortId id;
    Port port;
  };

  const CouplingManager& manager() const { return *simulation_.manager; }
  void build(const Section& scene);
  void require_loads() const;
  Found find(const std::string& name) const;
  void conclude(const RunEnd& end);
  void refuse_while_busy() const;
  double& factor_at(const std::string& path);

  SimulationRequest request_;
  std::string scene_name_;
  std::string text_;
  std::map<std::string, std::shared_ptr<double>> loads_;  ///< by path of what it multiplies
  Simulation simulation_;
  GivenInputs* given_ = nullptr;
  std::unique_ptr<OutputFolder> folder_;
  std::optional<SceneRun> run_;
  std::optional<RunEnd> ended_;
  bool load_changed_ = false;
  bool busy_ = false;
  std::chrono::steady_clock::time_point begin_ = std::chrono::steady_clock::now();
};

void bind_simulation(pybind11::module_& module);

}  // namespace perifrac
