#pragma once

#include <cstdint>
#include <memory>
#include <span>
#include <vector>

#include "core/bonds/bond_state.hpp"
#include "core/bonds/family.hpp"

namespace perifrac {

/// The body's bonds as the flow sees them: a family of its own once the first one is broken.
template <int D>
class CutBonds {
 public:
  /// Takes the bonds that broke in the body, or mended as a state was restored, out of a copy of
  /// the family; false, and nothing done, where it has them already.
  bool follow(const BondState<D>& bonds, const Family<D>& intact);

  std::uint64_t version() const { return version_; }  ///< of the bonds that it has
  const std::shared_ptr<Family<D>>& family() const { return family_; }
  /// Whose bonds ever broke, ascending.
  std::span<const Index> points() const { return points_; }

 private:
  std::uint64_t version_ = 0;
  std::shared_ptr<Family<D>> family_;
  BondWeights intact_weight_;
  std::vector<Index> points_;
};

}  // namespace perifrac
