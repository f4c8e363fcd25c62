#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>
#include <utility>
#include <vector>

#include "core/base/shared_rows.hpp"

namespace perifrac {

/// omega(|xi|) V_other of every bond, by point; 0: it is broken. On a lattice few are different:
/// then a byte a bond says which it is, and points whose bonds have the same weights share them.
class BondWeights {
 public:
  /// What says which, for loops: weight[k] of a point's k-th bond.
  struct Packed {
    const std::uint8_t* code;
    const double* table;
    double operator[](Index k) const { return table[code[k]]; }
  };

  BondWeights() = default;
  explicit BondWeights(SharedRows<double> all) : all_(std::move(all)) {}

  Index point_count() const { return is_packed_ ? code_.count() : all_.count(); }
  Index bond_count(Index i) const { return is_packed_ ? code_.size(i) : all_.size(i); }
  double operator()(Index i, Index k) const {
    return is_packed_ ? table_[code_[i][k]] : all_[i][k];
  }
  /// From several threads only where they are not packed.
  void set(Index i, Index k, double weight);

  /// Calls use(weight), weight[k] being that of the k-th bond of point i, for loops that shall not
  /// ask at every bond.
  template <class Use>
  auto with(Index i, Use&& use) const {
    if (is_packed_) return use(Packed{code_[i].data(), table_.data()});
    return use(all_[i].data());
  }

  /// Takes a byte a bond where that will do: weights that differ by rounding alone become equal.
  void pack();
  /// No two points share their weights afterwards.
  void unpack();
  bool is_packed() const { return is_packed_; }
  std::size_t bytes() const {
    return all_.bytes() + code_.bytes() + sizeof(double) * table_.size();
  }

  /// Of equal weights, however they are kept.
  bool operator==(const BondWeights& other) const;

 private:
  friend class BondWeightList;

  bool is_packed_ = false;
  SharedRows<double> all_;         ///< empty where they are packed
  SharedRows<std::uint8_t> code_;  ///< places in the table
  std::vector<double> table_;      ///< the first is 0
};

/// Weights as they are found, one point after the other: packed from the first on, as long as that
/// will do, so that those of a lattice never take a number each.
class BondWeightList {
 public:
  BondWeightList();

  /// Those of the next point's bonds.
  void add(std::span<const double> weights);
  bool is_packed() const { return weights_.is_packed(); }
  BondWeights take();

 private:
  /// The place of a number in the table, up to rounding, or none where it is full.
  std::optional<std::uint8_t> place_of(double weight);
  /// False where the table does not hold them.
  bool find_codes(std::span<const double> weights);

  BondWeights weights_;
  SharedRowList<std::uint8_t> codes_;
  std::vector<std::uint8_t> row_;           ///< workspace
  std::array<std::uint8_t, 4096> guess_{};  ///< by leading digits
};

}  // namespace perifrac
