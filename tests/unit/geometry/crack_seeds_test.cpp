#include "core/body/crack_seeds.hpp"

#include <cmath>
#include <fstream>

#include <gtest/gtest.h>

#include "tests/unit/config/scene_fixture.hpp"

namespace perifrac {
namespace {

std::vector<CrackFacet<2>> read(const std::string& cracks) {
  KeyTable keys = crack_seed_keys();
  keys.push_back({.path = "dimension", .type = KeyType::integer, .meaning = "Of space."});
  const SceneFile file("dimension: 2\ncracks: " + cracks + "\n");
  const Section scene = read_scene(file.path(), {}, {{"", "", keys}});
  std::vector<CrackFacet<2>> facets;
  for (std::size_t k = 0; k < scene.count("cracks"); ++k) {
    const std::vector<CrackFacet<2>> crack = read_crack(scene, k, 1.0);
    facets.insert(facets.end(), crack.begin(), crack.end());
  }
  return facets;
}

TEST(CrackSeeds, CutsEveryLegIntoPiecesOfAboutASpacing) {
  const auto facets = read("[{name: a, path: [0 m, 0 m, 3.4 m, 0 m, 3.4 m, 0.6 m]}]");
  ASSERT_EQ(facets.size(), 4u);
  for (std::size_t k = 0; k < 3; ++k) {
    EXPECT_NEAR(facets[k][1][0] - facets[k][0][0], 3.4 / 3.0, 1e-14);
    EXPECT_EQ(facets[k][1], facets[k + 1][0]) << "to the bit";
  }
  EXPECT_EQ(facets[2][1], (Vector<2>{3.4, 0.0}));
  EXPECT_EQ(facets[3][1], (Vector<2>{3.4, 0.6}));
}

TEST(CrackSeeds, KeepsTheOrderOfTheScene) {
  const auto facets =
      read("[{name: a, path: [5 m, 0 m, 6 m, 0 m]}, {name: b, path: [1 m, 0 m, 1 m, 1 m]}]");
  ASSERT_EQ(facets.size(), 2u);
  EXPECT_EQ(facets[0][0][0], 5.0);
  EXPECT_EQ(facets[1][0][0], 1.0);
}

TEST(CrackSeeds, ReadsCornersFromAFile) {
  const std::string path = testing::TempDir() + "crack_corners.csv";
  std::ofstream(path) << "x,y\n0, 0\n3.4, 0\n3.4, 0.6\n";
  EXPECT_EQ(read("[{name: a, file: " + path + "}]"),
            read("[{name: a, path: [0 m, 0 m, 3.4 m, 0 m, 3.4 m, 0.6 m]}]"));
  std::ofstream(path) << "x,y\n0, 0\n";
  EXPECT_THROW(read("[{name: a, file: " + path + "}]"), InputError);
}

TEST(CrackSeeds, RefusesWhatIsNoPath) {
  EXPECT_THROW(read("[{name: a}]"), InputError);
  EXPECT_THROW(read("[{name: a, path: [0 m, 0 m, 3 m, 0 m], file: some.csv}]"), InputError);
  EXPECT_THROW(read("[{name: a, path: [0 m, 0 m, 3 m]}]"), InputError);
  EXPECT_THROW(read("[{name: a, path: [0 m, 0 m]}]"), InputError);
  EXPECT_THROW(read("[{name: a, path: [0 m, 0 m, 0.4 m, 0 m]}]"), InputError);
}

}  // namespace
}  // namespace perifrac
