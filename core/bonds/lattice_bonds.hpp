#pragma once

#include <cstdint>
#include <optional>
#include <span>
#include <string>
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
  /// The bonds to one of the neighbours. With every direction there is its opposite.
  struct Neighbour {
    static constexpr bool is_whole = true;  ///< no bond of the packet's points is missing
    Index offset;                           ///< of cells
    double weight;
    Vector<D> weighted;  ///< bond vector times weight
    Vector<D> inverse;   ///< bond vector over its square
  };

  /// The same where bonds of the packet's points are missing, which have weight 0.
  struct MaskedNeighbour {
    static constexpr bool is_whole = false;
    Packet weight;
    PacketVector<D> weighted;
    const Vector<D>& inverse;
  };

  /// Nothing where the family is no such lattice, and why. Points may differ in volume, nodes that
  /// are bonded to may not.
  static std::optional<LatticeBonds> find(const Family<D>& family, std::string* why = nullptr);

  /// Weights of these points' bonds became 0 in the family.
  void update(const Family<D>& family, std::span<const Index> points);

  Index cell_count() const { return cell_count_; }
  Index neighbour_count() const { return static_cast<Index>(neighbours_.size()); }
  /// How sums over these bonds are made.
  std::string path() const;
  /// Of a node of the family.
  Index cell_of(Index node) const { return cell_of_[node]; }

  /// Calls use(c) for every packet of cells c, c + 1, ... that holds points, in parallel and
  /// divided among processes; points(c) says which. What it writes must be gathered before it is
  /// read.
  template <class Use>
  void for_each_packet(Use&& use) const {
    const Index packets = own_.end - own_.begin;
#pragma omp parallel for schedule(static) if (packets * packet_size >= points_worth_threads)
    for (Index k = own_.begin; k < own_.end; ++k) use(packets_[k]);
  }
  /// Every process gets the cells that for_each_packet() of others wrote.
  void gather_cells(std::vector<double>& cells) const {
    if (!first_cells_.empty()) ranks::gather(cells, first_cells_);
  }
  /// The same of blocks of point_count values, as set_value() writes them.
  void gather_points(std::span<double> values, Index point_count);
  /// The real points in a packet of cells.
  PointPacket points(Index cell) const { return {&point_[cell]}; }

  /// Writes one value a node into the cells.
  void spread(const double* nodes, std::vector<double>& cells) const {
    const auto count = static_cast<Index>(cell_of_.size());
    for_each_point(count, [&](Index node) { cells[cell_of_[node]] = nodes[node]; });
  }

  /// The sum over the bonds of the points in a packet of cells of term(j, neighbour), j being the
  /// first of the cells at their other ends, neighbour a Neighbour or a MaskedNeighbour.
  template <int K, class Term>
  std::array<Packet, K> sum_over_bonds(Index cell, Term&& term) const {
    std::array<Packet, K> sum{};
    if (has_all(cell)) {
      for (const Neighbour& n : neighbours_) add(sum, term(cell + n.offset, n));
      return sum;
    }
    const Neighbour* n = neighbours_.data();
    for (std::size_t left = neighbours_.size(), word = 0; left > 0; ++word) {
      PacketMask present = load_mask(word, cell);
      const std::size_t bits = left < word_bits ? left : word_bits;
      left -= bits;
      for (const Neighbour* const end = n + bits; n != end; ++n, present <<= 1) {
        const PacketMask has = present < 0;
        PacketVector<D> weighted;
        for (int a = 0; a < D; ++a) weighted[a] = has ? Packet{} + n->weighted[a] : Packet{};
        const Packet weight = has ? Packet{} + n->weight : Packet{};
        add(sum, term(cell + n->offset, MaskedNeighbour{weight, weighted, n->inverse}));
      }
    }
    return sum;
  }

 private:
  static constexpr std::size_t word_bits = 64;

  template <std::size_t K>
  static void add(std::array<Packet, K>& sum, const std::array<Packet, K>& term) {
    for (std::size_t i = 0; i < K; ++i) sum[i] += term[i];
  }

  PacketMask load_mask(std::size_t word, Index cell) const {
    PacketMask mask;
    std::memcpy(&mask, &present_[word * cell_count_ + cell], sizeof mask);
    return mask;
  }
  bool has_all(Index cell) const {
    PacketMask missing{};
    for (std::size_t word = 0; word < all_.size(); ++word) {
      missing |= load_mask(word, cell) ^ all_[word];
    }
    return is_everywhere(missing == 0);
  }
  /// Bit `neighbour` of its word, the highest first.
  static std::int64_t bit(std::size_t neighbour) {
    return static_cast<std::int64_t>(std::uint64_t{1} << (word_bits - 1 - neighbour % word_bits));
  }
  std::int64_t& word_of(std::size_t neighbour, Index cell) {
    return present_[neighbour / word_bits * cell_count_ + cell];
  }

  template <class Grid>
  bool take_cells(const Family<D>& family, const Grid& grid, std::int64_t cells,
                  std::int64_t before);
  template <class Grid>
  bool take_neighbours(const Family<D>& family, const Grid& grid, double spacing);
  void find_packets();

  std::vector<Neighbour> neighbours_;  ///< row by row
  std::vector<Index> number_;          ///< of the neighbour a step away, row by row; -1: none
  Index reach_ = 0;                    ///< of steps, along any axis
  double spacing_ = 0.0;
  std::vector<std::int64_t> present_;  ///< by word and cell: there is a bond to a neighbour, a bit
  std::vector<std::int64_t> all_;      ///< by word: where no bond is missing
  std::vector<Index> point_;           ///< by cell
  std::vector<Index> cell_of_;         ///< by node
  std::vector<Index> packets_;         ///< first cells
  ranks::Share own_{};                 ///< of the packets
  std::vector<Index> first_cells_;     ///< of the share of each process, and one past the last
  std::vector<double> gathered_;       ///< workspace: cells
  Index cell_count_ = 0;
};

}  // namespace perifrac
