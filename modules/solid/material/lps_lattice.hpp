#pragma once

#include <algorithm>
#include <optional>
#include <span>
#include <string>
#include <type_traits>
#include <utility>
#include <vector>

#include "core/base/small_vector.hpp"
#include "core/bonds/lattice_bonds.hpp"

namespace perifrac {

/// The loops of LpsElasticity where bonds lie on a lattice, packet by packet: the same sums in
/// another order. Its own copies lie in the lattice's cells. Of ghosts it knows the displacement
/// alone.
template <int D>
class LpsLattice {
 public:
  /// What every point has.
  struct Rock {
    std::span<const double> dilatation_scale;
    std::span<const double> bond_stiffness;
    std::span<const double> dilatation_stiffness;
    std::span<const double> initial_state;  ///< D * D blocks of nodes, or empty
  };

  /// Nothing where the family is no lattice, and why.
  static std::optional<LpsLattice> find(const Family<D>& family, std::string& why) {
    auto bonds = LatticeBonds<D>::find(family, &why);
    if (!bonds) return {};
    return LpsLattice(family, std::move(*bonds));
  }

  const LatticeBonds<D>& bonds() const { return bonds_; }

  void take(const Rock& rock, std::span<const Index> points) {
    for (const Index i : points) {
      const Index c = bonds_.cell_of(i);
      scale_[c] = rock.dilatation_scale[i];
      stiffness_[c] = rock.bond_stiffness[i];
      volume_stiffness_[c] = rock.dilatation_stiffness[i];
    }
    if (rock.initial_state.empty()) return;
    initial_.resize(D * D, std::vector<double>(bonds_.cell_count(), 0.0));
    for (int k = 0; k < D * D; ++k) {
      bonds_.spread(&rock.initial_state[static_cast<std::size_t>(k) * nodes_], initial_[k]);
    }
  }
  /// Bonds of these points broke.
  void update(const Family<D>& family, const Rock& rock, std::span<const Index> points) {
    bonds_.update(family, points);
    take(rock, points);
  }

  /// Forces of the points' bonds, without the ghosts' halves, from the displacement of all nodes;
  /// writes the points' volume states, and their dilatations where those are asked for.
  /// `pull_of_pores(points, dilatation)`: what the pore stress takes from dW/dtheta.
  template <class PullOfPores>
  void apply(std::span<const double> field, PullOfPores&& pull_of_pores,
             std::span<double> dilatation, std::span<double> volume_state,
             std::span<double> force) {
    take_displacement(field);
    bonds_.for_each_packet([&](Index c) {
      const PointPacket points = bonds_.points(c);
      const Packet theta = dilatation_at(c);
      if (!dilatation.empty()) set_value(dilatation.data(), points, theta);
      const Packet state =
          load(&scale_[c]) * (load(&volume_stiffness_[c]) * theta - pull_of_pores(points, theta));
      store(&state_[c], state);
      set_value(volume_state.data(), points, state);
    });
    bonds_.gather_cells(state_);
    bonds_.gather_points(volume_state.first(points_), points_);
    bonds_.gather_points(dilatation, points_);
    bonds_.for_each_packet([&](Index c) {
      const PacketVector<D> f = initial_.empty() ? force_at<false>(c) : force_at<true>(c);
      const Packet volume = load(&volume_[c]);
      for (int r = 0; r < D; ++r) {
        set_value(force.data() + static_cast<std::size_t>(r) * points_, bonds_.points(c),
                  -volume * f[r]);
      }
    });
    bonds_.gather_points(force, points_);
  }

  /// sum_j T(xi) (x) xi of the points' own force states T, initial stress apart: D * D blocks.
  void find_stress(std::span<const double> field, std::span<double> stress) {
    take_displacement(field);
    bonds_.for_each_packet([&](Index c) {
      const auto s = stress_at(c);
      for (int k = 0; k < D * D; ++k) {
        set_value(stress.data() + static_cast<std::size_t>(k) * points_, bonds_.points(c), s[k]);
      }
    });
    bonds_.gather_points(stress, points_);
  }

