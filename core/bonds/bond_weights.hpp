#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>
#include <utility>
#include <vector>

namespace perifrac {

/// omega(|xi|) V_other of every bond; 0: it is broken. On a lattice few are different: then a byte
/// a bond says which it is.
class BondWeights {
 public:
  /// What says which, for loops: weight[bond].
  struct Packed {
    const std::uint8_t* code;
    const double* table;
    double operator[](std::size_t bond) const { return table[code[bond]]; }
  };

  BondWeights() = default;
  explicit BondWeights(std::vector<double> all) : all_(std::move(all)) {}

  std::size_t size() const { return is_packed() ? code_.size() : all_.size(); }
  double operator[](std::size_t bond) const {
    return is_packed() ? table_[code_[bond]] : all_[bond];
  }
  /// From several threads only where they are not packed.
  void set(std::size_t bond, double weight);

  /// Calls use(weight), weight[bond] as above, for loops that shall not ask at every bond.
  template <class Use>
  auto with(Use&& use) const {
    if (is_packed()) return use(Packed{code_.data(), table_.data()});
    return use(all_.data());
  }

  /// Takes a byte a bond where that will do: weights that differ by rounding alone become equal.
  void pack();
  void unpack();
  bool is_packed() const { return !code_.empty(); }
  std::size_t bytes() const {
    return sizeof(double) * (all_.size() + table_.size()) + code_.size();
  }

  /// Of equal weights, however they are kept.
  bool operator==(const BondWeights& other) const;

 private:
  friend class BondWeightList;

  std::vector<double> all_;         ///< empty where they are packed
  std::vector<std::uint8_t> code_;  ///< place in the table; 0 of broken bonds
  std::vector<double> table_;
};

/// Weights as they are found, one bond after the other: packed from the first on, as long as that
/// will do, so that those of a lattice never take a number each.
class BondWeightList {
 public:
  explicit BondWeightList(std::size_t bonds);  ///< that are expected

  void add(std::span<const double> weights);
  bool is_packed() const { return weights_.is_packed(); }
  BondWeights take() { return std::move(weights_); }

 private:
  /// The place of a number in the table, up to rounding, or none where it is full.
  std::optional<std::uint8_t> place_of(double weight);

  std::size_t bonds_;
  BondWeights weights_;
  std::array<std::uint8_t, 4096> guess_{};  ///< by leading digits
};

}  // namespace perifrac
