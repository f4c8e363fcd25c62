#include "modules/pore_flow/storage/storage_choice.hpp"

#include <algorithm>
#include <optional>
#include <ranges>
#include <string>

#include <fmt/format.h>

#include "modules/pore_flow/storage/linear_storage.hpp"
#include "modules/pore_flow/storage/stabilised_storage.hpp"
#include "modules/pore_flow/storage/tait_storage.hpp"

namespace perifrac {

namespace {

constexpr const char* key = "undrained_stabilisation";

/// Why stabilised storage cannot be, and what would do.
struct NotCovered {
  std::string problem;
  const char* expected;
};

/// It takes its size from the slope of the dilatation, which a quasi-static solid sends.
template <int D>
std::optional<NotCovered> not_covered(const Section& section, const Body<D>& body) {
  const Section scene = section.scene();
  if (!scene.has("solid") || scene.word("solid.type") != "quasi_static") {
    return NotCovered{"no solid of type quasi_static, whose answer it makes up for",
                      "0, or such a solid"};
  }
  if (const std::string split = scene.word("coupling.split");
      split == "drained" || split == "undrained") {
    return NotCovered{fmt::format("coupling.split '{}' sends no slope of the dilatation", split),
                      "0, or coupling.split: automatic"};
  }
  if (section.word("fluid.equation_of_state") == "tait") {
    return NotCovered{"storage after Tait is different at every pressure",
                      "0, or fluid.equation_of_state: linear"};
  }
  if (section.word("type") == "darcy" && section.word("operator") == "nested") {
    return NotCovered{"operator 'nested' is for comparison as published",
                      "0, or operator conservative or bond"};
  }
  for (int face = 0; face < std::ssize(body.faces()); ++face) {
    if (body.layer(face).empty()) continue;
    return NotCovered{fmt::format("a bonded layer behind face '{}'", body.faces()[face].name),
                      "0, or a body without layers"};
  }
  return {};
}

/// Fluid that is forced into one point of such rock would leave its neighbours at less than -0.02
/// of its pressure (docs/decisions/0017).
bool needs_stabilisation(const PoreMaterials& materials, std::span<const double> slope) {
  constexpr double strength = 0.25;
  return std::ranges::any_of(std::views::iota(std::size_t{0}, slope.size()), [&](std::size_t i) {
    const PoreMaterial& rock = materials.at(static_cast<Index>(i));
    return rock.biot_coefficient * rock.biot_coefficient * slope[i] > strength * rock.storage;
  });
}

}  // namespace

template <int D>
bool can_be_stabilised(const Section& pore_flow, const Body<D>& body) {
  return !not_covered(pore_flow, body);
}

template <int D>
std::unique_ptr<PoreStorage> make_storage(const Section& section, const Body<D>& body,
                                          const PoreFluid& fluid, PoreMaterials materials) {
  if (section.has(key) && section.number(key) > 0.0) {
    if (const auto reason = not_covered(section, body)) {
      section.fail(key, reason->problem, reason->expected);
    }
    return std::make_unique<StabilisedStorage<D>>(std::move(materials), body.family(0),
                                                  section.number(key), body.spacing(),
                                                  body.irregular());
  }
  if (fluid.is_linear()) return std::make_unique<LinearStorage>(std::move(materials));
  return std::make_unique<TaitStorage>(std::move(materials), fluid);
}

template <int D>
StorageChoice storage_choice(const Section& section, std::shared_ptr<const Body<D>> body,
                             PoreMaterials materials) {
  if (section.has(key) || not_covered(section, *body)) return {};
  return [=](std::span<const double> slope) -> std::unique_ptr<PoreStorage> {
    constexpr double enough = 0.25;
    if (!needs_stabilisation(materials, slope)) return nullptr;
    // Without ghosts: a mirror would make fluid of linear pressures.
    auto made = std::make_unique<StabilisedStorage<D>>(materials, body->family(0), enough,
                                                       body->spacing(), body->irregular());
    made->take_bonds(body->bond_state().broken());
    return made;
  };
}

KeyTable storage_choice_keys() {
  return {{.path = key,
           .range = "[0, 1]",
           .meaning =
               "Storage of what varies from point to point, for fluid that enters nearly undrained "
               "rock in times short against dx^2/c: 0.25 keeps pressure from undershooting, and "
               "windows of any length stable. 0: none. Beside a quasi-static solid, a linear "
               "fluid, no layers. Left out: 0.25 there, where the Biot coefficient squared over "
               "storage and drained bulk modulus is above 0.25 somewhere; none elsewhere"}};
}

template bool can_be_stabilised(const Section&, const Body<2>&);
template bool can_be_stabilised(const Section&, const Body<3>&);
template std::unique_ptr<PoreStorage> make_storage<2>(const Section&, const Body<2>&,
                                                      const PoreFluid&, PoreMaterials);
template std::unique_ptr<PoreStorage> make_storage<3>(const Section&, const Body<3>&,
                                                      const PoreFluid&, PoreMaterials);
template StorageChoice storage_choice<2>(const Section&, std::shared_ptr<const Body<2>>,
                                         PoreMaterials);
template StorageChoice storage_choice<3>(const Section&, std::shared_ptr<const Body<3>>,
                                         PoreMaterials);

}  // namespace perifrac
