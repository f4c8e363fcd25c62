#pragma once

#include <limits>
#include <span>
#include <string>

#include "core/base/point_set.hpp"

namespace perifrac {

enum class PortDirection { in, out };

/// An intensive quantity is a value at a point (pressure); an extensive one a total over the window
/// (impulse, mass), so that sub-cycling loses nothing. It decides how a link maps between points.
enum class PortKind { intensive, extensive };

/// What a port is for, beyond being linked to a port of the same name: frames and history write
/// fields, the ledger adds up masses and energies, the summary lists work; nobody shows properties.
enum class PortRole {
  field,              ///< a quantity on points
  property,           ///< a quantity on points for links only, to which no slope refers
  mass_stored,        ///< fluid mass held now [kg], one value
  mass_reference,     ///< what mass_stored is counted from, where that is not 0 [kg]; never shown
  mass_gained,        ///< fluid mass taken in through boundaries and sources since the start [kg]
  mass_artificial,    ///< fluid mass that a numerical measure made [kg]: shown, never excused
  energy_stored,      ///< [J]
  energy_gained,      ///< work done on the system from outside since the start [J]
  energy_dissipated,  ///< turned into heat since the start [J]
  work,               ///< how often a solver did something in this process, for the summary
};

/// A module's ports are numbered by their place in `PhysicsModule::ports()`.
using PortId = int;

/// The fixed part of a port. In 2D, totals are per metre of thickness.
struct Port {
  std::string name;
  std::string unit;
  PortDirection direction = PortDirection::out;
  PortKind kind = PortKind::intensive;
  PortRole role = PortRole::field;
  int components = 1;
  /// A value of this size is as good as none: two that differ by less agree.
  double negligible = 0.0;
};

/// A strain below the rounding of 1 is none, nor is what that comes to as a pressure in pores that
/// are as good as empty: a body at rest has nothing to be compared with.
inline constexpr double negligible_strain = std::numeric_limits<double>::epsilon();
inline constexpr double negligible_pressure = 1e-6;  // [Pa]

/// The unit of a total, such as a mass or an energy: in 2D it is per metre of thickness.
inline std::string unit_of_total(const std::string& unit, int dimension) {
  return dimension == 2 ? unit + "/m" : unit;
}

/// A mass [kg] or energy [J] for the ledger.
inline Port total_port(const char* name, const char* unit, PortRole role, int dimension) {
  return {.name = name,
          .unit = unit_of_total(unit, dimension),
          .kind = PortKind::extensive,
          .role = role};
}

/// How often a solver did something.
inline Port work_port(const char* name) {
  return {.name = name, .unit = "1", .kind = PortKind::extensive, .role = PortRole::work};
}

/// The changing part of a port, refetched at every exchange. Arrays hold components * count values,
/// component by component (all x, then all y).
///
/// An input is, within the window, value + rate (t - window end) + slope x, with x the quantity
/// that the module itself sends back over the coupled port. An output gives `value` at the time
/// reached and, where a coupling scheme needs it, `slope` = d(output)/d(its coupled input);
/// `rate` is unused there. Spans that a port does not carry are empty.
///
/// A slope has one value a point where the output depends on the input at the same point, or is
/// taken to; where every point answers to every other (the opening of a crack to its pressure) it
/// is a matrix of count * count values, row by row, and both ends lie on the same points.
///
/// An output that its module can tell ahead carries `forecast` too: what it will be at the end of
/// the window that prepare() was told of, slope x apart. Then one pass is exact, and no window is
/// longer than the module's stable step, for which that holds.
struct PortView {
  const PointSet* points = nullptr;
  std::span<double> value{};
  std::span<double> rate{};
  std::span<double> slope{};
  std::span<double> forecast{};
};

}  // namespace perifrac
