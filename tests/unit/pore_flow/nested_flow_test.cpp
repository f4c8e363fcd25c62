#include <algorithm>
#include <iterator>
#include <numeric>

#include <fmt/format.h>
#include <gtest/gtest.h>

#include "tests/spectra.hpp"
#include "tests/unit/pore_flow/pore_body.hpp"

/// What the paper's scheme does, so that its limits stay on record.
namespace perifrac {
namespace {

using test::Cloud;
using test::scalar;

/// Growth rate of the fastest mode over diffusivity / spacing^2.
double growth(double horizon_ratio, FaceSet mirrored, Cloud cloud = Cloud::lattice) {
  const auto body = test::box_body<2>({16, 16}, 1.0, cloud, horizon_ratio);
  const auto family = body->family(mirrored);
  const NestedFlow<2, DarcyLaw<2>> flow({family, MirrorCondition<2, 1>(*family), DarcyLaw<2>{1.0}});
  Eigen::MatrixXd rate = -Eigen::MatrixXd(flow.assemble());
  for (Index i = 0; i < family->point_count; ++i) rate.row(i) /= family->volume[i];
  return test::eigenvalues(rate).real().maxCoeff();
}

TEST(NestedFlow, HasGrowingModesWhereFamiliesAreCut) {
  const std::array<std::pair<double, double>, 4> known = {
      {{2.0, 0.787}, {2.5, 0.808}, {3.0, 0.681}, {4.0, 0.440}}};
  for (const auto& [horizon_ratio, rate] : known) {
    const double cut = growth(horizon_ratio, 0);
    RecordProperty(fmt::format("growth_at_{}", horizon_ratio), fmt::format("{:.4f}", cut));
    EXPECT_NEAR(cut, rate, 0.002) << horizon_ratio;
  }
}

TEST(NestedFlow, GrowsNotWhereAllFamiliesAreAlike) {
  EXPECT_LT(growth(2.5, 0b1111), 1e-12);
  const double on_cloud = growth(2.5, 0b1111, Cloud::jittered);
  RecordProperty("growth_on_a_cloud", fmt::format("{:.4f}", on_cloud));
  EXPECT_GT(on_cloud, 0.01);
}

enum class Stepping { plain, smoothed, compensated, cvode };

bool is_smoothed(Stepping stepping) {
  return stepping == Stepping::smoothed || stepping == Stepping::compensated;
}

DarcyIntegratorMaker<2> integrator(Stepping stepping) {
  return [=](DarcySystem<2>& system) -> std::unique_ptr<Integrator> {
    if (stepping == Stepping::plain) return std::make_unique<ForwardEuler>(system, 0.9);
    if (is_smoothed(stepping)) {
      return std::make_unique<SmoothedEuler>(
          system, 0.9, [&system](double t, std::span<double> y) { system.smooth(t, y); });
    }
    return std::make_unique<DarcyCvode<2>>(system, DarcyCvode<2>::Systems::iterated, 1e-5);
  };
}

/// A column of height 1 and pressure 1 that drains through a layer at its top. Elsewhere families
/// are cut, as between bonded layers, or mirrored.
class Column {
 public:
  Column(bool cut, Stepping stepping)
      : body_(test::body_with_layer_on_top<2>({8, 20}, 0.05)),
        flow_(body_, system(cut, stepping), {1.0}, integrator(stepping)) {
    flow_.initialize(0.0);
    start_ = scalar(flow_, "pore_fluid_mass");
  }

  void advance(double time_factor) {
    const double end = time_factor * test::some_rock.storage / test::some_rock.mobility;
    flow_.advance({time_, end});
    time_ = end;
    time_factor_ = time_factor;
  }

  double largest_pressure() { return test::largest(test::port(flow_, "pore_pressure").value); }

  double error() {
    const auto p = test::port(flow_, "pore_pressure").value;
    double worst = 0.0;
    for (Index i = 0; i < body_->points().size(); ++i) {
      const double z = body_->points().position[1][i];
      if (z < 1.0) {
        worst = std::max(worst, std::abs(p[i] - test::drained_column(z, time_factor_)));
      }
    }
    return worst;
  }

  /// What is there beyond what should be, over what was there at the start.
  double surplus() {
    return (scalar(flow_, "pore_fluid_mass") - start_ - scalar(flow_, "pore_fluid_gained")) /
           start_;
  }
  double artificial() { return scalar(flow_, "artificial_fluid_mass") / start_; }

