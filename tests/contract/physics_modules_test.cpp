#include <set>

#include "app/simulation/register_modules.hpp"
#include "app/simulation/simulation.hpp"
#include "core/base/errors.hpp"
#include "tests/contract/module_contract.hpp"
#include "tests/contract/scene_text.hpp"
#include "tests/port_named.hpp"

namespace perifrac {
namespace {

/// A line of six facets with a branch of two, each across a bond.
void seed_crack(const Body<2>& body) {
  BondState<2>& bonds = body.claim_bond_state();
  const auto add = [&](const CrackFacet<2>& facet, const Vector<2>& one, const Vector<2>& other) {
    const std::pair bond = std::minmax({body.nearest_point(one), body.nearest_point(other)});
    bonds.add_facet(facet, {{bond}});
  };
  for (int k = 0; k < 6; ++k) {
    add({{{3.0 + k, 5.0}, {4.0 + k, 5.0}}}, {3.5 + k, 4.5}, {3.5 + k, 5.5});
  }
  for (int k = 0; k < 2; ++k) {
    add({{{6.0, 5.0 + k}, {6.0, 6.0 + k}}}, {5.5, 5.5 + k}, {6.5, 5.5 + k});
  }
}

/// Four squares in a row, half-way up, each across a bond.
void seed_crack(const Body<3>& body) {
  BondState<3>& bonds = body.claim_bond_state();
  for (int k = 0; k < 4; ++k) {
    const double x = 2.0 + k;
    const std::pair bond = std::minmax(
        {body.nearest_point({x + 0.5, 2.5, 1.5}), body.nearest_point({x + 0.5, 2.5, 2.5})});
    bonds.add_facet({{{x, 2.0, 2.0}, {x + 1.0, 2.0, 2.0}, {x + 1.0, 3.0, 2.0}, {x, 3.0, 2.0}}},
                    {{bond}});
  }
}

std::unique_ptr<PhysicsModule> make_module(const std::string& text, const std::string& physics,
                                           const std::vector<std::string>& overrides) {
  const Section scene = read_scene_text(text, overrides);
  const int dimension = scene.integer("dimension");
  AnyBody body = std::shared_ptr<const Body<2>>();
  if (dimension == 3) body = std::shared_ptr<const Body<3>>();
  if (scene.has("body")) body = make_body(scene.at("body"), dimension);
  if (physics == "crack_fluid" || (physics == "pore_flow" && scene.count("cracks") > 0)) {
    std::visit([](const auto& any) { seed_crack(*any); }, body);
  }
  return make_module(scene, physics, body);
}

/// The nested operator takes no inflow at a face.
const std::string nested_left = "pore_flow.boundary.left={type: sealed}";

const std::string cracked = "cracks=[{name: cut, path: [2 m, 4 m, 6 m, 4 m]}]";
const std::string cracked_at_top = "cracks=[{name: cut, path: [5 m, 11 m, 5 m, 7 m]}]";
const std::string cracked_3d =
    "cracks=[{name: cut, centre: [4 m, 2 m, 2 m], normal: [0, 0, 1], sides: [4 m, 4 m]}]";

const std::string by_volumes = "pore_flow/finite_volume";

const std::string inlet_3d =
    "crack_fluid.inlets=[{name: pump, at: [2 m, 2 m, 2 m], volume_rate: 5e-5 m^3/s}]";

const std::string well =
    "crack_fluid.wells=[{name: well, rate: 5e-5 m^2/s, thickness: 10 m, clusters: [{name: heel, "
    "at: "
    "[3 m, 5 m], perforations: 12, diameter: 10 mm}, {name: toe, at: [8 m, 5 m]}]}]";

struct Variant {
  std::string type;  ///< as registered, `physics/type`
  ModuleCase contract;
};

Variant make_variant(std::string name, std::string type, std::string text,
                     std::vector<std::string> overrides) {
  const std::string physics = type.substr(0, type.find('/'));
  ModuleCase contract{.name = std::move(name),
                      .make = [=] { return make_module(text, physics, overrides); },
                      .window = 0.01,
                      .input_size = {{"dilatation", 1e-5},
                                     {"pore_stress", 1e5},
                                     {"displacement", 1e-3},
                                     {"pore_pressure", 1e3},
                                     {"pore_mobility", 1e-9},
                                     {"interface_impulse", 1e3},
                                     {"exchanged_mass", 0.1},
                                     {"free_crack_opening", 1e-4},
                                     {"mouth_pressure", 1e5},
                                     {"mouth_stiffness", 1e6},
                                     {"mouth_volume_stiffness", 1e5},
                                     {"mouth_relaxation", 1e-4},
                                     {"mouth_given", 0.0},
                                     {"mouth_taken", 1.0}}};
  return {std::move(type), std::move(contract)};
}

/// Every method for the free fluid, by its word, is asked the same.
std::vector<Variant> fluid_variants(const std::string& method) {
  const auto variant = [&](const std::string& name, const std::string& text,
                           std::vector<std::string> overrides = {}) {
    overrides.push_back("fluid.type=" + method);
    return make_variant((method == "semi_lagrangian" ? "fluid_" : method + "_") + name,
                        "fluid/" + method, text, std::move(overrides));
  };
  return {
      variant("2d", tank_2d),
      variant("3d", tank_3d),
      variant("tait", tank_2d, {"fluid.equation_of_state=tait", "fluid.container.slip=free"}),
      variant("plain", tank_2d,
              {"fluid.particle_shifting=0", "fluid.artificial_viscosity=0",
               "fluid.density_diffusion=0"}),
      variant("free_fall", tank_2d,
              {"fluid.container.faces={left: open, right: open, bottom: open, top: open}"}),
      variant("periodic", tank_2d,
              {"fluid.container.faces={left: periodic, right: periodic, top: open}"}),
      variant("periodic_3d", tank_3d,
              {"fluid.container.faces={left: periodic, right: periodic, back: periodic, front: "
               "periodic, top: open}"}),
      variant("walls", tank_2d,
              {"fluid.walls=[{name: sill, from: [0.9 m, 0 m], to: [1.1 m, 0.3 m]}, {name: step, "
               "from: [1 m, 0 m], to: [1.2 m, 0.2 m], slip: free}]"}),
      variant("moving_wall", tank_2d,
              {"fluid.walls=[{name: gate, from: [0.7 m, 0 m], to: [0.9 m, 0.8 m], motion: moving, "
               "velocity: [-0.5 m/s, 1 m/s], schedule: {ramp: 5 ms}}]"}),
      variant("piston", tank_2d,
              {"fluid.walls=[{name: lid, from: [0 m, 0.6 m], to: [0.7 m, 0.9 m], motion: piston, "
               "force: [0 N/m, -1 kN/m], mass: 100 kg/m, schedule: {ramp: 5 ms}}]"}),
      // So much at once that points split, are made and removed in every window.
      variant("inlet_and_outlet", tank_2d,
              {"fluid.inlets=[{name: pump, from: [0.2 m, 0.1 m], to: [0.4 m, 0.3 m], rate: 1e4 "
               "kg/(m s)}, {name: spray, from: [0.9 m, 0.5 m], to: [1 m, 0.6 m], rate: 1e4 kg/(m "
               "s), schedule: {ramp: 1 ms}}]",
               "fluid.outlets=[{name: drain, from: [0.6 m, 0 m], to: [1.2 m, 0.2 m]}]"}),
      variant(
          "inlet_and_outlet_3d", tank_3d,
          {"fluid.inlets=[{name: pump, from: [0.2 m, 0.1 m, 0.1 m], to: [0.4 m, 0.3 m, 0.3 m], "
           "rate: 2e3 kg/s}]",
           "fluid.outlets=[{name: drain, from: [0.4 m, 0 m, 0 m], to: [0.8 m, 0.4 m, 0.2 m]}]"}),
      variant("lost", tank_2d, {"fluid.domain={to: [0.65 m, 1 m], most_lost: 1000}"}),
      variant("beside_body", box_2d + quasi_static_2d + water_over_box_2d),
      variant("beside_body_3d", box_3d + quasi_static_3d + water_over_box_3d,
              {"interface.slip=free"}),
      variant("at_a_mouth", box_2d + crack_network + water_over_box_2d,
              {"crack_fluid.inlets=[{name: mouth, at: [5 m, 11 m], holds: fluid}]"}),
      variant("one_sided", box_2d + quasi_static_2d + water_over_box_2d,
              {"interface.force=one_sided"}),
      variant("beside_pores", box_2d + darcy + water_over_box_2d),
      variant("beside_pores_3d", box_3d + darcy + water_over_box_3d),
      variant("smoothed_into_pores", box_2d + darcy + water_over_box_2d,
              {"interface.smoothing=0.1"}),
      variant("paper_exchange", box_2d + darcy + water_over_box_2d, {"interface.exchange=paper"}),
  };
}

std::vector<Variant> make_variants() {
  const auto variant = [](const std::string& name, const std::string& type, const std::string& text,
                          std::vector<std::string> overrides = {}) {
    return make_variant(name, type, text, std::move(overrides));
  };
  std::vector<Variant> all = {
      variant("quasi_static_2d", "solid/quasi_static", box_2d + quasi_static_2d),
      variant("quasi_static_3d", "solid/quasi_static", box_3d + quasi_static_3d),
      variant("quasi_static_scheduled", "solid/quasi_static", box_2d + quasi_static_2d,
              {"solid.boundary.top.schedule={ramp: 0.02 s}", "gravity=[0 m/s^2, -9.81 m/s^2]",
               "solid.boundary.bottom.normal_velocity=1 mm/s", "solid.density=2300 kg/m^3"}),
      variant("quasi_static_lps_2d", "solid/quasi_static", box_2d + quasi_static_2d,
              {"solid.material.type=lps"}),
      variant("quasi_static_lps_3d", "solid/quasi_static", box_3d + quasi_static_3d,
              {"solid.material.type=lps"}),
      variant("quasi_static_multigrid", "solid/quasi_static", box_3d + quasi_static_3d,
              {"solid.linear_solver.type=multigrid"}),
      variant("quasi_static_confined", "solid/quasi_static", box_2d + quasi_static_2d,
              {"solid.confining_stress=[2 MPa, 3 MPa]"}),
      variant("quasi_static_cracked", "solid/quasi_static", box_2d + quasi_static_2d,
              {"cracks=[{name: cut, path: [2 m, 4 m, 6 m, 4 m]}]",
               "damage={type: energy_release, fracture_energy: 1 kJ/m^2}"}),
      variant("quasi_static_cracked_3d", "solid/quasi_static", box_3d + quasi_static_3d,
              {cracked_3d, "damage={type: energy_release, fracture_energy: 1 kJ/m^2}",
               "solid.confining_stress=[1 MPa, 1 MPa, 1 MPa]"}),
      variant("quasi_static_lps_cracked", "solid/quasi_static", box_2d + quasi_static_2d,
              {cracked, "damage={type: energy_release, fracture_energy: 1 kJ/m^2}",
               "solid.material.type=lps", "solid.confining_stress=[1 MPa, 1 MPa]"}),
      variant("dynamic_2d", "solid/dynamic", box_2d + dynamic_2d),
      variant("dynamic_cracked", "solid/dynamic", box_2d + dynamic_2d,
              {"cracks=[{name: cut, path: [2 m, 4 m, 6 m, 4 m]}]",
               "damage={type: energy_release, fracture_energy: 1 kJ/m^2}",
               "solid.confining_stress=[1 MPa, 1 MPa]"}),
      variant("dynamic_torn", "solid/dynamic", box_2d + dynamic_2d,
              {"cracks=[{name: cut, path: [2 m, 4 m, 6 m, 4 m]}]",
               "damage={type: critical_stretch, fracture_energy: 1 kJ/m^2}"}),
      variant("dynamic_3d", "solid/dynamic", box_3d + dynamic_3d),
      variant("dynamic_corotational", "solid/dynamic", box_2d + dynamic_2d,
              {"solid.kinematics=corotational", "solid.boundary.top={type: fixed}"}),
      variant("dynamic_corotational_torn", "solid/dynamic", box_2d + dynamic_2d,
              {"solid.kinematics=corotational", "solid.boundary.top={type: fixed}",
               "cracks=[{name: cut, path: [2 m, 4 m, 6 m, 4 m]}]",
               "damage={type: critical_stretch, fracture_energy: 1 kJ/m^2}"}),
      variant("dynamic_corotational_3d", "solid/dynamic", box_3d + dynamic_3d,
              {"solid.kinematics=corotational", "body.boundary={top: layer}"}),
      variant("rigid", "solid/rigid", box_2d + rigid),
      variant("rigid_slits", "solid/rigid", box_2d + rigid,
              {"cracks=[{name: slit, path: [2 m, 4 m, 6 m, 5 m], opening: 1 mm}]"}),
      variant(
          "rigid_slits_3d", "solid/rigid", box_3d + rigid,
          {"cracks=[{name: slit, centre: [4 m, 2 m, 2 m], normal: [0, 0, 1], sides: [4 m, 2 m], "
           "opening: 1 mm}]"}),
      variant("darcy_cvode_2d", "pore_flow/darcy", box_2d + darcy),
      variant("darcy_cvode_3d", "pore_flow/darcy", box_3d + darcy),
      variant("darcy_krylov", "pore_flow/darcy", box_2d + darcy,
              {"pore_flow.integrator.linear_solver=krylov"}),
      variant("darcy_explicit", "pore_flow/darcy", box_2d + darcy,
              {"pore_flow.integrator.type=explicit"}),
      variant("darcy_explicit_jumps", "pore_flow/darcy", box_2d + darcy,
              {"pore_flow.integrator.type=explicit", "pore_flow.permeability=1e-13 m^2",
               "pore_flow.boundary.left.schedule={times: [9.999999 ms, 10 ms], factors: [1, 3]}"}),
      variant("darcy_cracked", "pore_flow/darcy", box_2d + darcy, {cracked}),
      variant("darcy_cracked_explicit", "pore_flow/darcy", box_2d + darcy,
              {cracked, "pore_flow.integrator.type=explicit"}),
      variant("darcy_bond", "pore_flow/darcy", box_2d + darcy, {"pore_flow.operator=bond"}),
      variant("darcy_nested_krylov", "pore_flow/darcy", box_2d + darcy,
              {"pore_flow.operator=nested", "pore_flow.nested.smoothing=none",
               "pore_flow.integrator.linear_solver=krylov", nested_left}),
      variant("darcy_nested_smoothed", "pore_flow/darcy", box_2d + darcy,
              {"pore_flow.operator=nested", "pore_flow.integrator.type=explicit", nested_left}),
      variant("darcy_in_layers", "pore_flow/darcy", box_2d + darcy,
              {"body.boundary={left: layer, right: layer, top: layer}"}),
      variant("darcy_with_well", "pore_flow/darcy", box_2d + darcy,
              {"pore_flow.sources=[{at: [3 m, 3 m], rate: 1 cm^2/s}]"}),
      variant("darcy_regions", "pore_flow/darcy", box_2d + darcy,
              {"body.regions={upper: {from: [0 m, 6 m]}}",
               "pore_flow.regions={upper: {permeability_tensor: [2e-12 m^2, 1e-12 m^2, 5e-13 m^2], "
               "porosity: 0.1, biot_coefficient: 0.5}}"}),
      variant("darcy_gravity", "pore_flow/darcy", box_2d + darcy,
              {"gravity=[0 m/s^2, -9.81 m/s^2]", "pore_flow.boundary.right.hydrostatic=true"}),
      variant("darcy_warm", "pore_flow/darcy", box_2d + darcy,
              {"pore_flow.initial_state=linear", "pore_flow.initial_gradient=[10 kPa/m, 1 Pa/m]"}),
      variant("darcy_schedule", "pore_flow/darcy", box_2d + darcy,
              {"pore_flow.boundary.right.schedule={ramp: 5 ms}",
               "pore_flow.boundary.left.schedule={times: [2 ms, 13 ms], factors: [1, -1]}"}),
      variant("darcy_stabilised", "pore_flow/darcy", box_2d + quasi_static_2d + darcy,
              {"pore_flow.undrained_stabilisation=0.25"}),
      variant("darcy_stabilised_explicit", "pore_flow/darcy", box_3d + quasi_static_3d + darcy,
              {"pore_flow.undrained_stabilisation=0.25", "pore_flow.integrator.type=explicit"}),
      variant("darcy_stabilised_cracked", "pore_flow/darcy", box_2d + quasi_static_2d + darcy,
              {"pore_flow.undrained_stabilisation=0.25", cracked}),
      variant("darcy_tait", "pore_flow/darcy", box_2d + darcy,
              {"pore_flow.fluid.equation_of_state=tait"}),
      variant("darcy_tait_explicit", "pore_flow/darcy", box_2d + darcy,
              {"pore_flow.fluid.equation_of_state=tait", "pore_flow.fluid.bulk_modulus=22 MPa",
               "pore_flow.integrator.type=explicit"}),
      variant("finite_volume_cvode_2d", by_volumes, box_2d + finite_volume),
      variant("finite_volume_cvode_3d", by_volumes, box_3d + finite_volume),
      variant("finite_volume_krylov", by_volumes, box_2d + finite_volume,
              {"pore_flow.integrator.linear_solver=krylov"}),
      variant("finite_volume_explicit", by_volumes, box_2d + finite_volume,
              {"pore_flow.integrator.type=explicit"}),
      variant("finite_volume_voronoi", by_volumes, box_3d + finite_volume, {"body.jitter=0.3"}),
      variant("finite_volume_cracked", by_volumes, box_2d + finite_volume, {cracked}),
      variant("finite_volume_in_layers", by_volumes, box_2d + finite_volume,
              {"body.boundary={left: layer, right: layer, top: layer}"}),
      variant("finite_volume_regions", by_volumes, box_2d + finite_volume,
              {"body.regions={upper: {from: [0 m, 6 m]}}",
               "pore_flow.regions={upper: {permeability_tensor: [2e-12 m^2, 1e-12 m^2, 0], "
               "porosity: 0.1, biot_coefficient: 0.5}}"}),
      variant("finite_volume_gravity", by_volumes, box_2d + finite_volume,
              {"gravity=[0 m/s^2, -9.81 m/s^2]", "pore_flow.boundary.right.hydrostatic=true"}),
      variant("finite_volume_schedule", by_volumes, box_2d + finite_volume,
              {"pore_flow.boundary.right.schedule={ramp: 5 ms}",
               "pore_flow.boundary.left.schedule={times: [2 ms, 13 ms], factors: [1, -1]}"}),
      variant("finite_volume_stabilised", by_volumes, box_2d + quasi_static_2d + finite_volume,
              {"pore_flow.undrained_stabilisation=0.25", cracked}),
      variant("finite_volume_tait", by_volumes, box_2d + finite_volume,
              {"pore_flow.fluid.equation_of_state=tait"}),
      variant("finite_volume_tait_explicit", by_volumes, box_2d + finite_volume,
              {"pore_flow.fluid.equation_of_state=tait", "pore_flow.fluid.bulk_modulus=22 MPa",
               "pore_flow.integrator.type=explicit", cracked}),
      variant("crack_network", "crack_fluid/network", box_2d + crack_network),
      variant(
          "crack_network_filled", "crack_fluid/network", box_2d + crack_network,
          {"crack_fluid.filled=[{from: [4 m, 4 m], to: [8 m, 8 m], pressure: 10 kPa}]",
           "crack_fluid.inlets=[{name: well, at: [8 m, 5 m], rate: -1e-3 m^2/s}, {name: tank, at: "
           "[3 m, 5 m], holds: pressure, pressure: 20 kPa, schedule: {ramp: 5 ms}}]"}),
      variant("crack_network_from_fluid", "crack_fluid/network",
              box_2d + crack_network + water_over_box_2d,
              {"crack_fluid.inlets=[{name: mouth, at: [3 m, 5 m], holds: fluid}]"}),
      variant("crack_network_carter", "crack_fluid/network", box_2d + crack_network,
              {"crack_fluid.leak_off=carter", "crack_fluid.leak_off_coefficient=1e-5 m/s*sqrt(s)",
               "crack_fluid.vapour_pressure=-50 kPa"}),
      variant("crack_network_carter_by_region", "crack_fluid/network", box_2d + crack_network,
              {"body.regions={right: {from: [6 m, 0 m]}}", "crack_fluid.leak_off=carter",
               "crack_fluid.leak_off_coefficient=1e-5 m/s*sqrt(s)",
               "crack_fluid.regions={right: {leak_off_coefficient: 4e-5 m/s*sqrt(s)}}"}),
      variant("crack_network_of_a_well", "crack_fluid/network", box_2d + crack_network,
              {well, "crack_fluid.inlets=[]"}),
      variant("crack_network_in_pores", "crack_fluid/network", box_2d + darcy + crack_network,
              {"crack_fluid.leak_off=pores"}),
      variant("crack_network_3d", "crack_fluid/network", box_3d + crack_network,
              {inlet_3d, "crack_fluid.leak_off=carter",
               "crack_fluid.leak_off_coefficient=1e-5 m/s*sqrt(s)"}),
      variant("crack_network_in_pores_3d", "crack_fluid/network", box_3d + darcy + crack_network,
              {inlet_3d, "crack_fluid.leak_off=pores"}),
      variant("uniform_pressure", "crack_fluid/uniform_pressure", box_2d + uniform_pressure),
      variant("uniform_pressure_filled", "crack_fluid/uniform_pressure", box_2d + uniform_pressure,
              {"crack_fluid.filled=[{from: [4 m, 4 m], to: [8 m, 8 m], pressure: 10 kPa}]",
               "crack_fluid.inlets=[{name: well, at: [8 m, 5 m], rate: -1e-3 m^2/s}, {name: tank, "
               "at: [3 m, 5 m], holds: pressure, pressure: 20 kPa, schedule: {ramp: 5 ms}}]"}),
      variant("uniform_pressure_of_a_well", "crack_fluid/uniform_pressure",
              box_2d + uniform_pressure, {well, "crack_fluid.inlets=[]"}),
      variant("uniform_pressure_from_fluid", "crack_fluid/uniform_pressure",
              box_2d + uniform_pressure + water_over_box_2d,
              {"crack_fluid.inlets=[{name: mouth, at: [3 m, 5 m], holds: fluid}]"}),
      variant("uniform_pressure_carter", "crack_fluid/uniform_pressure", box_2d + uniform_pressure,
              {"crack_fluid.leak_off=carter", "crack_fluid.leak_off_coefficient=1e-5 m/s*sqrt(s)",
               "crack_fluid.vapour_pressure=-50 kPa"}),
      variant("uniform_pressure_in_pores", "crack_fluid/uniform_pressure",
              box_2d + darcy + uniform_pressure, {"crack_fluid.leak_off=pores"}),
      variant("uniform_pressure_in_pores_3d", "crack_fluid/uniform_pressure",
              box_3d + darcy + uniform_pressure, {inlet_3d, "crack_fluid.leak_off=pores"}),
  };
  for (const ModuleType& type : module_types()) {
    if (type.section != "fluid") continue;
    const std::vector<Variant> of_method = fluid_variants(type.name);
    all.insert(all.end(), of_method.begin(), of_method.end());
  }
  return all;
}

const std::vector<Variant>& variants() {
  static const std::vector<Variant> all = make_variants();
  return all;
}

std::vector<ModuleCase> cases() {
  std::vector<ModuleCase> cases;
  for (const Variant& variant : variants()) cases.push_back(variant.contract);
  return cases;
}

INSTANTIATE_TEST_SUITE_P(Physics, ModuleContract, testing::ValuesIn(cases()), case_name);

TEST(ModuleContract, CoversEveryRegisteredModule) {
  std::set<std::string> covered;
  for (const Variant& variant : variants()) covered.insert(variant.type);
  for (const ModuleType& type : module_types()) {
    EXPECT_TRUE(covered.contains(type.section + "/" + type.name)) << type.section << type.name;
  }
}

/// The same solid of linear peridynamic material.
std::string with_lps(std::string solid) {
  return solid.replace(solid.find("material: {"), 11, "material: {type: lps, ");
}

const std::vector<std::vector<std::string>> flow_sections = {
    {},
    {"pore_flow.integrator.type=explicit"},
    {"pore_flow.integrator.type=cvode"},
    {"pore_flow.operator=bond"},
    {"pore_flow.integrator.linear_solver=krylov"},
    {"pore_flow.type=finite_volume"},
    {"pore_flow.type=finite_volume", "pore_flow.integrator.type=explicit"}};

/// The splits that the two can use.
std::vector<std::string> splits_for(const std::string& solid, bool flow) {
  const std::vector<std::string> all = {"automatic", "drained", "fixed_stress", "undrained"};
  if (!flow || solid.empty() || solid == rigid) return all;
  const bool dynamic = solid == dynamic_2d || solid == with_lps(dynamic_2d);
  return {"automatic", "drained", dynamic ? "undrained" : "fixed_stress"};
}

void expect_to_run(const Section& scene, int modules, int links) {
  Simulation simulation = make_simulation(scene);
  CouplingManager& manager = *simulation.manager;
  initialize(scene, simulation);
  manager.settle();
  for (int window = 0; window < 3; ++window) manager.advance(1.0);
  EXPECT_EQ(manager.modules().size(), modules);
  EXPECT_EQ(manager.links().size(), links);
  for (const Field& field : fields_of(manager)) {
    for (const double value : field.values()) ASSERT_TRUE(std::isfinite(value));
  }
  if (const auto mass = manager.ledger().mass()) {
    EXPECT_LT(mass->relative_error, 1e-12);
  }
}

/// Every solid beside every pore flow, each also alone, under every split: it runs, with finite
/// results, and only what is named exists; or it is refused.
TEST(SwapMatrix, EveryCombinationRunsOrIsRefused) {
  for (const std::string& solid : {std::string(), rigid, quasi_static_2d, with_lps(quasi_static_2d),
                                   dynamic_2d, with_lps(dynamic_2d)}) {
    for (const auto& flow : flow_sections) {
      if (solid.empty() && flow.empty()) continue;
      for (const char* split : {"automatic", "drained", "fixed_stress", "undrained"}) {
        SCOPED_TRACE(solid + (flow.empty() ? "no pore flow " : flow[0] + " ") + split);
        std::vector<std::string> overrides = flow;
        overrides.push_back(std::string("coupling.split=") + split);
        const Section scene =
            read_scene_text(box_2d + solid + (flow.empty() ? "" : darcy), overrides);
        const bool coupled = !flow.empty() && !solid.empty() && solid != rigid;
        if (std::ranges::count(splits_for(solid, !flow.empty()), split) == 0) {
          Simulation simulation = make_simulation(scene);
          EXPECT_THROW(initialize(scene, simulation), InputError);
          continue;
        }
        expect_to_run(scene, !solid.empty() + !flow.empty(), coupled ? 2 : 0);
      }
    }
  }
}

class CrackFluids : public testing::TestWithParam<std::string> {};

INSTANTIATE_TEST_SUITE_P(SwapMatrix, CrackFluids, testing::Values(crack_network, uniform_pressure),
                         [](const auto& test) { return word_of_type(test.param); });

/// A solid that fluid in its cracks splits, by one word, with and without pores to leak into.
TEST_P(CrackFluids, RunInEverySolid) {
  struct LeakOff {
    const char* word;
    std::string flow;
    std::size_t links;
  };
  const std::vector<LeakOff> ways = {
      {"none", "", 3}, {"carter", "", 4}, {"pores", darcy, 8}, {"pores", finite_volume, 8}};
  for (const std::string& solid : {quasi_static_2d, with_lps(quasi_static_2d), dynamic_2d}) {
    for (const auto& [word, flow, links] : ways) {
      SCOPED_TRACE(solid + word + flow);
      std::vector<std::string> overrides = {
          "cracks=[{name: cut, path: [2 m, 4 m, 6 m, 4 m]}]",
          "damage={type: energy_release, fracture_energy: 1 kJ/m^2}",
          std::string("crack_fluid.leak_off=") + word, "coupling.iterations.max=20"};
      if (word == std::string("carter")) {
        overrides.push_back("crack_fluid.leak_off_coefficient=1e-5 m/s*sqrt(s)");
      }
      const Section scene = read_scene_text(box_2d + solid + GetParam() + flow, overrides);
      // In equilibrium tips are within facets: so much of them is crack.
      expect_to_run(scene, flow.empty() ? 2 : 3, links + (solid != dynamic_2d));
    }
  }
}

TEST_P(CrackFluids, RunIn3DInASolidWithoutInertia) {
  for (const std::string& flow : {std::string(), darcy, finite_volume}) {
    const bool pores = !flow.empty();
    const std::vector<std::string> overrides = {
        cracked_3d, inlet_3d, "damage={type: energy_release, fracture_energy: 1 kJ/m^2}",
        std::string("crack_fluid.leak_off=") + (pores ? "pores" : "none"),
        "coupling.iterations.max=20"};
    const std::string fluids = GetParam() + flow;
    expect_to_run(read_scene_text(box_3d + quasi_static_3d + fluids, overrides), pores ? 3 : 2,
                  pores ? 8 : 3);
    EXPECT_THROW(make_simulation(read_scene_text(box_3d + dynamic_3d + fluids, overrides)),
                 InputError);
    std::vector<std::string> lps = overrides;
    lps.push_back("solid.material.type=lps");
    EXPECT_THROW(make_simulation(read_scene_text(box_3d + quasi_static_3d + fluids, lps)),
                 InputError);
  }
}

TEST(SwapMatrix, StabilisedPoreFlowRunsInEveryFlow) {
  for (const auto& flow : flow_sections) {
    std::vector<std::string> overrides = flow;
    overrides.push_back("pore_flow.undrained_stabilisation=0.25");
    if (flow.empty()) continue;
    SCOPED_TRACE(flow[0]);
    expect_to_run(read_scene_text(box_2d + quasi_static_2d + darcy, overrides), 2, 2);
    expect_to_run(read_scene_text(box_2d + quasi_static_2d + darcy + water_over_box_2d, overrides),
                  3, 7);
    overrides.insert(overrides.end(), {"cracks=[{name: cut, path: [2 m, 4 m, 6 m, 4 m]}]",
                                       "damage={type: energy_release, fracture_energy: 1 kJ/m^2}",
                                       "crack_fluid.leak_off=pores"});
    expect_to_run(read_scene_text(box_2d + quasi_static_2d + crack_network + darcy, overrides), 3,
                  9);
  }
}

/// Fluid under its own weight rests, faces or not: what varies from point to point knows nothing of
/// pressures that grow downwards.
TEST(StabilisedPoreFlow, LeavesFluidAtRest) {
  for (const char* operator_name : {"conservative", "bond"}) {
    const auto flow =
        make_module(box_2d + quasi_static_2d + darcy, "pore_flow",
                    {"pore_flow.undrained_stabilisation=0.25", "gravity=[0 m/s^2, -9.81 m/s^2]",
                     "solid.density=2000 kg/m^3", "pore_flow.initial_state=hydrostatic",
                     "pore_flow.boundary={left: {type: sealed}}",
                     std::string("pore_flow.operator=") + operator_name});
    flow->initialize(0.0);
    const auto port = [&](const std::string& name) { return test::port_named(*flow, name); };
    const std::span<const double> pressure = port("pore_pressure").value;
    const std::vector<double> before(pressure.begin(), pressure.end());
    const PortView dilatation = port("dilatation");
    for (std::size_t i = 0; i < before.size(); ++i) {
      dilatation.slope[i] = 1e-9;  // of a rock that has settled under this pressure
      dilatation.value[i] = -1e-9 * 0.9 * before[i];
      dilatation.rate[i] = 0.0;
    }
    flow->advance({0.0, 0.0});
    flow->advance({0.0, 10.0});
    for (std::size_t i = 0; i < before.size(); ++i) {
      EXPECT_NEAR(pressure[i], before[i], 1e-9 * before[0]) << operator_name << ' ' << i;
    }
  }
}

/// Every method for the free fluid, by one word, on every solid and every pore flow, and at a
/// crack's mouth, in 2D and 3D.
TEST(SwapMatrix, EveryFluidRunsBesideEverything) {
  const std::string mouth = "crack_fluid.inlets=[{name: mouth, at: [5 m, 11 m], holds: fluid}]";
  for (const ModuleType& type : module_types()) {
    if (type.section != "fluid") continue;
    const std::string word = "fluid.type=" + type.name;
    for (const std::string& solid : {std::string(), rigid, quasi_static_2d, dynamic_2d}) {
      for (const auto& flow : flow_sections) {
        if (solid.empty() && flow.empty()) continue;
        SCOPED_TRACE(word + solid + (flow.empty() ? "no pore flow" : flow[0]));
        std::vector<std::string> overrides = flow;
        overrides.push_back(word);
        const bool moves = !solid.empty() && solid != rigid;
        // Displacement and impulse; pressure, mobility and mass; dilatation and pore stress.
        const int links = 2 * moves + 3 * !flow.empty() + 2 * (moves && !flow.empty());
        expect_to_run(
            read_scene_text(box_2d + solid + (flow.empty() ? "" : darcy) + water_over_box_2d,
                            overrides),
            1 + !solid.empty() + !flow.empty(), links);
      }
    }
    SCOPED_TRACE(word + " in 3D");
    expect_to_run(read_scene_text(tank_3d, {word}), 1, 0);
    expect_to_run(read_scene_text(box_3d + quasi_static_3d + darcy + water_over_box_3d, {word}), 3,
                  7);
    expect_to_run(read_scene_text(box_2d + quasi_static_2d + crack_network + water_over_box_2d,
                                  {word, mouth, cracked_at_top,
                                   "damage={type: energy_release, fracture_energy: 1 kJ/m^2}"}),
                  3, 12);
  }
}

TEST(SwapMatrix, WindowsOfOneStepAreTheShortestExplicitStep) {
  for (const char* type : {"explicit", "cvode"}) {
    const Section scene = read_scene_text(
        box_2d + dynamic_2d + darcy,
        {"coupling.window.type=one_step", std::string("pore_flow.integrator.type=") + type});
    Simulation simulation = make_simulation(scene);
    CouplingManager& manager = *simulation.manager;
    initialize(scene, simulation);
    manager.settle();
    double shortest = 1.0;
    for (const ModuleSlot& slot : manager.modules()) {
      shortest = std::min(shortest, slot.module->stable_time_step());
    }
    EXPECT_NEAR(manager.advance(1.0), shortest, 1e-15);
    for (int window = 0; window < 9; ++window) manager.advance(1.0);
    for (const ModuleSlot& slot : manager.modules()) {
      const auto ports = slot.module->ports();
      const auto steps = std::ranges::find(ports, "integrator_steps", &Port::name);
      if (slot.name == "solid") {
        EXPECT_EQ(slot.module->port(steps - ports.begin()).value[0], 10.0);
      }
    }
  }
}

/// Saved, restored into another simulation, and run on: as if never stopped, bit for bit.
void expect_same_after_restart(const Section& scene) {
  const auto fields = [](CouplingManager& manager) {
    Snapshot state;
    state.save([&](StateVisitor& visitor) { manager.visit_state(visitor); });
    return state;
  };
  Simulation whole = make_simulation(scene), restarted = make_simulation(scene);
  initialize(scene, whole);
  whole.manager->settle();
  for (int i = 0; i < 5; ++i) whole.manager->advance(1.0);
  const Snapshot middle = fields(*whole.manager);
  whole.manager->restart_point();
  initialize(scene, restarted);
  middle.restore([&](StateVisitor& visitor) { restarted.manager->visit_state(visitor); });
  restarted.manager->restart_point();
  for (Simulation* run : {&whole, &restarted}) {
    for (int i = 0; i < 5; ++i) run->manager->advance(1.0);
  }
  EXPECT_EQ(fields(*restarted.manager).fields(), fields(*whole.manager).fields());
}

TEST(PhysicsRestart, DynamicSolidBesidePoreFlow) {
  for (const char* window : {"schedule", "one_step"}) {
    for (const char* type : {"explicit", "cvode"}) {
      SCOPED_TRACE(std::string(window) + ' ' + type);
      expect_same_after_restart(read_scene_text(
          box_2d + dynamic_2d + darcy, {std::string("coupling.window.type=") + window,
                                        std::string("pore_flow.integrator.type=") + type}));
    }
  }
}

TEST(PhysicsRestart, EveryFluidOnPoresOfASolid) {
  for (const ModuleType& type : module_types()) {
    if (type.section != "fluid") continue;
    SCOPED_TRACE(type.name);
    expect_same_after_restart(read_scene_text(box_2d + quasi_static_2d + darcy + water_over_box_2d,
                                              {"fluid.type=" + type.name}));
    expect_same_after_restart(read_scene_text(tank_3d, {"fluid.type=" + type.name}));
  }
}

TEST(PhysicsRestart, StabilisedPoreFlow) {
  for (const char* type : {"explicit", "cvode"}) {
    for (const char* passes : {"1", "20"}) {
      SCOPED_TRACE(std::string(type) + ' ' + passes);
      expect_same_after_restart(read_scene_text(
          box_2d + quasi_static_2d + darcy, {"pore_flow.undrained_stabilisation=0.25",
                                             std::string("coupling.iterations.max=") + passes,
                                             std::string("pore_flow.integrator.type=") + type}));
    }
  }
}

}  // namespace
}  // namespace perifrac
