#include "modules/fluid/as_published/paper_exchange.hpp"

#include <cmath>

#include <Eigen/Dense>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "tests/unit/fluid/fluid_over_body.hpp"

namespace perifrac {
namespace {

using test::FluidOverBody;
using test::sum;

/// The printed equations between all points and their images across, in two dimensions.
class Printed {
 public:
  struct Node {
    Eigen::Vector2d x;
    double volume, potential, mobility, density;
    bool is_fluid;
    Eigen::Matrix2d inverse_shape = Eigen::Matrix2d::Zero();
    Eigen::Vector2d q = Eigen::Vector2d::Zero();
    double rate = 0.0;
  };

  Printed(const FluidOverBody<2>& scene, double width) : width_(width) {
    const auto head = [&](const Vector<2>& x, double p) {
      return p - 1000.0 * scene.gravity[1] * x[1];
    };
    for (Index i = 0; i < scene.points.count; ++i) {
      const Vector<2> x = scene.points.at(i);
      nodes.push_back({{x[0], x[1]},
                       scene.points.volume[i],
                       head(x, scene.points.pressure[i]),
                       scene.mobility[0],
                       scene.points.density[i],
                       true});
    }
    for (Index j = 0; j < scene.body->points().size(); ++j) {
      const Vector<2> x = scene.body->points().at(j);
      nodes.push_back({{x[0], x[1]},
                       scene.body->points().volume[j],
                       head(x, scene.pressure[j]),
                       scene.mobility[j],
                       scene.fluid.density,
                       false});
    }
    for (Node& a : nodes) {
      Eigen::Matrix2d shape = Eigen::Matrix2d::Zero();
      for_neighbours(a, [&](const Node& b, const Eigen::Vector2d& y, double weight) {
        shape += weight * y * y.transpose();
        (void)b;
      });
      a.inverse_shape = shape.inverse();
    }
    for (Node& a : nodes) {  // Eqs 25, 30
      for_neighbours(a, [&](const Node& b, const Eigen::Vector2d& y, double weight) {
        a.q -= a.mobility * weight * (b.potential - a.potential) * (a.inverse_shape * y);
      });
    }
    for (Node& a : nodes) {  // Eqs 26, 31
      for_neighbours(a, [&](const Node& b, const Eigen::Vector2d& y, double weight) {
        if (a.is_fluid == b.is_fluid) return;
        a.rate -= a.density * a.volume * weight * (b.q - a.q).dot(a.inverse_shape * y);
      });
    }
  }

  std::vector<Node> nodes;

 private:
  template <class Use>
  void for_neighbours(const Node& a, Use&& use) const {
    for (const Node& b : nodes) {
      for (int k = -1; k <= 1; ++k) {
        const Eigen::Vector2d y = b.x + Eigen::Vector2d(k * width_, 0.0) - a.x;
        if (y.norm() == 0.0 || y.norm() >= 1.25) continue;
        use(b, y, std::exp(-y.squaredNorm() / 0.25) * b.volume);
      }
    }
  }

  double width_;
};

PaperExchange<2> exchange_of(const FluidOverBody<2>& scene) {
  return {*scene.body, scene.cloud, FluidOverBody<2>::make_period(3.0), scene.scheme.horizon,
          scene.influence};
}

TEST(PaperExchange, IsWhatIsPrinted) {
  // Horizon 1.25 m, influence width 0.5 m, period 3 m. Fluid so high that no shape tensor near the
  // interface is regularised.
  FluidOverBody<2> scene(6, 6, 0.5, 0.1);
  scene.gravity[1] = -9.81;
  for (std::size_t j = 0; j < scene.pressure.size(); ++j) scene.pressure[j] = 50.0 * (j % 11);
  scene.prepare([](const Vector<2>& x) { return 2e4 + 3e3 * std::sin(x[0]) - 1e3 * x[1]; });
  PaperExchange<2> exchange = exchange_of(scene);
  const std::vector<double> rate = scene.find(exchange);
  const Printed printed(scene, 3.0);
  double scale = 0.0;
  for (const Printed::Node& node : printed.nodes) scale = std::max(scale, std::abs(node.rate));
  ASSERT_GT(scale, 0.0);
  for (Index i = 0; i < scene.points.count; ++i) {
    EXPECT_NEAR(rate[i], printed.nodes[i].rate, 1e-11 * scale) << i;
  }
  for (Index k = 0; k < scene.walls.count; ++k) {
    const Index j = scene.cloud.owner[scene.walls.wall[k]];
    EXPECT_NEAR(scene.walls.mass_rate[k], printed.nodes[scene.points.count + j].rate, 1e-11 * scale)
        << j;
  }
}

TEST(PaperExchange, PassesNothingInASteadyFlow) {
  // A rate of density is the divergence of the flux, and a steady one has none: what the fluid
  // should hand over to the pores it keeps.
  FluidOverBody<2> scene(6, 6, 0.5);
  for (Index j = 0; j < scene.body->points().size(); ++j) {
    scene.pressure[j] = 1e4 * scene.body->points().position[1][j];
  }
  scene.prepare([](const Vector<2>& x) { return 1e4 * x[1]; });
  PaperExchange<2> exchange = exchange_of(scene);
  const std::vector<double> rate = scene.find(exchange);
  const double darcy = 1000.0 * 1e-9 * 1e4 * 3.0;  // [kg/s] through 3 m
  EXPECT_NEAR(sum(scene.walls.mass_rate), 0.0, 1e-12 * darcy);
}

/// Of the printed equations Eq 23 alone, the shape tensor of the fluid, knows of damage.
TEST(PaperExchange, CountsDamagedPointsWhole) {
  FluidOverBody<2> scene(6, 6, 0.5, 0.1);
  scene.prepare([](const Vector<2>& x) { return 2e4 + 3e3 * std::sin(x[0]) - 1e3 * x[1]; });
  PaperExchange<2> exchange = exchange_of(scene);
  const std::vector<double> rate = scene.find(exchange);
  const std::vector<double> mass_rate = scene.walls.mass_rate;
  for (Index w = 0; w < scene.walls.count; w += 2) scene.walls.volume[w] *= 0.4;
  EXPECT_EQ(scene.find(exchange), rate);
  EXPECT_EQ(scene.walls.mass_rate, mass_rate);
}

TEST(PaperExchange, TakesFromBothSides) {
  // Still water over rock through which it seeps steadily: the pores should get what the fluid
  // loses.
  FluidOverBody<2> scene(6, 6, 0.5);
  for (Index j = 0; j < scene.body->points().size(); ++j) {
    scene.pressure[j] = 1e4 * (1.0 + scene.body->points().position[1][j] / 3.0);
  }
  scene.prepare([](const Vector<2>&) { return 1e4; });
  PaperExchange<2> exchange = exchange_of(scene);
  const std::vector<double> rate = scene.find(exchange);
  EXPECT_FALSE(exchange.keeps_mass());
  const double lost = -sum(rate);
  EXPECT_GT(lost, 0.0);
  EXPECT_NEAR(-sum(scene.walls.mass_rate), lost, 1e-12 * lost);
}

}  // namespace
}  // namespace perifrac
