#pragma once

#include <span>
#include <utility>
#include <vector>

#include <Eigen/SparseCore>

#include "core/base/block_sum.hpp"

namespace perifrac {

/// What moves every unknown of a body in motion: a mass, a rigid plate without one, or nothing that
/// is free. A plate on a layer moves all of the layer's mass.
class LumpedMass {
 public:
  static constexpr Index none = -1;         ///< it is prescribed
  static constexpr Index plate_alone = -2;  ///< a plate without mass

  /// `free` takes what is solved for to all unknowns, `moved` of which have a mass; mass_of(k) is
  /// that of unknown k [kg].
  template <class MassOf>
  LumpedMass(const Eigen::SparseMatrix<double>& free, Index moved, MassOf&& mass_of)
      : owner_(free.rows(), none) {
    for (Index column = 0; column < free.cols(); ++column) {
      Eigen::SparseMatrix<double>::InnerIterator unknown(free, column);
      if (unknown.row() >= moved) {
        owner_[unknown.row()] = plate_alone;
        continue;
      }
      const Index y = static_cast<Index>(mass_.size());
      first_moved_.push_back(static_cast<Index>(unknown.row()));
      mass_.push_back(0.0);
      for (; unknown; ++unknown) {
        const auto k = static_cast<Index>(unknown.row());
        owner_[k] = y;
        mass_[y] += mass_of(k);
        if (k != first_moved_[y]) also_moved_.emplace_back(y, k);
      }
    }
  }

  std::span<const double> mass() const { return mass_; }  ///< [kg]
  Index unknowns() const { return static_cast<Index>(owner_.size()); }
  /// What moves unknown k, by its place in mass(); none, or plate_alone.
  Index owner(Index k) const { return owner_[k]; }
  Index first_moved(std::size_t y) const { return first_moved_[y]; }

  /// Every unknown from what has a mass and what is prescribed (empty: 0); plates at 0.
  void expand(std::span<const double> y, std::span<const double> prescribed,
              std::vector<double>& unknowns) const {
    for_each_entry(this->unknowns(), [&](Index k) {
      unknowns[k] = owner_[k] >= 0 ? y[owner_[k]] : 0.0;
      if (!prescribed.empty()) unknowns[k] += prescribed[k];
    });
  }

  /// Force on what has a mass from that on an unknown.
  template <class ForceOn>
  void gather(ForceOn&& force_on, std::span<double> y) const {
    for_each_entry(static_cast<Index>(first_moved_.size()),
                   [&](Index i) { y[i] = force_on(first_moved_[i]); });
    for (const auto& [i, unknown] : also_moved_) y[i] += force_on(unknown);
  }

  /// Displacements of what has a mass.
  std::vector<double> positions(std::span<const double> unknowns) const {
    std::vector<double> y(first_moved_.size());
    for (std::size_t i = 0; i < y.size(); ++i) y[i] = unknowns[first_moved_[i]];
    return y;
  }

 private:
  std::vector<double> mass_;
  std::vector<Index> owner_;        ///< by unknown
  std::vector<Index> first_moved_;  ///< by what has a mass
  /// What a plate on a layer moves beyond the first: what has the mass, unknown.
  std::vector<std::pair<Index, Index>> also_moved_;
};

}  // namespace perifrac
