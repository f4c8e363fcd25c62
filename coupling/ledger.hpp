#pragma once

#include <memory>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "core/state/state_visitor.hpp"
#include "coupling/module_slot.hpp"
#include "coupling/summed_input.hpp"

namespace perifrac {

/// One conserved quantity over all modules, since the start: stored - stored at the start =
/// gained - dissipated, up to `error`.
struct Balance {
  double stored = 0.0;
  double gained = 0.0;
  double dissipated = 0.0;
  double error = 0.0;           ///< what is there beyond what should be
  double relative_error = 0.0;  ///< |error| / the largest of what was and is stored and what passed
};

/// A column of history.csv.
struct LedgerColumn {
  std::string name;
  std::string unit;
  double value;
};

/// Adds up what modules say on their ports of the roles mass_* and energy_*. A quantity that no
/// module stores has no balance and no columns. What is stored, gained or dissipated on several
/// ports has a column for each beside their sum. What numerical measures made has a column of its
/// own; the error holds it too.
class Ledger {
 public:
  explicit Ledger(std::span<ModuleSlot> modules) : modules_(modules) {}

  /// What is stored now is the start. To be called before all else.
  void start();

  /// What came on at once at the start has been answered. Energy that this set free, which would
  /// move a body with inertia, is gone: what is left is the start. Returns it, over the largest of
  /// what was and is stored and what passed; 0 where none was.
  double settle();

  std::optional<Balance> mass() const;    ///< of fluid [kg; in 2D kg/m]
  std::optional<Balance> energy() const;  ///< [J; in 2D J/m]

  /// From now on what modules hand over to one in-port has a column for each of them, named
  /// `<port>_from_<module>`: what passed since the start, in `unit`, part of no balance.
  void show(const std::string& port, const std::string& unit,
            std::shared_ptr<const SummedInput> sum);

  /// Always the same names in the same order for the same modules.
  std::vector<LedgerColumn> columns() const;

  /// Throws NumericalError where the relative error of the fluid mass at time t [s] is above
  /// `bound`, and more than rounding could do to all the fluid there is.
  void check_mass(double bound, double t) const;

  void visit_state(StateVisitor& visitor);

 private:
  std::span<ModuleSlot> modules_;
  std::optional<double> mass_at_start_;  ///< nothing where no module stores it
  std::optional<double> energy_at_start_;

  struct Exchange {
    std::string port;
    std::string unit;
    std::shared_ptr<const SummedInput> sum;
  };
  std::vector<Exchange> exchanges_;
};

}  // namespace perifrac
