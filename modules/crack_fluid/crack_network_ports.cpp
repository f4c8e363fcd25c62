// What other modules and the history read of a crack's fluid.

#include "modules/crack_fluid/crack_network.hpp"

namespace perifrac {

namespace {

const PointSet whole_crack{.name = "crack_total"};

}  // namespace

template <int D>
CrackNetwork<D>::CrackNetwork(std::shared_ptr<const Body<D>> body, const CrackLiquid& liquid,
                              CrackInlets inlets, std::vector<CrackFilling<D>> fillings,
                              std::unique_ptr<LeakOff> leak_off,
                              std::unique_ptr<CrackOutlets<D>> outlets)
    : body_(std::move(body)),
      liquid_(liquid),
      inlets_(std::move(inlets)),
      mouths_(inlets_),
      fillings_(std::move(fillings)),
      leak_off_(std::move(leak_off)),
      outlets_(std::move(outlets)),
      pores_(dynamic_cast<PoreLeakOff<D>*>(leak_off_.get())) {
  using enum PortDirection;
  using enum PortKind;
  using enum PortRole;
  const std::string kilograms = unit_of_total("kg", D), joules = unit_of_total("J", D);
  const std::string volume = D == 2 ? "m^2" : "m^3";
  add_port(Quantity::opening, {"free_crack_opening", "m", in, intensive, property});
  add_port(Quantity::pressure, {"crack_pressure", "Pa", out});
  add_port(Quantity::mass, {"crack_fluid_mass", kilograms, out, extensive});
  add_port(Quantity::wetted_fraction, {"crack_wetted_fraction", "1", out});
  if (D == 2) add_port(Quantity::flow_rate, {"crack_flow_rate", "m^2/s", out});
  add_port(Quantity::viscosity, {"crack_viscosity", "Pa s", out, intensive, property});
  if (leak_off_ && leak_off_->is_sink()) {
    add_port(Quantity::leak_off, {"crack_leak_off", "m/s^0.5", out, intensive, property});
  }
  add_port(Quantity::wetted_area,
           {D == 2 ? "wetted_length" : "wetted_area", D == 2 ? "m" : "m^2", out});
  add_port(Quantity::dry_area, {D == 2 ? "fluid_lag" : "dry_area", D == 2 ? "m" : "m^2", out});
  add_port(Quantity::volume, {"crack_volume", volume, out});
  add_port(Quantity::mean_pressure, {"mean_crack_pressure", "Pa", out});
  for (std::size_t k = 0; k < inlets_.all().size(); ++k) {
    const std::string name = "inlet_" + inlets_.all()[k].name;
    add_port(Quantity::inlet_pressure, {name + "_pressure", "Pa", out}, k);
    add_port(Quantity::inlet_opening, {name + "_opening", "m", out}, k);
  }
  if (leak_off_) {
    add_port(Quantity::leak_off_volume, {"leak_off_volume", volume, out});
    add_port(Quantity::leak_off_rate, {"leak_off_rate", volume + "/s", out});
  }
  add_port(Quantity::stored_mass,
           {"crack_fluid_stored_mass", kilograms, out, extensive, mass_stored});
  add_port(Quantity::injected_mass,
           {"injected_crack_fluid_mass", kilograms, out, extensive, mass_gained});
  if (leak_off_) {
    add_port(Quantity::leaked_mass, {"leaked_crack_fluid_mass", kilograms, out, extensive,
                                     leak_off_->is_sink() ? mass_gained : PortRole::field});
  }
  if (pores_ != nullptr) {
    add_port(Quantity::pore_pressure, {"pore_pressure", "Pa", in});
    add_port(Quantity::pore_mobility, {"pore_mobility", "m^2/(Pa s)", in});
    add_port(Quantity::exchanged_mass, {"exchanged_mass", kilograms, out, extensive});
  }
  if (mouths_.any()) {
    add_port(Quantity::mouth_pressure, {"mouth_pressure", "Pa", in, intensive, property});
    add_port(Quantity::mouth_stiffness, {"mouth_stiffness", "Pa m/kg", in, intensive, property});
    add_port(Quantity::mouth_intake, {"mouth_intake", kilograms, out, extensive, property});
    add_port(Quantity::taken_mass,
             {"mass_taken_by_cracks", kilograms, out, extensive, mass_stored});
  }
  add_port(Quantity::energy, {"crack_fluid_energy", joules, out, extensive, energy_stored});
  add_port(Quantity::work, {"crack_fluid_work", joules, out, extensive, energy_gained});
  add_port(Quantity::dissipation,
           {"crack_flow_dissipation", joules, out, extensive, energy_dissipated});
  add_port(Quantity::steps, {"crack_flow_steps", "1", out, extensive, PortRole::work});
  add_port(Quantity::iterations, {"crack_newton_iterations", "1", out, extensive, PortRole::work});
  scalars_.resize(ports_.size());
}

template <int D>
void CrackNetwork<D>::add_port(Quantity quantity, Port port, std::size_t inlet) {
  quantities_.push_back(quantity);
  inlet_of_.push_back(inlet);
  ports_.push_back(std::move(port));
}

template <int D>
PortView CrackNetwork<D>::port(PortId id) {
  match_facets();
  const PointSet* const facets = &body_->bond_state().facet_points();
  const Quantity quantity = quantities_[id];
  switch (quantity) {
    case Quantity::opening:
      return {facets, opening_, opening_rate_, opening_slope_};
    case Quantity::pressure:
    case Quantity::mass:
    case Quantity::wetted_fraction:
    case Quantity::flow_rate:
    case Quantity::viscosity:
    case Quantity::leak_off:
      return {facets, field(quantity)};
    case Quantity::pore_pressure:
      return pores_->pore_pressure();
    case Quantity::pore_mobility:
      return pores_->pore_mobility();
    case Quantity::exchanged_mass:
      return {&body_->point_set(), pores_->exchanged()};
    case Quantity::mouth_pressure:
      return {&mouths_.points(), mouths_.pressure()};
    case Quantity::mouth_stiffness:
      return {&mouths_.points(), mouths_.stiffness()};
    case Quantity::mouth_intake:
      return {&mouths_.points(), mouths_.intake()};
    default:
      scalars_[id] = scalar(quantity, id);
      return {&whole_crack, std::span(scalars_).subspan(id, 1)};
  }
}

template <int D>
std::vector<double>& CrackNetwork<D>::field(Quantity quantity) {
  const std::size_t count = mass_.size();
  switch (quantity) {
    case Quantity::pressure:
      pressure_.resize(count);
      for (std::size_t f = 0; f < count; ++f) pressure_[f] = liquid_.pressure(unknown_[f]);
      return pressure_;
    case Quantity::wetted_fraction:
      wetted_fraction_.resize(count);
      for (std::size_t f = 0; f < count; ++f) wetted_fraction_[f] = liquid_.fill(unknown_[f]);
      return wetted_fraction_;
    case Quantity::viscosity:
      set_where_wet(viscosity_, [&](Index) { return liquid_.viscosity; });
      return viscosity_;
    case Quantity::leak_off:
      set_where_wet(leak_off_coefficient_, [&](Index f) { return leak_off_->coefficient(f); });
      return leak_off_coefficient_;
    case Quantity::flow_rate:
      find_flow_rate();
      return flow_rate_;
    default:
      return mass_;
  }
}

template <int D>
template <class Value>
void CrackNetwork<D>::set_where_wet(std::vector<double>& field, Value&& value_of) const {
  field.resize(mass_.size());
  for (std::size_t f = 0; f < mass_.size(); ++f) {
    field[f] = liquid_.fill(unknown_[f]) < 0.5 ? 0.0 : value_of(static_cast<Index>(f));
  }
}

template <int D>
void CrackNetwork<D>::find_flow_rate() {
  flow_rate_.assign(mass_.size(), 0.0);
  const auto leaves = [&](const CrackGraph::Branch& at, double flux) {
    flow_rate_[at.facet] += (at.side == 1 ? 0.5 : -0.5) * flux / liquid_.density;
  };
  lubrication_.for_each_flux(
      field(Quantity::pressure), aperture_,
      [&](const CrackGraph::Branch& a, const CrackGraph::Branch& b, double flux) {
        leaves(a, flux);
        leaves(b, -flux);
      });
}

/// What has been booked is exact as long as it is there. What pressures and apertures hold is known
/// to rounding; where that is something else, it is what counts, and the ledger shows it.
template <int D>
double CrackNetwork<D>::stored_mass() const {
  constexpr double rounding = 1e-9;
  const CrackGraph& graph = lubrication_.graph();
  CompensatedSum booked, there, off;
  for (Index f = 0; f < graph.facet_count(); ++f) {
    const double mass = liquid_.mass(graph.area(f) * aperture_[f], unknown_[f]);
    booked.add(mass_[f]);
    there.add(mass);
    off.add(std::abs(mass - mass_[f]));
  }
  return off.value() <= rounding * booked.value() ? booked.value() : there.value();
}

template <int D>
double CrackNetwork<D>::scalar(Quantity quantity, PortId id) const {
  const CrackGraph& graph = lubrication_.graph();
  const auto sum = [&](auto&& term) {
    CompensatedSum sum;
    for (Index f = 0; f < graph.facet_count(); ++f) sum.add(term(f));
    return sum.value();
  };
  const auto mean_at_inlet = [&](auto&& value) {
    const auto facets = inlets_.facets(inlet_of_[id]);
    double sum = 0.0;
    for (const Index f : facets) sum += value(f);
    return facets.empty() ? 0.0 : sum / static_cast<double>(facets.size());
  };
  switch (quantity) {
    case Quantity::volume:
      return extent().volume;
    case Quantity::wetted_area:
      return extent().wetted_area;
    case Quantity::dry_area:
      return extent().dry_area;
    case Quantity::mean_pressure:
      return extent().mean_pressure;
    case Quantity::inlet_pressure:
      return mean_at_inlet([&](Index f) { return liquid_.pressure(unknown_[f]); });
    case Quantity::inlet_opening:
      return mean_at_inlet([&](Index f) { return aperture_[f]; });
    case Quantity::leak_off_volume:
      return leak_off_volume();
    case Quantity::leak_off_rate:
      return leak_off_rate_;
    case Quantity::stored_mass:
      return stored_mass();
    case Quantity::energy:
      return sum([&](Index f) {
        return mass_[f] * liquid_.internal_energy(liquid_.pressure(unknown_[f]));
      });
    case Quantity::injected_mass:
      return injected_.value();
    case Quantity::taken_mass:
      return -mouths_.taken();
    case Quantity::leaked_mass:
      return leaked_.value();
    case Quantity::work:
      return work_.value();
    case Quantity::dissipation:
      return dissipation_.value();
    case Quantity::steps:
      return static_cast<double>(steps_);
    default:
      return static_cast<double>(iterations_);
  }
}

template class CrackNetwork<2>;
template class CrackNetwork<3>;

}  // namespace perifrac
