#include "app/warnings/fluid_in_rock.hpp"

#include <algorithm>
#include <functional>

#include <gtest/gtest.h>

#include "core/geometry/lattice.hpp"

namespace perifrac {
namespace {

/// A block of points at (n + 1/2), those left out that `is_cut`.
template <int D>
Body<D> block(const std::function<bool(const Vector<D>&)>& is_cut) {
  std::array<int, D> counts;
  counts.fill(12);
  const Points<D> all = box_lattice<D>(counts, 1.0);
  Points<D> left;
  for (Index i = 0; i < all.size(); ++i) {
    if (is_cut(all.at(i))) continue;
    for (int a = 0; a < D; ++a) left.position[a].push_back(all.position[a][i]);
    left.volume.push_back(all.volume[i]);
  }
  return Body<D>(std::move(left), {}, 1.0, 2.5, InfluenceFunction::constant);
}

template <int D>
std::size_t found_at(const Body<D>& body, const Vector<D>& x,
                     const std::vector<double>& displacement = {}) {
  Positions<D> fluid;
  for (int a = 0; a < D; ++a) fluid[a] = std::span(&x[a], 1);
  return fluid_in_rock<D>(body, displacement, fluid).count;
}

template <int D>
void expect_found_inside_only() {
  const Body<D> whole = block<D>([](const Vector<D>&) { return false; });
  Vector<D> x;
  for (const double place : {6.0, 6.3, 6.5}) {  // between points and on one
    x.fill(place);
    EXPECT_EQ(found_at<D>(whole, x), 1u) << place;
  }
  for (const double depth : {-2.0, -0.5, 0.0, 0.3}) {  // below its lower face
    x.fill(6.2);
    x[D - 1] = depth;
    EXPECT_EQ(found_at<D>(whole, x), 0u) << depth;
  }
  x[D - 1] = 2.0;
  EXPECT_EQ(found_at<D>(whole, x), 1u);
  const Body<D> slit = block<D>([](const Vector<D>& y) { return y[D - 1] == 6.5; });
  for (const double place : {6.1, 6.5, 6.9}) {
    x[D - 1] = place;
    EXPECT_EQ(found_at<D>(slit, x), 0u) << place;
  }
  const Body<D> hole = block<D>([](const Vector<D>& y) {
    return std::ranges::all_of(y, [](double component) { return component == 6.5; });
  });
  x.fill(6.5);
  EXPECT_EQ(found_at<D>(hole, x), 0u);
}

TEST(FluidInRock, IsFoundInsideAndNotAtSurfacesOrInSlits) {
  expect_found_inside_only<2>();
  expect_found_inside_only<3>();
}

TEST(FluidInRock, IsWhereTheRockIsNow) {
  const Body<2> body = block<2>([](const Vector<2>&) { return false; });
  std::vector<double> aside(2 * body.points().volume.size(), 0.0);
  std::fill_n(aside.begin(), body.points().volume.size(), 20.0);
  EXPECT_EQ(found_at<2>(body, {6.0, 6.0}, aside), 0u);
  EXPECT_EQ(found_at<2>(body, {26.0, 6.0}, aside), 1u);
}

}  // namespace
}  // namespace perifrac
