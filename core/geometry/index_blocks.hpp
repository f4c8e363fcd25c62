#pragma once

#include <algorithm>
#include <cstddef>
#include <memory>
#include <vector>

#include "core/base/points.hpp"

namespace perifrac {

/// A list of indices that grows in blocks: what it holds is never copied to make room, so that a
/// long one takes no more memory on its way than in the end. Blocks are kept for the next list.
class IndexBlocks {
 public:
  void clear() {
    for (Block& block : blocks_) block.used = 0;
    last_ = 0;
  }

  /// Room for `most` more in a row, behind what has been taken.
  Index* room(std::size_t most) {
    while (last_ < blocks_.size() && blocks_[last_].size - blocks_[last_].used < most) ++last_;
    if (last_ == blocks_.size()) {
      const std::size_t size = std::max(most, indices_in_block);
      blocks_.push_back({std::make_unique_for_overwrite<Index[]>(size), size});
    }
    return blocks_[last_].index.get() + blocks_[last_].used;
  }

  /// Keeps the first `count` of that room.
  void take(std::size_t count) { blocks_[last_].used += count; }

  void copy_to(Index* place) const {
    for (const Block& block : blocks_) place = std::copy_n(block.index.get(), block.used, place);
  }

 private:
  static constexpr std::size_t indices_in_block = 1 << 16;

  struct Block {
    std::unique_ptr<Index[]> index;
    std::size_t size;
    std::size_t used = 0;
  };

  std::vector<Block> blocks_;
  std::size_t last_ = 0;  ///< that has room
};

}  // namespace perifrac
