#include "coupling/ledger.hpp"

#include <algorithm>
#include <cmath>

#include <fmt/format.h>

#include "core/base/errors.hpp"

namespace perifrac {
namespace {

/// The ports of one role, over all modules.
struct Total {
  std::vector<LedgerColumn> ports;
  double sum = 0.0;
  double throughput = 0.0;  ///< of absolute values
};

Total total(std::span<ModuleSlot> modules, PortRole role) {
  Total total;
  for (ModuleSlot& slot : modules) {
    const auto ports = slot.module->ports();
    for (std::size_t id = 0; id < ports.size(); ++id) {
      if (ports[id].role != role) continue;
      const double value = slot.module->port(static_cast<PortId>(id)).value[0];
      total.ports.push_back({ports[id].name, ports[id].unit, value});
      total.sum += value;
      total.throughput += std::abs(value);
    }
  }
  return total;
}

Balance balance(const Total& stored, double at_start, const Total& gained,
                const Total& dissipated) {
  Balance result{.stored = stored.sum, .gained = gained.sum, .dissipated = dissipated.sum};
  result.error = (stored.sum - at_start) - (gained.sum - dissipated.sum);
  const double scale =
      std::max({stored.throughput, std::abs(at_start), gained.throughput, dissipated.throughput});
  result.relative_error = result.error == 0.0 ? 0.0 : std::abs(result.error) / scale;
  return result;
}

}  // namespace

void Ledger::start() {
  const auto stored = [this](PortRole role) {
    const Total all = total(modules_, role);
    return all.ports.empty() ? std::nullopt : std::optional(all.sum);
  };
  mass_at_start_ = stored(PortRole::mass_stored);
  energy_at_start_ = stored(PortRole::energy_stored);
}

double Ledger::settle() {
  const auto energy = this->energy();
  if (!energy || energy->error >= 0.0) return 0.0;
  *energy_at_start_ += energy->error;
  return energy->relative_error;
}

std::optional<Balance> Ledger::mass() const {
  if (!mass_at_start_) return std::nullopt;
  return balance(total(modules_, PortRole::mass_stored), *mass_at_start_,
                 total(modules_, PortRole::mass_gained), {});
}

std::optional<Balance> Ledger::energy() const {
  if (!energy_at_start_) return std::nullopt;
  return balance(total(modules_, PortRole::energy_stored), *energy_at_start_,
                 total(modules_, PortRole::energy_gained),
                 total(modules_, PortRole::energy_dissipated));
}

void Ledger::show(const std::string& port, const std::string& unit,
                  std::shared_ptr<const SummedInput> sum) {
  exchanges_.push_back({port, unit, std::move(sum)});
}

std::vector<LedgerColumn> Ledger::columns() const {
  std::vector<LedgerColumn> columns;
  const auto add_parts = [&](std::initializer_list<const Total*> totals) {
    for (const Total* whole : totals) {
      if (whole->ports.size() < 2) continue;
      columns.insert(columns.end(), whole->ports.begin(), whole->ports.end());
    }
  };
  if (mass_at_start_) {
    const Total stored = total(modules_, PortRole::mass_stored);
    const Total gained = total(modules_, PortRole::mass_gained);
    const Total artificial = total(modules_, PortRole::mass_artificial);
    const std::string& unit = stored.ports[0].unit;
    const Balance mass = balance(stored, *mass_at_start_, gained, {});
    columns.push_back({"fluid_mass_stored", unit, mass.stored});
    columns.push_back({"fluid_mass_gained", unit, mass.gained});
    columns.push_back({"fluid_mass_error", "1", mass.relative_error});
    if (!artificial.ports.empty()) {
      columns.push_back({"fluid_mass_artificial", unit, artificial.sum});
    }
    add_parts({&stored, &gained});
  }
  if (energy_at_start_) {
    const Total stored = total(modules_, PortRole::energy_stored);
    const Total gained = total(modules_, PortRole::energy_gained);
    const Total dissipated = total(modules_, PortRole::energy_dissipated);
    const std::string& unit = stored.ports[0].unit;
    const Balance energy = balance(stored, *energy_at_start_, gained, dissipated);
    columns.push_back({"energy_stored", unit, energy.stored});
    columns.push_back({"energy_gained", unit, energy.gained});
    columns.push_back({"energy_dissipated", unit, energy.dissipated});
    columns.push_back({"energy_error", "1", energy.relative_error});
    add_parts({&stored, &gained, &dissipated});
  }
  for (const auto& [port, unit, sum] : exchanges_) {
    for (std::size_t place = 0; place < sum->sources(); ++place) {
      columns.push_back({port + "_from_" + sum->source(place), unit, sum->passed(place)});
    }
  }
  return columns;
}

void Ledger::check_mass(double bound, double t) const {
  const auto mass = this->mass();
  if (!mass || mass->relative_error <= bound) return;
  constexpr double rounding = 1e-12;
  const double fluid = std::abs(mass->stored) + total(modules_, PortRole::mass_reference).sum;
  if (std::abs(mass->error) <= rounding * fluid) return;
  throw NumericalError("fluid_mass", "the ledger", t,
                       fmt::format("a relative error of {:.1e}, above ledger.mass_error {:g},",
                                   mass->relative_error, bound));
}

void Ledger::visit_state(StateVisitor& visitor) {
  if (mass_at_start_) visitor.visit("mass_at_start", *mass_at_start_);
  if (energy_at_start_) visitor.visit("energy_at_start", *energy_at_start_);
}

}  // namespace perifrac