 private:
  DarcySystem<2> system(bool cut, Stepping stepping) const {
    PoreBoundary<2> boundary(*body_);
    boundary.pressure(3, 0.0);
    const auto family = body_->family(cut ? 0 : boundary.mirrored());
    const MirrorCondition<2, 1> mirror(*family);
    LinearExactOperator<2, DarcyLaw<2>> op(family, mirror, {test::some_rock.mobility});
    auto system = test::darcy_system(boundary, FlowScheme::nested, std::move(op), test::some_rock);
    if (is_smoothed(stepping)) {
      const bool compensated = stepping == Stepping::compensated;
      std::vector<Index> points(body_->points().size()), held;
      std::iota(points.begin(), points.end(), 0);
      std::ranges::copy_if(points, std::back_inserter(held),
                           [&](Index i) { return body_->points().position[1][i] > 1.0; });
      if (!compensated) points = points_near_surfaces(*body_);
      system.set_smoothing({family, mirror, std::move(points), held, compensated});
    }
    return system;
  }

  std::shared_ptr<const Body<2>> body_;
  DarcyFlow<2> flow_;
  double start_ = 0.0;
  double time_ = 0.0;
  double time_factor_ = 0.0;
};

/// Time factor at which pressures are twice those at the start, by steps of 0.0025; 1 if never.
double time_of_blow_up(Column& column) {
  for (int n = 1; n < 400; ++n) {
    column.advance(0.0025 * n);
    if (column.largest_pressure() > 2.0) return 0.0025 * n;
  }
  return 1.0;
}

TEST(NestedFlow, BlowsUpWhereFamiliesAreCut) {
  for (const Stepping stepping : {Stepping::plain, Stepping::cvode}) {
    Column column(true, stepping);
    const double time_factor = time_of_blow_up(column);
    RecordProperty(fmt::format("blow_up_{}", static_cast<int>(stepping)),
                   fmt::format("at T = {:.4f}, surplus {:.3f}", time_factor, column.surplus()));
    EXPECT_GT(time_factor, 0.005);
    EXPECT_LT(time_factor, 0.03);
  }
}

TEST(NestedFlow, DrainsBetweenMirrorsAndMakesFluidAtTheLayer) {
  Column column(false, Stepping::plain);
  column.advance(0.1);
  RecordProperty("mirrored",
                 fmt::format("error {:.3f}, surplus {:.3f}", column.error(), column.surplus()));
  EXPECT_LT(column.error(), 0.2);
  EXPECT_GT(column.surplus(), 0.03);
}

TEST(NestedFlow, IsHeldTogetherBySmoothingWithALargeError) {
  Column column(true, Stepping::smoothed);
  for (int n = 1; n <= 200; ++n) {
    const double time_factor = 0.0025 * n;
    column.advance(time_factor);
    if (n != 40 && n != 80 && n != 200) continue;
    RecordProperty(fmt::format("smoothed_T_{}", time_factor),
                   fmt::format("error {:.4f}, surplus {:.4f}, of smoothing {:.4f}", column.error(),
                               column.surplus(), column.artificial()));
    EXPECT_GT(column.error(), 0.02);
    EXPECT_LT(column.error(), 0.1);
    // The ledger's gap holds what smoothing took, and is not excused by it.
    EXPECT_LT(column.artificial(), -0.05);
    EXPECT_LT(column.surplus(), -0.03);
  }
}

/// Everywhere: near the faces alone the growing modes win.
TEST(NestedFlow, IsHeldTogetherWhereNeighboursMakeUpForSmoothing) {
  Column column(true, Stepping::compensated);
  for (int n = 1; n <= 200; ++n) {
    const double time_factor = 0.0025 * n;
    column.advance(time_factor);
    if (n != 40 && n != 80 && n != 200) continue;
    RecordProperty(fmt::format("compensated_T_{}", time_factor),
                   fmt::format("error {:.4f}, surplus {:.4f}, of smoothing {:.2e}", column.error(),
                               column.surplus(), column.artificial()));
    EXPECT_LT(column.largest_pressure(), 1.1);
    EXPECT_LT(column.error(), 0.2);
    EXPECT_LT(std::abs(column.artificial()), 1e-13);
  }
}

/// Against a sum over all pairs: what a point gains, those of its mean give by their weights in it,
/// and a held one gives nothing.
TEST(NestedFlow, TakesFromTheNeighboursWhatSmoothingAdds) {
  const auto body = test::box_body<2>({10, 9}, 0.5, Cloud::jittered);
  const Points<2>& points = body->points();
  const auto family = body->family(0);
  const std::vector<Index> held = {0, 13, 57};
  PressureSmoothing<2> smoothing(family, MirrorCondition<2, 1>(*family),
                                 points_near_surfaces(*body), held, true);
  EXPECT_FALSE(std::ranges::binary_search(smoothing.points(), 13));
  const auto gained = test::random_values(static_cast<Index>(smoothing.points().size()));
  std::vector<double> exact(points.size(), 0.0);
  double all = 0.0;
  for (std::size_t k = 0; k < gained.size(); ++k) {
    std::vector<double> weight(points.size(), 0.0);
    double weights = 0.0;
    const Index i = smoothing.points()[k];
    for (Index j = 0; j < points.size(); ++j) {
      const double r = std::hypot(points.position[0][j] - points.position[0][i],
                                  points.position[1][j] - points.position[1][i]);
      if (j == i || r > body->horizon() || std::ranges::binary_search(held, j)) continue;
      weight[j] = std::exp(-std::pow(r / (0.4 * body->horizon()), 2)) * points.volume[j];
      weights += weight[j];
    }
    for (Index j = 0; j < points.size(); ++j) exact[j] += gained[k] * weight[j] / weights;
    all += gained[k];
  }
  std::ranges::copy(gained, smoothing.gained().begin());
  const std::span<const double> given = smoothing.given();
  double sum = 0.0;
  for (Index j = 0; j < points.size(); ++j) {
    EXPECT_NEAR(given[j], exact[j], 1e-14) << j;
    sum += given[j];
  }
  EXPECT_NEAR(sum, all, 1e-13);
}

/// Beside mirrors nothing is lost: images give through their sources.
TEST(NestedFlow, LosesNothingBesideMirrors) {
  const auto body = test::box_body<2>({10, 9}, 0.5);
  const auto family = body->family(0b1111);
  PressureSmoothing<2> smoothing(family, MirrorCondition<2, 1>(*family),
                                 points_near_surfaces(*body), {}, true);
  const auto gained = test::random_values(static_cast<Index>(smoothing.points().size()));
  std::ranges::copy(gained, smoothing.gained().begin());
  const std::span<const double> given = smoothing.given();
  EXPECT_NEAR(std::accumulate(given.begin(), given.end(), 0.0),
              std::accumulate(gained.begin(), gained.end(), 0.0), 1e-13);
}

TEST(NestedFlow, KeepsAUniformPressureWhileItIsSmoothed) {
  const auto body = test::box_body<2>({10, 9}, 0.5);
  const auto family = body->family(0b1111);
  PressureSmoothing<2> smoothing(family, MirrorCondition<2, 1>(*family),
                                 points_near_surfaces(*body), {}, false);
  EXPECT_EQ(smoothing.points().size(), 90u - 4u * 3u);  // all but those three rows inside
  const std::vector<double> p(90, 0.7);
  for (const double value : smoothing.apply(p)) EXPECT_NEAR(value, 0.7, 1e-15);
}

/// Against a sum over all pairs of points.
TEST(NestedFlow, SmoothsAsTheMeanOverTheNeighbourhood) {
  const auto body = test::box_body<2>({10, 9}, 0.5, Cloud::jittered);
  const Points<2>& points = body->points();
  const auto family = body->family(0);
  PressureSmoothing<2> smoothing(family, MirrorCondition<2, 1>(*family),
                                 points_near_surfaces(*body), {}, false);
  const auto p = test::random_values(90);
  const std::span<const double> smoothed = smoothing.apply(p);
  for (std::size_t k = 0; k < smoothed.size(); ++k) {
    const Index i = smoothing.points()[k];
    double sum = 0.0, weights = 0.0;
    for (Index j = 0; j < points.size(); ++j) {
      const double r = std::hypot(points.position[0][j] - points.position[0][i],
                                  points.position[1][j] - points.position[1][i]);
      if (r > body->horizon()) continue;
      const double weight = std::exp(-std::pow(r / (0.4 * body->horizon()), 2)) * points.volume[j];
      sum += weight * p[j];
      weights += weight;
    }
    EXPECT_NEAR(smoothed[k], sum / weights, 1e-14);
  }
}

}  // namespace
}  // namespace perifrac
