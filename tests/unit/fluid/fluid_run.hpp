#pragma once

#include <algorithm>
#include <memory>
#include <string>
#include <vector>

#include "app/simulation/register_modules.hpp"
#include "core/module/physics_module.hpp"
#include "core/state/snapshot.hpp"
#include "tests/contract/scene_text.hpp"

namespace perifrac::test {

/// The fluid of a scene that stands in a test, run by itself. The scene's body, if it has one, is
/// at rest.
class FluidRun {
 public:
  explicit FluidRun(const std::string& text, const std::vector<std::string>& overrides = {})
      : scene_(read_scene_text(text, overrides)) {
    AnyBody body = std::shared_ptr<const Body<2>>();
    if (scene_.integer("dimension") == 3) body = std::shared_ptr<const Body<3>>();
    if (scene_.has("body")) body = make_body(scene_.at("body"), scene_.integer("dimension"));
    for (const ModuleType& type : module_types()) {
      if (type.section == "fluid" && type.name == scene_.word("fluid.type"))
        module_ = type.make(scene_.at("fluid"), body);
    }
    module_->initialize(0.0);
  }

  PhysicsModule& module() { return *module_; }
  double time() const { return time_; }
  int dimension() const { return scene_.integer("dimension"); }

  /// Windows of one step each.
  void steps(int count) {
    for (int n = 0; n < count; ++n) run_for(module_->stable_time_step());
  }
  /// One window.
  void run_for(double length) {
    module_->advance({time_, time_ + length});
    time_ += length;
  }

  Snapshot save() {
    Snapshot state;
    state.save([&](StateVisitor& visitor) { module_->visit_state(visitor); });
    return state;
  }
  void restore(const Snapshot& state) {
    state.restore([&](StateVisitor& visitor) { module_->visit_state(visitor); });
    module_->on_restored(time_);
  }

  /// A field of the state: position_x, velocity_x, density, mass.
  std::vector<double> field(const std::string& name) {
    return std::get<std::vector<double>>(save().fields().at(name));
  }
  std::vector<std::int64_t> ids() {
    return std::get<std::vector<std::int64_t>>(save().fields().at("id"));
  }
  void set(const std::string& name, const std::vector<double>& values) {
    Snapshot::Fields fields = save().fields();
    fields.at(name) = values;
    restore(Snapshot(fields));
  }

  bool has(const std::string& port) const { return id_of(port) < module_->ports().size(); }
  PortView view(const std::string& port) { return module_->port(static_cast<PortId>(id_of(port))); }
  /// To write, before every window.
  PortView input(const std::string& port) {
    module_->connect(static_cast<PortId>(id_of(port)));
    return view(port);
  }
  std::vector<double> values(const std::string& port) {
    const PortView view = this->view(port);
    return {view.value.begin(), view.value.end()};
  }
  double value(const std::string& port) { return values(port).at(0); }

  /// Sum of mass times velocity along an axis.
  double momentum(int axis) {
    const std::vector<double> mass = field("mass");
    const std::vector<double> velocity = field(std::string("velocity_") + "xyz"[axis]);
    double sum = 0.0;
    for (std::size_t i = 0; i < mass.size(); ++i) sum += mass[i] * velocity[i];
    return sum;
  }

 private:
  std::size_t id_of(const std::string& port) const {
    const auto ports = module_->ports();
    return std::ranges::find(ports, port, &Port::name) - ports.begin();
  }

  Section scene_;
  std::unique_ptr<PhysicsModule> module_;
  double time_ = 0.0;
};

}  // namespace perifrac::test
