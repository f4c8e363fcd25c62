#pragma once

#include <cstdint>
#include <optional>
#include <span>
#include <vector>

#include "core/base/packet.hpp"
#include "core/bonds/bond_traversal.hpp"
#include "core/bonds/family.hpp"

namespace perifrac {

/// The bonds of a family whose nodes lie on a lattice, all with the same neighbours at the same
/// weights but for bonds that are missing: values lie in the lattice's cells, row by row, so that a
/// packet of points finds each of its neighbours in one piece of memory. Which bonds there are is a
/// bit each.
template <int D>
class LatticeBonds {
 public:
  /// Nothing where the family is no such lattice. Points may differ in volume, nodes that are
  /// bonded to may not.
  static std::optional<LatticeBonds> find(const Family<D>& family);

  /// Weights of these points' bonds became 0 in the family.
  void update(const Family<D>& family, std::span<const Index> points);

  Index cell_count() const { return cell_count_; }
  /// Of a node of the family.
  Index cell_of(Index node) const { return cell_of_[node]; }

  /// Calls use(c) for every packet of cells c, c + 1, ... that may hold points, in parallel;
  /// point(c) says which.
  template <class Use>
  void for_each_packet(Use&& use) const {
    const Index packets = (last_ - first_) / packet_size + 1;
#pragma omp parallel for schedule(static) if (packets * packet_size >= points_worth_threads)
    for (Index k = 0; k < packets; ++k) use(first_ + k * packet_size);
  }
  /// The real point in a cell; -1: there is none.
  Index point(Index cell) const { return point_[cell]; }

  /// The sum over the bonds of the points in a packet of cells of term(j, weight, weight xi), j
  /// being the first of the cells at their other ends. Missing bonds have weight 0; where none is
  /// missing the weights are plain numbers.
  template <int K, class Term>
  std::array<Packet, K> sum_over_bonds(Index cell, Term&& term) const {
    PacketMask present;
    std::memcpy(&present, &present_[cell], sizeof present);
    const auto all = static_cast<std::int64_t>((std::uint64_t{1} << neighbours_.size()) - 1);
    std::array<Packet, K> sum{};
    if (is_everywhere(present == all)) {
      for (const Neighbour& n : neighbours_) {
        add(sum, term(cell + n.offset, n.weight, n.weighted));
      }
      return sum;
    }
    for (std::size_t k = 0; k < neighbours_.size(); ++k) {
      const Neighbour& n = neighbours_[k];
      const PacketMask has = (present & (std::int64_t{1} << k)) != 0;
      PacketVector<D> weighted;
      for (int a = 0; a < D; ++a) weighted[a] = has ? Packet{} + n.weighted[a] : Packet{};
      add(sum, term(cell + n.offset, has ? Packet{} + n.weight : Packet{}, weighted));
    }
    return sum;
  }

 private:
  struct Neighbour {
    Index offset;  ///< of cells
    double weight;
    Vector<D> weighted;  ///< bond vector times weight
  };

  template <std::size_t K>
  static void add(std::array<Packet, K>& sum, const std::array<Packet, K>& term) {
    for (std::size_t i = 0; i < K; ++i) sum[i] += term[i];
  }

  template <class Grid>
  bool take_cells(const Family<D>& family, const Grid& grid, std::int64_t cells,
                  std::int64_t before);
  bool take_bond(const Family<D>& family, Index i, Index bond, const Vector<D>& xi, double spacing);

  std::vector<Neighbour> neighbours_;  ///< at most 63
  std::vector<std::int64_t> present_;  ///< by cell: bit k, there is a bond to neighbour k
  std::vector<Index> point_;           ///< by cell
  std::vector<Index> cell_of_;         ///< by node
  Index cell_count_ = 0, first_ = 0, last_ = 0;
};

}  // namespace perifrac
