#include "app/run/failure.hpp"

#include <algorithm>
#include <new>
#include <string_view>

#include "core/base/errors.hpp"

namespace perifrac {

namespace {

/// What helps against an error that says `words`; the first that fits counts.
struct Advice {
  std::string_view words;
  std::string_view change;
};

constexpr Advice known[] = {
    {"no balance of mass",
     "the fluid there has no room, or no way out in time: lower the rates of the inlets, raise "
     "`crack_fluid.residual_aperture`, or shorten `coupling.window.largest`"},
    {"serves another inlet", "place the inlets at facets of their own"},
    {"left a piece that nothing holds", "hold it by `solid.boundary` or `solid.pins`"},
    {"windows of one pass", "leave `coupling.iterations.max` and `coupling.split` out"},
    {"the coupling ",
     "raise `coupling.iterations.max`, or take `coupling.split: automatic`; after a sudden load "
     "shorten `coupling.window.first`"},
    {"the box leaks", "widen `fluid.domain`, close the walls, or bring the points closer together"},
    {"more flows into the pores",
     "lower the permeability of the rock or the pressure of the fluid, or bring its points closer "
     "together"},
    {"the implicit integrator",
     "loosen `pore_flow.integrator.tolerance`, or take `type: explicit`"},
    {"the stable time step", "look for a modulus, density or permeability that is not meant"},
    {"above ledger.mass_error",
     "shorten `coupling.window.largest`; raise `ledger.mass_error` only where the scheme is known "
     "not to keep mass"},
    {"fluid_velocity", "look for a rate or a load near that place that is not meant"},
    {"finite",
     "a value grew without bound: raise `coupling.iterations.max`, shorten `coupling.window`, or "
     "look for a load or a property near that place that is not meant"},
    {"not a number", "look for a load or a property near that place that is not meant"},
};

}  // namespace

Failure failure_of(const std::exception& error) {
  if (dynamic_cast<const std::bad_alloc*>(&error) != nullptr) {
    return {.error = "out of memory",
            .advice =
                "`perifrac check` says how much a run takes; what was written stays, and the "
                "last checkpoint can be gone on from"};
  }
  Failure failure{.error = error.what()};
  const auto* const numerical = dynamic_cast<const NumericalError*>(&error);
  if (numerical == nullptr) return failure;
  failure.field = numerical->field();
  failure.place = numerical->place();
  failure.time = numerical->time();
  const auto* const fitting = std::ranges::find_if(
      known, [&](const Advice& one) { return failure.error.find(one.words) != std::string::npos; });
  if (fitting != std::end(known)) failure.advice = fitting->change;
  return failure;
}

std::string describe(const Failure& failure) {
  return failure.advice.empty() ? failure.error : failure.error + "; " + failure.advice;
}

}  // namespace perifrac
