#pragma once

#include <algorithm>
#include <optional>
#include <span>
#include <string>
#include <type_traits>
#include <vector>

#include "core/base/law_by_region.hpp"
#include "core/bonds/lattice_bonds.hpp"
#include "core/bonds/mirror_condition.hpp"
#include "core/bonds/shape_tensor.hpp"

namespace perifrac {

/// The force of LinearExactOperator where bonds lie on a lattice, packet by packet: the same sums
/// in another order. Its own copies lie in the lattice's cells.
template <int D, int R>
class LinearExactLattice {
 public:
  /// Nothing where the family is no lattice, and why. `face_points`: those whose state is asked
  /// for.
  static std::optional<LinearExactLattice> find(const Family<D>& family,
                                                std::span<const Index> face_points,
                                                std::string& why) {
    auto bonds = LatticeBonds<D>::find(family, &why);
    if (!bonds) return {};
    return LinearExactLattice(family, std::move(*bonds), face_points);
  }

  /// Moments, bond stiffness and bonds of these points are new.
  void update(const Family<D>& family, const FamilyMoments<D>& moments,
              std::span<const double> bond_stiffness, std::span<const Index> points) {
    bonds_.update(family, points);
    take(family, moments, bond_stiffness, points);
  }
  void take(const Family<D>& family, const FamilyMoments<D>& moments,
            std::span<const double> bond_stiffness, std::span<const Index> points) {
    for (const Index i : points) {
      const Index c = bonds_.cell_of(i);
      stiffness_[c] = bond_stiffness[i];
      for (int k = 0; k < D * D; ++k) inverse_shape_[k][c] = moments.inverse_shape[k][i];
    }
    for (Index node = family.point_count; node < family.node_count(); ++node) {
      stiffness_[bonds_.cell_of(node)] = bond_stiffness[node];
    }
  }

  const LatticeBonds<D>& bonds() const { return bonds_; }

  /// Force -dE/du on the real points, R blocks, from the field on all nodes, with the stress that
  /// add(points, gradient, stress) makes of the law's; writes `state` on ghosts, their sources and
  /// the face points. `written`: what add writes, blocks of real points.
  template <class Law, class AddStress>
  void apply(const Law& law, AddStress&& add, const MirrorCondition<D, R>& mirror,
             const std::vector<double>& field, std::vector<double>& state, std::span<double> result,
             std::span<double> written) {
    spread(field);
    bonds_.for_each_packet([&](Index c) { store_state(law, add, c); });
    for (std::vector<double>& cells : state_) bonds_.gather_cells(cells);
    bonds_.gather_points(written, points_);
    fill_ghosts(mirror, state);
    bonds_.for_each_packet([&](Index c) { store_force(c, result); });
    bonds_.gather_points(result, points_);
  }

  /// The gradient of the field, R * D blocks of real points.
  void gradient(const std::vector<double>& field, std::span<double> result) {
    spread(field);
    bonds_.for_each_packet([&](Index c) {
      const Packets<R* D> f = gradient_at(c);
      for (int k = 0; k < R * D; ++k) {
        set_value(result.data() + static_cast<std::size_t>(k) * points_, bonds_.points(c), f[k]);
      }
    });
    bonds_.gather_points(result, points_);
  }

 private:
  template <int K>
  using Packets = std::array<Packet, K>;

  LinearExactLattice(const Family<D>& family, LatticeBonds<D> bonds,
                     std::span<const Index> face_points)
      : bonds_(std::move(bonds)),
        points_(family.point_count),
        nodes_(family.node_count()),
        seen_(face_points.begin(), face_points.end()),
        stiffness_(bonds_.cell_count(), 0.0),
        volume_(stiffness_) {
    field_.fill(stiffness_);
    state_.fill(stiffness_);
    inverse_shape_.fill(stiffness_);
    for (Index i = 0; i < points_; ++i) volume_[bonds_.cell_of(i)] = family.volume[i];
    seen_.insert(seen_.end(), family.ghost_source.begin(), family.ghost_source.end());
    std::ranges::sort(seen_);
    const auto twice = std::ranges::unique(seen_);
    seen_.erase(twice.begin(), twice.end());
  }