 private:
  LpsLattice(const Family<D>& family, LatticeBonds<D> bonds)
      : bonds_(std::move(bonds)),
        points_(family.point_count),
        nodes_(family.node_count()),
        scale_(bonds_.cell_count(), 0.0),
        stiffness_(scale_),
        volume_stiffness_(scale_),
        volume_(scale_),
        state_(scale_) {
    displacement_.fill(scale_);
    for (Index i = 0; i < points_; ++i) volume_[bonds_.cell_of(i)] = family.volume[i];
  }

  /// Of all nodes.
  void take_displacement(std::span<const double> field) {
    for (int r = 0; r < D; ++r) {
      bonds_.spread(&field[static_cast<std::size_t>(r) * nodes_], displacement_[r]);
    }
  }

  PacketVector<D> displacement(Index c) const {
    PacketVector<D> u;
    for (int r = 0; r < D; ++r) u[r] = load(&displacement_[r][c]);
    return u;
  }

  Packet dilatation_at(Index c) const {
    const PacketVector<D> own = displacement(c);
    const auto sum = bonds_.template sum_over_bonds<1>(c, [&](Index j, const auto& bond) {
      Packet along{};
      for (int r = 0; r < D; ++r) {
        along += (load(&displacement_[r][j]) - own[r]) * bond.weighted[r];
      }
      return std::array{along};
    });
    return load(&scale_[c]) * sum[0];
  }

  std::array<Packet, D * D> stress_at(Index c) const {
    const PacketVector<D> own = displacement(c);
    const Packet state = load(&scale_[c]) * load(&volume_stiffness_[c]) * dilatation_at(c);
    const Packet stiffness = load(&stiffness_[c]);
    return bonds_.template sum_over_bonds<D * D>(c, [&](Index j, const auto& bond) {
      const double square = 1.0 / squared_norm(bond.inverse);
      Packet along{};
      for (int r = 0; r < D; ++r) {
        along += (load(&displacement_[r][j]) - own[r]) * bond.inverse[r];
      }
      const Packet pull = state + stiffness * along;
      std::array<Packet, D * D> t;
      for (int k = 0; k < D * D; ++k) {
        t[k] = pull * bond.weighted[k / D] * (square * bond.inverse[k % D]);
      }
      return t;
    });
  }

  template <bool initially_stressed>
  PacketVector<D> force_at(Index c) const {
    const PacketVector<D> own = displacement(c);
    const Packet own_state = load(&state_[c]), own_stiffness = load(&stiffness_[c]);
    return bonds_.template sum_over_bonds<D>(c, [&](Index j, const auto& bond) {
      // Where no bond is missing those of opposite directions cancel the own states.
      constexpr bool is_whole = std::decay_t<decltype(bond)>::is_whole;
      Packet along{};
      for (int r = 0; r < D; ++r) {
        along += (load(&displacement_[r][j]) - own[r]) * bond.inverse[r];
      }
      Packet pull = load(&state_[j]) + (own_stiffness + load(&stiffness_[j])) * along;
      if constexpr (!is_whole) pull += own_state;
      PacketVector<D> t;
      for (int r = 0; r < D; ++r) {
        t[r] = pull * bond.weighted[r];
        if constexpr (initially_stressed) {
          for (int b = 0; b < D; ++b) {
            Packet stress = load(&initial_[r * D + b][j]);
            if constexpr (!is_whole) stress += load(&initial_[r * D + b][c]);
            t[r] += stress * bond.weighted[b];
          }
        }
      }
      return t;
    });
  }

  LatticeBonds<D> bonds_;
  Index points_;
  Index nodes_;
  std::vector<double> scale_;             ///< of dilatation
  std::vector<double> stiffness_;         ///< of bonds
  std::vector<double> volume_stiffness_;  ///< against dilatation
  std::vector<double> volume_;
  std::vector<double> state_;  ///< of volume
  std::array<std::vector<double>, D> displacement_;
  std::vector<std::vector<double>> initial_;  ///< D * D states of initial stress, or none
};

}  // namespace perifrac
