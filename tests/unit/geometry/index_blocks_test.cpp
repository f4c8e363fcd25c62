#include "core/geometry/index_blocks.hpp"

#include <numeric>

#include <gtest/gtest.h>

namespace perifrac {
namespace {

TEST(IndexBlocks, KeepWhatIsTakenInOrder) {
  IndexBlocks blocks;
  for (const std::size_t rows : {40, 3, 60}) {  // shorter and longer than before
    blocks.clear();
    std::vector<Index> expected;
    for (std::size_t row = 0; row < rows; ++row) {
      const std::size_t most = row % 5 == 0 ? 100000 : 9000, count = most / (1 + row % 3);
      Index* const room = blocks.room(most);
      for (std::size_t k = 0; k < most; ++k) room[k] = static_cast<Index>(1000 * row + k % 1000);
      blocks.take(count);
      expected.insert(expected.end(), room, room + count);
    }
    std::vector<Index> found(expected.size());
    blocks.copy_to(found.data());
    EXPECT_EQ(found, expected);
  }
}

}  // namespace
}  // namespace perifrac
