#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "core/state/state_visitor.hpp"
#include "modules/solid/equilibrium/cracked_equilibrium.hpp"

namespace perifrac {

/// The ledger of a cracked body in equilibrium: what its loads did since the start, what new faces
/// took, what unstable growth set free [J, per metre in 2D].
template <int D>
class CrackedWork {
 public:
  /// The body must stay.
  explicit CrackedWork(CrackedEquilibrium<D>& body) : body_(body) {}

  void start();
  /// Work since the last time, of the equilibrium that was found.
  void book();
  /// On new faces.
  void spend(double energy) { spent_ += energy; }
  /// Set free by unstable growth, beyond what new faces took.
  void radiate(double energy) { radiated_ += energy; }

  double elastic_energy();
  double external_work() const { return external_; }
  double fracture_energy() const { return spent_; }
  double radiated_energy() const { return radiated_; }
  /// What loads have done beyond what the rock holds: it grows by what growth sets free.
  double released_energy();

  void visit_state(StateVisitor& visitor);
  /// When it was last booked; empty where the load is steady [m].
  std::span<const double> displacement() const;

 private:
  void book_steady();
  void book_changing();
  double relief(std::span<const double> unknowns, std::span<const double> dilatation) const;
  /// What comes on at once at the start does half of the work: a body in equilibrium has no kinetic
  /// energy.
  double share() const { return has_begun_ == 0 ? 0.5 : 1.0; }

  CrackedEquilibrium<D>& body_;
  std::int64_t has_begun_ = 0;  ///< work has been booked
  double external_ = 0.0, spent_ = 0.0, radiated_ = 0.0;
  double relief_ = 0.0;  ///< when it was last booked (CrackedBody::Energies)
  // Likewise, under a steady load:
  double load_ = 0.0, elastic_ = 0.0;
  // Under another:
  std::vector<double> displacement_;  ///< all unknowns [m]
  std::vector<double> force_;         ///< external, on each, the fluid's in cracks apart [N/m]
};

}  // namespace perifrac
