#pragma once

#include <memory>
#include <span>
#include <utility>
#include <vector>

#include "core/bonds/bond_state.hpp"
#include "modules/solid/fracture/stretch_budget.hpp"
#include "modules/solid/material/breakable_elasticity.hpp"
#include "modules/solid/motion/body_fracture.hpp"

namespace perifrac {

/// Bonds that break for good where they are stretched beyond a limit, |xi + du| > (1 + s0) |xi| of
/// the reference bond xi (paper section 2.3). For small displacements that is xi . du > s0 |xi|^2;
/// unlike this, it lets go of a loose piece that slides past or turns away.
template <int D>
class CriticalStretch final : public BodyFracture {
 public:
  /// `family` is the one of `elastic`, with nothing broken. Writes `bonds`. A limit of infinity
  /// breaks nothing but what the seeds cut.
  CriticalStretch(std::shared_ptr<Family<D>> family,
                  std::shared_ptr<BreakableElasticity<D>> elastic, BondState<D>& bonds,
                  std::vector<CrackFacet<D>> seeds, double limit);

  /// Cuts what the body is cut by from the start; once, after the intact body's loads are known.
  void cut_seeds();
  /// Breaks every bond that is stretched too far at u; whether there was one.
  bool breaks(std::span<const double> u) override;

  /// A bound, at least 1, of how much stiffer the body is than after cut_seeds(): a point whose
  /// bonds span space poorly makes large gradients of small displacements.
  double stiffness_growth() const override { return growth_; }
  /// What breaking took from the elastic energy, seeds apart [J].
  double released_energy() const { return released_energy_; }
  /// Part of the volume of a point's family that is beyond broken bonds (paper Eq 16).
  void damage(std::span<double> result) const { find_damage(*family_, result); }

  /// Broken bonds and the energy; follow_state() makes the body that they belong to.
  void visit_state(StateVisitor& visitor);
  void follow_state() override;

 private:
  using Bonds = std::vector<std::pair<Index, Index>>;

  Bonds stretched_bonds(std::span<const double> u);
  double left_to_limit(Index i, std::span<const double> u) const;
  void append_stretched(Index i, std::span<const double> u, Bonds& bonds) const;
  void break_in_family(std::span<const std::pair<Index, Index>> bonds,
                       std::span<const Index> points);
  double stiffness_bound(Index i) const;
  void find_growth(std::span<const Index> points);

  std::shared_ptr<Family<D>> family_;
  std::shared_ptr<BreakableElasticity<D>> elastic_;
  BondState<D>& bonds_;
  std::vector<CrackFacet<D>> seeds_;
  double limit_;
  BondWeights intact_weight_;           ///< of every bond
  std::vector<double> bound_at_start_;  ///< stiffness_bound() after cut_seeds(), by point
  std::vector<double> growth_of_;       ///< by point
  double growth_ = 1.0;
  double released_energy_ = 0.0;
  std::uint64_t followed_ = 0;  ///< version of the bonds that the family has
  StretchBudget<D> budget_;
  std::vector<std::uint8_t> overstretched_;  // workspace: by point, some bond may be
};

}  // namespace perifrac
