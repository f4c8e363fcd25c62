#pragma once

#include <algorithm>
#include <cmath>
#include <functional>
#include <memory>
#include <string>
#include <vector>

#include "core/state/snapshot.hpp"
#include "modules/solid/dynamic_solid.hpp"
#include "tests/port_named.hpp"
#include "tests/unit/solid/elastic_solid.hpp"

namespace perifrac::test {

inline constexpr double density = 1.7;
inline const double speed = std::sqrt((lambda + 2.0 * mu) / density);  // of uniaxial waves

/// A dynamic solid that a test puts together: a body, then a boundary, then start().
template <int D>
struct Moving {
  std::shared_ptr<const Body<D>> body;
  SolidBoundary<D> boundary;
  double damping = 0.0, safety = 0.9;
  IsotropicElasticity<D> law{lambda, mu};
  std::unique_ptr<DynamicSolid<D>> module{};
  double time = 0.0;

  explicit Moving(std::shared_ptr<const Body<D>> shape) : body(std::move(shape)), boundary(*body) {}
  explicit Moving(const std::array<int, D>& counts, double spacing = 0.5)
      : Moving(box_body<D>(counts, spacing)) {}

  void start() {
    module = std::make_unique<DynamicSolid<D>>(body, elastic<D>(*body, boundary, law), boundary,
                                               density, damping, safety);
    module->initialize(0.0);
  }
  PortView port(const std::string& name) { return test::port_named(*module, name); }
  double value(const std::string& name) { return port(name).value[0]; }
  std::vector<double> field(const std::string& name) {
    Snapshot state;
    state.save([&](StateVisitor& visitor) { module->visit_state(visitor); });
    return std::get<std::vector<double>>(state.fields().at(name));
  }
  void advance(double length) {
    module->advance({time, time + length});
    time += length;
  }
  /// Moves component 0 to u(x) at rest, as a restored state.
  void deflect(const std::function<double(double)>& u) {
    struct Set final : StateVisitor {
      std::vector<double> displacement;
      void real(const std::string& name, std::vector<double>& values) override {
        if (name == "displacement") std::ranges::copy(displacement, values.begin());
        if (name == "acceleration") values.clear();
      }
      void integer(const std::string&, std::vector<std::int64_t>&) override {}
    } set;
    for (const double x : body->points().position[0]) set.displacement.push_back(u(x));
    module->visit_state(set);
    module->on_restored(time);
  }
  double energy_error() {
    return value("kinetic_energy") + value("elastic_energy") + value("damped_energy") -
           value("external_work");
  }
};

}  // namespace perifrac::test
