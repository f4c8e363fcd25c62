#include "core/geometry/scatter.hpp"

#include <algorithm>
#include <numeric>

#include <gtest/gtest.h>

#include "tests/unit/operators/test_bodies.hpp"

namespace perifrac {
namespace {

/// Over many fields: mean 0, deviation 1, and the correlation that was asked for.
template <int D>
void expect_moments() {
  const double length = 0.7;
  const int fields = 4000;
  for (const double distance : {0.0, 0.35, 0.7, 1.4}) {
    Vector<D> x{}, y{};
    x[0] = 3.0;
    for (int a = 0; a < D; ++a) y[a] = x[a] + distance / std::sqrt(double(D));
    double sum = 0.0, product = 0.0;
    for (int seed = 0; seed < fields; ++seed) {
      const RandomField<D> field(length, seed);
      sum += field.at(x);
      product += field.at(x) * field.at(y);
    }
    const double sampling = 4.0 / std::sqrt(double(fields));  // four deviations of the estimate
    EXPECT_NEAR(sum / fields, 0.0, sampling);
    EXPECT_NEAR(product / fields, std::exp(-distance * distance / (length * length)),
                1.5 * sampling)
        << distance;
  }
}

TEST(RandomField, HasItsCorrelationIn2D) { expect_moments<2>(); }
TEST(RandomField, HasItsCorrelationIn3D) { expect_moments<3>(); }

/// Of one field, over a body many correlation lengths wide: the factor's own mean and deviation,
/// and the part of points in each quarter of the distribution.
TEST(Scatter, KeepsTheMean) {
  const double variation = 0.5;
  const auto body = test::box_body<2>({300, 300}, 1.0 / 300.0);
  const Scatter<2> scatter{RandomField<2>(0.01, 3), std::sqrt(std::log1p(variation * variation))};
  const Points<2>& points = body->points();
  std::vector<double> field;
  double mean = 0.0, square = 0.0;
  for (Index i = 0; i < points.size(); ++i) {
    const double factor = scatter.factor(points.at(i));
    field.push_back(scatter.field.at(points.at(i)));
    mean += factor / points.size();
    square += factor * factor / points.size();
  }
  EXPECT_NEAR(mean, 1.0, 0.03);
  EXPECT_NEAR(std::sqrt(square - mean * mean), variation, 0.05);
  for (const auto& [deviation, part] : {std::pair(-0.6745, 0.25), {0.0, 0.5}, {0.6745, 0.75}}) {
    const auto below =
        std::ranges::count_if(field, [limit = deviation](double g) { return g < limit; });
    EXPECT_NEAR(double(below) / points.size(), part, 0.03);
  }
}

struct Rock {
  static constexpr int components = 2;
  double stiffness;
};

/// A law a class and region; a point's is within half a class of its own.
TEST(Scatter, SplitsLawsIntoClasses) {
  const auto body = test::box_body<2>({40, 40}, 1.0);
  const Points<2>& points = body->points();
  LawByRegion<Rock> law{{{2.0}, {50.0}}, std::vector<std::uint8_t>(points.size())};
  for (Index i = 0; i < points.size(); ++i) law.law_of_point[i] = i % 2;
  const Scatter<2> scatter{RandomField<2>(7.0, 1), 0.3};
  const auto all = scattered(
      law, scatter, points, [](Rock rock, double factor) { return Rock{rock.stiffness * factor}; });
  const double half_class = std::exp(0.3 * 4.0 / 64.0);
  for (Index i = 0; i < points.size(); ++i) {
    const double exact = (i % 2 == 0 ? 2.0 : 50.0) * scatter.factor(points.at(i));
    EXPECT_LE(all.at(i).stiffness, exact * half_class * (1 + 1e-12));
    EXPECT_GE(all.at(i).stiffness, exact / half_class * (1 - 1e-12));
  }
}

}  // namespace
}  // namespace perifrac
