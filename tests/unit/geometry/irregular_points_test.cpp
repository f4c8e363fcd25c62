#include <cmath>
#include <filesystem>
#include <fstream>
#include <numeric>
#include <unistd.h>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "core/base/errors.hpp"
#include "core/geometry/cloud_file.hpp"
#include "core/geometry/jitter.hpp"
#include "core/geometry/lattice.hpp"
#include "core/geometry/voronoi.hpp"

namespace perifrac {
namespace {

TEST(Jitter, MovesPointsByNoMoreThanAskedAndDiffersWithTheSeed) {
  const Points<3> lattice = box_lattice<3>({6, 5, 4}, 0.5);
  Points<3> one = lattice, again = lattice, other = lattice;
  jitter_points(one, 0.1, 1);
  jitter_points(again, 0.1, 1);
  jitter_points(other, 0.1, 2);
  double mean = 0.0, square = 0.0;
  for (int a = 0; a < 3; ++a) {
    EXPECT_EQ(one.position[a], again.position[a]);
    EXPECT_NE(one.position[a], other.position[a]);
    for (Index i = 0; i < lattice.size(); ++i) {
      const double shift = one.position[a][i] - lattice.position[a][i];
      EXPECT_LE(std::abs(shift), 0.1);
      mean += shift / (3 * lattice.size());
      square += shift * shift / (3 * lattice.size());
    }
  }
  EXPECT_NEAR(mean, 0.0, 4.0 * 0.1 / std::sqrt(3.0 * 360.0));  // four standard errors
  EXPECT_NEAR(square, 0.01 / 3.0, 0.0008);
}

/// The numbers themselves: they may differ on no machine.
TEST(Jitter, GivesTheSameNumbersEverywhere) {
  Points<2> points;
  points.add({0.0, 0.0}, 1.0);
  jitter_points(points, 1.0, 1);
  EXPECT_DOUBLE_EQ(points.position[0][0], -0.26362096869666096);
  EXPECT_DOUBLE_EQ(points.position[1][0], 0.8871284617297088);
}

TEST(Jitter, KeepsPointsInTheBall) {
  Points<2> points = ball_lattice<2>(4.0, 0.5);
  jitter_points_in_ball(points, 0.25, 1, 4.0);
  for (Index i = 0; i < points.size(); ++i) {
    EXPECT_LT(std::hypot(points.position[0][i], points.position[1][i]), 4.0);
  }
}

template <int D>
void expect_cells_to_fill_the_box(const std::array<int, D>& counts, double spacing) {
  Points<D> points = box_lattice<D>(counts, spacing);
  Vector<D> low{}, high;
  double box = 1.0;
  for (int a = 0; a < D; ++a) box *= high[a] = counts[a] * spacing;
  set_voronoi_volumes<D>(points, low, high, spacing);
  for (const double v : points.volume) EXPECT_NEAR(v, std::pow(spacing, D), 1e-12 * v);
  for (const double distance : {0.2, 0.5}) {
    jitter_points<D>(points, distance * spacing, 9);
    set_voronoi_volumes<D>(points, low, high, spacing);
    const double sum = std::accumulate(points.volume.begin(), points.volume.end(), 0.0);
    EXPECT_NEAR(sum, box, 1e-12 * box);
    EXPECT_GT(*std::ranges::min_element(points.volume), 0.0);
    points = box_lattice<D>(counts, spacing);
  }
}

TEST(Voronoi, CellsFillTheBox) {
  expect_cells_to_fill_the_box<2>({30, 17}, 1e-3);
  expect_cells_to_fill_the_box<2>({8, 9}, 2e3);
  expect_cells_to_fill_the_box<3>({8, 7, 9}, 0.3);
}

TEST(Voronoi, CellsAreThePartsNearestToTheirPoints) {
  Points<2> points = box_lattice<2>({5, 4}, 1.0);
  jitter_points(points, 0.4, 2);
  set_voronoi_volumes<2>(points, {0.0, 0.0}, {5.0, 4.0}, 1.0);
  std::vector<double> counted(points.volume.size(), 0.0);
  const int n = 400;  // sample places a unit of length
  for (int x = 0; x < 5 * n; ++x) {
    for (int y = 0; y < 4 * n; ++y) {
      Index nearest = 0;
      double least = INFINITY;
      for (Index i = 0; i < points.size(); ++i) {
        const double dx = (x + 0.5) / n - points.position[0][i];
        const double dy = (y + 0.5) / n - points.position[1][i];
        if (dx * dx + dy * dy < least) {
          least = dx * dx + dy * dy;
          nearest = i;
        }
      }
      counted[nearest] += 1.0 / (n * n);
    }
  }
  for (Index i = 0; i < points.size(); ++i) EXPECT_NEAR(points.volume[i], counted[i], 2e-3);
}

class CloudFileTest : public testing::Test {
 protected:
  template <int D>
  CloudFile<D> read(const std::string& text, const std::string& ending = ".csv") {
    path_ = testing::TempDir() + "cloud_" + std::to_string(getpid()) + ending;
    std::ofstream(path_) << text;
    return read_cloud<D>(path_);
  }
  std::string refusal(const std::string& text, const std::string& ending = ".csv") {
    try {
      read<2>(text, ending);
    } catch (const InputError& error) {
      return std::string(error.what()).substr(path_.size());
    }
    return "accepted";
  }
  void TearDown() override { std::filesystem::remove(path_); }
  std::string path_;
};

TEST_F(CloudFileTest, ReadsColumns) {
  const auto plane = read<2>("x, y, volume\n1, 2e-1, 3\r\n\n-4,5,6\n");
  EXPECT_TRUE(plane.has_volumes);
  EXPECT_EQ(plane.points.at(0), (Vector<2>{1.0, 0.2}));
  EXPECT_EQ(plane.points.at(1), (Vector<2>{-4.0, 5.0}));
  EXPECT_EQ(plane.points.volume, (std::vector<double>{3.0, 6.0}));
  EXPECT_EQ(plane.line, (std::vector<int>{2, 4}));
  EXPECT_FALSE(read<3>("x,y,z\n1,2,3\n").has_volumes);
}

TEST_F(CloudFileTest, ReadsLegacyVtk) {
  const auto cloud = read<2>(
      "# vtk DataFile Version 3.0\ntitle\nASCII\nDATASET POLYDATA\nPOINTS 3 float\n"
      "1 2 0 3 4 0\n5 6\n0\nVERTICES 0 0\n",
      ".vtk");
  EXPECT_EQ(cloud.points.position[0], (std::vector<double>{1.0, 3.0, 5.0}));
  EXPECT_EQ(cloud.points.position[1], (std::vector<double>{2.0, 4.0, 6.0}));
  EXPECT_EQ(cloud.line, (std::vector<int>{6, 6, 8}));
}

TEST_F(CloudFileTest, NamesTheLineThatItCannotUse) {
  EXPECT_EQ(refusal(""), ":0: the first line is ''; expected 'x,y' or 'x,y,volume'");
  EXPECT_EQ(refusal("x,y\n"), ":1: no points; expected at least one");
  EXPECT_EQ(refusal("x,y\n1,2,3\n"), ":2: 3 columns; expected 2");
  EXPECT_EQ(refusal("x,y\n1,2\n1,\n"), ":3: ''; expected a finite number");
  EXPECT_EQ(refusal("x,y\n1,inf\n"), ":2: 'inf'; expected a finite number");
  EXPECT_EQ(refusal("x,y,volume\n1,2,0\n"), ":2: the volume 0; expected a volume above 0");
  const std::string vtk = "a legacy VTK file, ASCII, with POINTS";
  EXPECT_EQ(refusal("title\nBINARY\n", ".vtk"), ":2: the file is binary; expected " + vtk);
  EXPECT_EQ(refusal("title\nASCII\n", ".vtk"), ":2: no POINTS; expected " + vtk);
  EXPECT_EQ(refusal("ASCII\nPOINTS 2 float\n1 2 0\n", ".vtk"),
            ":3: the file ends after 1 points; expected 2");
}

}  // namespace
}  // namespace perifrac