  void spread(const std::vector<double>& field) {
    for (int r = 0; r < R; ++r) {
      bonds_.spread(field.data() + static_cast<std::size_t>(r) * nodes_, field_[r]);
    }
  }

  Packets<R * D> times_inverse_shape(const Packets<R * D>& t, Index c) const {
    Packets<R * D> result{};
    for (int r = 0; r < R; ++r) {
      for (int b = 0; b < D; ++b) {
        for (int e = 0; e < D; ++e) {
          result[r * D + b] += t[r * D + e] * load(&inverse_shape_[e * D + b][c]);
        }
      }
    }
    return result;
  }

  Packets<R * D> gradient_at(Index c) const {
    Packets<R> own;
    for (int r = 0; r < R; ++r) own[r] = load(&field_[r][c]);
    const Packets<R* D> moment =
        bonds_.template sum_over_bonds<R * D>(c, [&](Index j, const auto& bond) {
          Packets<R * D> t;
          for (int r = 0; r < R; ++r) {
            const Packet difference = load(&field_[r][j]) - own[r];
            for (int b = 0; b < D; ++b) t[r * D + b] = difference * bond.weighted[b];
          }
          return t;
        });
    return times_inverse_shape(moment, c);
  }

  template <class Law, class AddStress>
  void store_state(const Law& law, AddStress&& add, Index c) {
    const PointPacket points = bonds_.points(c);
    const Packets<R* D> f = gradient_at(c);
    Packets<R* D> stress = stress_at(law, points, f);
    add(points, f, stress);
    stress = times_inverse_shape(stress, c);
    const Packet s = load(&stiffness_[c]);
    for (int k = 0; k < R * D; ++k) store(&state_[k][c], stress[k] - s * f[k]);
  }

  void fill_ghosts(const MirrorCondition<D, R>& mirror, std::vector<double>& state) {
    for (int k = 0; k < R * D; ++k) {
      double* const block = state.data() + static_cast<std::size_t>(k) * nodes_;
      for (const Index i : seen_) block[i] = state_[k][bonds_.cell_of(i)];
    }
    mirror.fill_conjugate(state);
    for (int k = 0; k < R * D; ++k) {
      const double* const block = state.data() + static_cast<std::size_t>(k) * nodes_;
      for (Index node = points_; node < nodes_; ++node) {
        state_[k][bonds_.cell_of(node)] = block[node];
      }
    }
  }

  void store_force(Index c, std::span<double> result) const {
    Packets<R> own;
    Packets<R * D> own_state;
    for (int r = 0; r < R; ++r) own[r] = load(&field_[r][c]);
    for (int k = 0; k < R * D; ++k) own_state[k] = load(&state_[k][c]);
    const Packet own_stiffness = load(&stiffness_[c]);
    Packets<R> force = bonds_.template sum_over_bonds<R>(c, [&](Index j, const auto& bond) {
      Packets<R> t;
      const Packet stiffness = bond.weight * (own_stiffness + load(&stiffness_[j]));
      for (int r = 0; r < R; ++r) {
        t[r] = stiffness * (load(&field_[r][j]) - own[r]);
        for (int b = 0; b < D; ++b) {
          Packet state = load(&state_[r * D + b][j]);
          // Where no bond is missing those of opposite directions cancel the own state.
          if constexpr (!std::decay_t<decltype(bond)>::is_whole) state += own_state[r * D + b];
          t[r] += state * bond.weighted[b];
        }
      }
      return t;
    });
    const Packet volume = load(&volume_[c]);
    for (int r = 0; r < R; ++r) {
      set_value(result.data() + static_cast<std::size_t>(r) * points_, bonds_.points(c),
                -volume * force[r]);
    }
  }

  LatticeBonds<D> bonds_;
  Index points_;
  Index nodes_;
  std::vector<Index> seen_;  ///< points whose state others ask for
  std::array<std::vector<double>, R> field_;
  std::array<std::vector<double>, R * D> state_;
  std::array<std::vector<double>, D * D> inverse_shape_;
  std::vector<double> stiffness_;  ///< of bonds
  std::vector<double> volume_;
};

}  // namespace perifrac
