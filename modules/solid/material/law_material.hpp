#pragma once

#include <algorithm>
#include <memory>
#include <string>
#include <utility>

#include <fmt/format.h>

#include "modules/solid/material/law_check.hpp"
#include "modules/solid/material/material_type.hpp"
#include "modules/solid/material/nonlinear_elasticity.hpp"

namespace perifrac {

/// The operator with a law; throws InputError for one that is none (law_problem()).
template <int D, class Law>
std::unique_ptr<ElasticOperator<D>> make_law_material(const MaterialParts<D>& parts) {
  const Section& section = parts.section;
  const std::string word = section.word("material.type");
  if (section.has("material.scatter")) {
    section.fail("material.scatter", fmt::format("beside material.type: {}", word),
                 "linear_exact or lps");
  }
  LawByRegion<Law> law{{}, parts.rock.law_of_point};
  for (const IsotropicElasticity<D>& rock : parts.rock.laws) {
    law.laws.push_back(Law::read(section.at("material"), rock));
    if (const std::string problem = law_problem<D>(law.laws.back()); !problem.empty()) {
      section.fail("material.type", fmt::format("'{}' is no law of elasticity: {}", word, problem),
                   "stress that is the derivative of an energy");
    }
  }
  if constexpr (is_linear_law<Law>()) {
    return std::make_unique<LinearExactElasticity<D, LawByRegion<Law>>>(
        LinearExactOperator<D, LawByRegion<Law>>(parts.family, parts.mirror, std::move(law)),
        parts.initial_stress);
  } else {
    if (parts.family->curved) {
      section.fail("boundary", fmt::format("a mirrored sphere beside material.type: {}", word),
                   "a free sphere");
    }
    double stiffening = 1.0;
    for (const Law& each : law.laws) stiffening = std::max(stiffening, each.stiffening());
    return std::make_unique<NonlinearElasticity<D, Law>>(parts.family, parts.mirror, std::move(law),
                                                         parts.initial_stress, stiffening);
  }
}

/// The material of a law, a class template on the dimension:
///   static constexpr int components = D;
///   static Law read(const Section& material, const IsotropicElasticity<D>& rock);
///   std::array<Number, D * D> stress(const std::array<Number, D * D>& gradient) const;   // [Pa]
///   double stabilisation() const;                       // of bonds against their gradient [Pa]
///   double drained_bulk_modulus() const;                // [Pa]
///   const IsotropicElasticity<D>& isotropic() const;    // the rock that it was read from
/// `stress` as a template on Number goes over several points at once. A nonlinear one also:
///   static constexpr bool is_linear = false;
///   double energy(const std::array<double, D * D>& gradient) const;   // [J/m^3]
///   double stiffening() const;     // how many times as stiff as at rest it may become, 1 or more
/// One with a memory has it as a further argument of stress() and energy(), all 0 at first, and
///   static constexpr std::size_t memory = ...;          // how many numbers a point remembers
///   double follow(const std::array<double, D * D>& gradient, std::array<double, memory>& memory,
///                 double seconds) const;
/// which takes it along to the gradient that was reached, and returns the heat per volume of that.
template <template <int> class Law>
MaterialType law_material(std::string name, std::string meaning, KeyTable keys = {}) {
  return {.name = std::move(name),
          .meaning = std::move(meaning),
          .keys = std::move(keys),
          .is_linear = is_linear_law<Law<2>>(),
          .make_2d = make_law_material<2, Law<2>>,
          .make_3d = make_law_material<3, Law<3>>};
}

}  // namespace perifrac
