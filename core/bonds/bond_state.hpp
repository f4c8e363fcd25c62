#pragma once

#include <array>
#include <cstdint>
#include <limits>
#include <span>
#include <utility>
#include <vector>

#include "core/base/point_set.hpp"
#include "core/base/points.hpp"
#include "core/bonds/crack_facet.hpp"
#include "core/bonds/family.hpp"
#include "core/state/state_visitor.hpp"

namespace perifrac {

/// A bond between the real points i < j that broke for good.
struct BrokenBond {
  Index i;
  Index j;
  Index facet;  ///< that cuts it; no_facet where it broke on its own
};
inline constexpr Index no_facet = -1;

/// The bonds of a body that are broken and the cracks that cut them. Both only grow, at their end,
/// so that who follows them reads what is new; a restored state has another version altogether.
/// The body's solid writes it, everybody else reads it (Body::bond_state).
template <int D>
class BondState {
 public:
  BondState() = default;
  /// Nothing broken, at a version of its own.
  explicit BondState(std::uint64_t version) : version_(version) {}

  /// The facets with their centres as points; its version changes with their number.
  const PointSet& facet_points() const { return facet_points_; }
  std::span<const CrackFacet<D>> facets() const { return facets_; }
  std::span<const BrokenBond> broken() const { return broken_; }
  /// Changes with every break and every restored state.
  std::uint64_t version() const { return version_; }

  /// Adds a facet that cuts these bonds, pairs i < j, all intact until now.
  void add_facet(const CrackFacet<D>& facet, std::span<const std::pair<Index, Index>> bonds);
  /// Breaks bonds, pairs i < j, all intact until now, without a facet.
  void break_bonds(std::span<const std::pair<Index, Index>> bonds);

  void visit_state(StateVisitor& visitor);

 private:
  void place_facets();

  std::vector<CrackFacet<D>> facets_;
  std::vector<BrokenBond> broken_;
  std::uint64_t version_ = 0;
  std::array<std::vector<double>, D> centre_;
  PointSet facet_points_{.name = "crack", .dimension = D, .count = 0};
};

/// Sets the weight of a bond to 0 from both of its ends, and with it the bonds to the ends' ghosts:
/// a bond to a ghost breaks with that to its source.
template <int D>
void silence(Family<D>& family, Index i, Index j);

/// Sorts points and drops repeats: the ends of many bonds, as operators want to hear of them.
void keep_each_once(std::vector<Index>& points);

/// The ends of bonds, each once, ascending.
std::vector<Index> ends_of(std::span<const std::pair<Index, Index>> bonds);

/// The part of every point's family, by volume, that is beyond silenced bonds (paper Eq 16).
template <int D>
void find_damage(const Family<D>& family, std::span<double> damage);

}  // namespace perifrac
