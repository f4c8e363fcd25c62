// What other modules and the history read of a crack's fluid.

#include "modules/crack_fluid/crack_fluid.hpp"

namespace perifrac {

namespace {

using enum PortKind;

const PointSet whole_crack{.name = "crack_total"};

template <int D>
constexpr const char* volume_unit = D == 2 ? "m^2" : "m^3";

}  // namespace

template <int D>
CrackFluid<D>::CrackFluid(std::shared_ptr<const Body<D>> body, const CrackLiquid& liquid,
                          std::unique_ptr<CrackFlow> flow, CrackInlets inlets,
                          std::vector<CrackFilling<D>> fillings, std::unique_ptr<LeakOff> leak_off,
                          std::unique_ptr<CrackOutlets<D>> outlets, const Vector<D>& gravity)
    : body_(std::move(body)),
      liquid_(liquid),
      weight_(*body_, gravity, liquid.density),
      flow_(std::move(flow)),
      inlets_(std::move(inlets)),
      mouths_(inlets_),
      fillings_(std::move(fillings)),
      leak_off_(std::move(leak_off)),
      outlets_(std::move(outlets)),
      pores_(dynamic_cast<PoreLeakOff<D>*>(leak_off_.get())) {
  make_ports();
}

template <int D>
void CrackFluid<D>::make_ports() {
  make_facet_ports();
  make_extent_ports();
  make_inlet_ports();
  make_mass_ports();
  make_exchange_ports();
  make_energy_ports();
  ports_.total(work_port("crack_flow_steps"), whole_crack,
               [this] { return static_cast<double>(work_.steps); });
  ports_.total(work_port("crack_newton_iterations"), whole_crack,
               [this] { return static_cast<double>(work_.iterations); });
}

template <int D>
PortView CrackFluid<D>::port(PortId id) {
  match_facets();
  return ports_.view(id);
}

template <int D>
void CrackFluid<D>::make_facet_ports() {
  const PointSet& facets = body_->bond_state().facet_points();
  const auto each = [this, &facets](Port port, std::function<double(std::size_t)> value_of) {
    ports_.found(std::move(port), facets, [this, value_of](std::vector<double>& values) {
      values.resize(facets_.count());
      for (std::size_t f = 0; f < values.size(); ++f) values[f] = value_of(f);
    });
  };
  const auto if_wet = [this](std::size_t f, double value) {
    return liquid_.fill(facets_.unknown[f]) < 0.5 ? 0.0 : value;
  };
  const auto property = [](const char* name, const char* unit) {
    return Port{.name = name, .unit = unit, .role = PortRole::property};
  };
  ports_.in(
      property("free_crack_opening", "m"), [] {},
      [this, &facets] {
        return PortView{&facets, opening_.value, opening_.rate, opening_.slope};
      });
  ports_.in(
      property("crack_part", "1"), [] {},
      [this, &facets] {
        return PortView{&facets, part_};
      });
  each({.name = "crack_pressure", .unit = "Pa", .negligible = negligible_pressure},
       [this](std::size_t f) { return liquid_.pressure(facets_.unknown[f]); });
  ports_.out({.name = "crack_fluid_mass", .unit = unit_of_total("kg", D), .kind = extensive},
             [this, &facets] {
               return PortView{&facets, facets_.mass};
             });
  each({"crack_wetted_fraction", "1"},
       [this](std::size_t f) { return liquid_.fill(facets_.unknown[f]); });
  if (flow_->knows_rates() && D == 2) {
    ports_.found({"crack_flow_rate", "m^2/s"}, facets,
                 [this](std::vector<double>& rate) { rate = flow_rate(); });
  }
  each(property("crack_viscosity", "Pa s"),
       [this, if_wet](std::size_t f) { return if_wet(f, liquid_.viscosity); });
  if (weight_.per_volume() != Vector<D>{}) {
    each(property("crack_fluid_weight", "Pa"),
         [this](std::size_t f) { return -flow_->height(static_cast<Index>(f)); });
  }
  if (!leak_off_ || !leak_off_->is_sink()) return;
  each(property("crack_leak_off", "m/s^0.5"), [this, if_wet](std::size_t f) {
    return if_wet(f, leak_off_->coefficient(static_cast<Index>(f)));
  });
}

template <int D>
void CrackFluid<D>::make_extent_ports() {
  const char* const area = D == 2 ? "m" : "m^2";
  ports_.total({D == 2 ? "wetted_length" : "wetted_area", area}, whole_crack,
               [this] { return extent().wetted_area; });
  ports_.total({D == 2 ? "fluid_lag" : "dry_area", area}, whole_crack,
               [this] { return extent().dry_area; });
  ports_.total({"crack_volume", volume_unit<D>}, whole_crack, [this] { return extent().volume; });
  ports_.total({"mean_crack_pressure", "Pa"}, whole_crack,
               [this] { return extent().mean_pressure; });
}

template <int D>
void CrackFluid<D>::make_inlet_ports() {
  const auto mean = [this](const std::string& name, const char* unit, std::size_t inlet,
                           std::function<double(Index)> value_of) {
    ports_.total({name, unit}, whole_crack, [this, inlet, value_of] {
      // A facet that was cut at the end of the window has not been let in to yet.
      double sum = 0.0, wet = 0.0;
      for (const Index f : inlets_.facets(inlet)) {
        if (facets_.mass[f] <= 0.0) continue;
        sum += value_of(f);
        wet += 1.0;
      }
      return wet > 0.0 ? sum / wet : 0.0;
    });
  };
  for (std::size_t k = 0; k < inlets_.all().size(); ++k) {
    const std::string name = "inlet_" + inlets_.all()[k].name;
    mean(name + "_pressure", "Pa", k,
         [this](Index f) { return liquid_.pressure(facets_.unknown[f]); });
    mean(name + "_opening", "m", k, [this](Index f) { return facets_.aperture[f]; });
  }
  for (std::size_t k = 0; k < inlets_.wells().all().size(); ++k) {
    ports_.total({"well_" + inlets_.wells().all()[k].name + "_pressure", "Pa"}, whole_crack,
                 [this, k] { return inlets_.wells().pressure(k); });
  }
  for (std::size_t c = 0; c < inlets_.wells().cluster_count(); ++c) {
    const std::string& name = inlets_.all()[inlets_.inlet_of_cluster(c)].name;
    ports_.total({"inlet_" + name + "_rate", std::string(volume_unit<D>) + "/s"}, whole_crack,
                 [this, c] { return inlets_.wells().rate(c); });
  }
}

template <int D>
void CrackFluid<D>::make_mass_ports() {
  if (leak_off_) {
    ports_.total({"leak_off_volume", volume_unit<D>}, whole_crack,
                 [this] { return leak_off_volume(); });
    ports_.total({"leak_off_rate", std::string(volume_unit<D>) + "/s"}, whole_crack,
                 [this] { return leak_off_rate_; });
  }
  ports_.total(total_port("crack_fluid_stored_mass", "kg", PortRole::mass_stored, D), whole_crack,
               [this] { return stored_mass(); });
  ports_.total(total_port("injected_crack_fluid_mass", "kg", PortRole::mass_gained, D), whole_crack,
               [this] { return books_.injected.value(); });
  if (!leak_off_) return;
  const PortRole role = leak_off_->is_sink() ? PortRole::mass_gained : PortRole::field;
  ports_.total(total_port("leaked_crack_fluid_mass", "kg", role, D), whole_crack,
               [this] { return books_.leaked.value(); });
}

/// With the pores, and with the free fluid that cracks open into.
template <int D>
void CrackFluid<D>::make_exchange_ports() {
  const std::string kilograms = unit_of_total("kg", D);
  if (pores_ != nullptr) {
    ports_.in(
        {"pore_pressure", "Pa"}, [] {}, [this] { return pores_->pore_pressure(); });
    ports_.in(
        {"pore_mobility", "m^2/(Pa s)"}, [] {}, [this] { return pores_->pore_mobility(); });
    ports_.out({.name = "exchanged_mass", .unit = kilograms, .kind = extensive}, [this] {
      return PortView{&body_->point_set(), pores_->exchanged()};
    });
  }
  if (!mouths_.any()) return;
  const auto property = [](const char* name, const std::string& unit) {
    return Port{.name = name, .unit = unit, .role = PortRole::property};
  };
  const auto told = [&](const char* name, const std::string& unit,
                        std::span<double> (CrackMouths::*values)()) {
    ports_.in(
        property(name, unit), [] {},
        [this, values] {
          return PortView{&mouths_.points(), (mouths_.*values)()};
        });
  };
  told("mouth_pressure", "Pa", &CrackMouths::pressure);
  told("mouth_stiffness", "Pa m/kg", &CrackMouths::stiffness);
  told("mouth_volume_stiffness", "Pa m/kg", &CrackMouths::volume_stiffness);
  told("mouth_relaxation", "s", &CrackMouths::relaxation);
  told("mouth_given", kilograms, &CrackMouths::given);
  ports_.out(property("mouth_taken", kilograms), [this] {
    return PortView{&mouths_.points(), mouths_.taken_by_mouth()};
  });
  ports_.total(total_port("mass_taken_by_cracks", "kg", PortRole::mass_stored, D), whole_crack,
               [this] { return -mouths_.taken(); });
}

template <int D>
void CrackFluid<D>::make_energy_ports() {
  ports_.total(total_port("crack_fluid_energy", "J", PortRole::energy_stored, D), whole_crack,
               [this] {
                 CompensatedSum sum;
                 for (std::size_t f = 0; f < facets_.count(); ++f) {
                   const double pressure = liquid_.pressure(facets_.unknown[f]);
                   sum.add(facets_.mass[f] * (liquid_.internal_energy(pressure) + height_of(f)));
                 }
                 return sum.value();
               });
  ports_.total(total_port("crack_fluid_work", "J", PortRole::energy_gained, D), whole_crack,
               [this] { return books_.work.value(); });
  ports_.total(total_port("crack_flow_dissipation", "J", PortRole::energy_dissipated, D),
               whole_crack, [this] { return books_.dissipation.value(); });
}

template <int D>
std::vector<double> CrackFluid<D>::flow_rate() {
  std::vector<double> pressure(facets_.count());
  for (std::size_t f = 0; f < pressure.size(); ++f) {
    pressure[f] = liquid_.pressure(facets_.unknown[f]);
  }
  return flow_->rates(pressure, facets_.fill(liquid_), facets_.aperture);
}

/// What has been booked is exact as long as it is there. What pressures and apertures hold is known
/// to rounding; where that is something else, it is what counts, and the ledger shows it.
template <int D>
double CrackFluid<D>::stored_mass() const {
  constexpr double rounding = 1e-9;
  const CrackGraph& graph = flow_->graph();
  CompensatedSum booked, there, off;
  for (Index f = 0; f < graph.facet_count(); ++f) {
    const double mass = liquid_.mass(graph.area(f) * facets_.aperture[f], facets_.unknown[f]);
    booked.add(facets_.mass[f]);
    there.add(mass);
    off.add(std::abs(mass - facets_.mass[f]));
  }
  return off.value() <= rounding * booked.value() ? booked.value() : there.value();
}

template class CrackFluid<2>;
template class CrackFluid<3>;

}  // namespace perifrac
