#include "modules/crack_fluid/face_work.hpp"

#include <gtest/gtest.h>

#include "modules/crack_fluid/network/lubrication.hpp"

namespace perifrac {
namespace {

/// Four facets in a line on a rock whose faces answer each other, under a stress that closes them.
struct Crack {
  static constexpr int count = 4;
  static constexpr double length = 1e-3, stress = 1e6;  // [m], [Pa]
  CrackLiquid liquid{.density = 1000.0, .viscosity = 1e-3, .bulk_modulus = 2e9};
  Lubrication lubrication{liquid};
  std::vector<double> closed, rate = std::vector<double>(count, 0.0), slope, mass = rate;
  Eigen::MatrixXd compliance{count, count};

  explicit Crack(double residual = 1e-30) {
    liquid.residual_aperture = residual;
    std::vector<CrackFacet<2>> facets;
    for (int f = 0; f < count; ++f)
      facets.push_back({{{length * f, 0.0}, {length * (f + 1), 0.0}}});
    lubrication = Lubrication(liquid, CrackGraph(facets));
    for (int f = 0; f < count; ++f) {
      for (int g = 0; g < count; ++g) compliance(f, g) = 1e-10 / (1.0 + (f - g) * (f - g));
    }
    const Eigen::VectorXd under_stress = compliance * Eigen::VectorXd::Constant(count, -stress);
    closed.assign(under_stress.begin(), under_stress.end());
    for (int f = 0; f < count; ++f) {
      for (int g = 0; g < count; ++g) slope.push_back(compliance(f, g));
    }
  }
  void at(std::initializer_list<double> unknowns) {
    const CrackStep rest{.time = {0.0, 0.0}, .opening = {closed, rate, slope, 0.0}, .mass = mass};
    lubrication.evaluate(rest, Eigen::Map<const Eigen::VectorXd>(unknowns.begin(), count));
  }
  /// What the rock holds, and what lifting the stress has cost [J/m].
  double energy() const {
    const Eigen::VectorXd net =
        lubrication.face_pressure() - Eigen::VectorXd::Constant(count, stress);
    return length * (0.5 * net.dot(lubrication.opening()) + stress * lubrication.opening().sum());
  }
  double book(FaceWork& work) {
    double sum = 0.0;
    for (int f = 0; f < count; ++f) sum += work.book(lubrication, f);
    return sum;
  }
};

/// However much of the openings the residual aperture hides from the fluid.
TEST(FaceWork, IsWhatTheRockReceivesWhereFacesOpenAndClose) {
  for (const double residual : {1e-30, 1e-4}) {
    Crack crack(residual);
    FaceWork work;
    crack.at({2e6, 1.5e6, 0.0, 0.0});  // the stress keeps the last ones closed
    ASSERT_GT(crack.lubrication.face_pressure()[3], 0.0);
    work.add_new(crack.lubrication);
    double before = crack.energy();
    for (const auto& pressures : {std::array{3e6, 2e6, 4e5, 0.0}, std::array{4e6, 3e6, 2e6, 1.2e6},
                                  std::array{9e5, 3e5, 2e5, 0.0}, std::array{0.0, 0.0, 0.0, 0.0}}) {
      crack.at({pressures[0], pressures[1], pressures[2], pressures[3]});
      const double received = crack.energy() - before;
      EXPECT_NEAR(crack.book(work), received, 1e-12 * std::abs(before) + 1e-20);
      before = crack.energy();
    }
    EXPECT_NEAR(crack.lubrication.opening().maxCoeff(), 0.0, 1e-20);  // it did close
  }
}

/// The last facet is dry beside a full one, closed or, beside wide ones, open.
TEST(FaceWork, IsThatOfFluidThatFollowsATip) {
  for (const double beside : {1.1e6, 4e6}) {
    Crack crack;
    const double dry = crack.liquid.empty();
    FaceWork work;
    crack.at({beside, beside, beside, dry});
    ASSERT_EQ(crack.lubrication.opening()[3] > 0.0, beside > 2e6);
    work.add_new(crack.lubrication);
    ASSERT_TRUE(work.knows_all_of(crack.lubrication));
    crack.at({1.2 * beside, beside, beside, dry});
    EXPECT_EQ(work.book(crack.lubrication, 3), 0.0);  // fluid has not come yet
    crack.at({beside, beside, beside, 2e6});
    EXPECT_DOUBLE_EQ(work.book(crack.lubrication, 3),
                     2e6 * Crack::length * crack.lubrication.opening()[3]);
  }
}

TEST(FaceWork, IsNoneWhereATipRunsAheadOfItsFluid) {
  Crack crack;
  const double dry = crack.liquid.empty();
  FaceWork work;
  crack.at({4e6, 4e6, dry, dry});
  work.add_new(crack.lubrication);
  const double opening = crack.lubrication.opening()[3];
  const double contact = crack.lubrication.face_pressure()[3];
  crack.at({6e6, 6e6, 6e6, dry});
  const double mean = 0.5 * (contact + crack.lubrication.face_pressure()[3]);
  const double opened = crack.lubrication.opening()[3] - opening;
  ASSERT_GT(opened, 0.0);
  EXPECT_DOUBLE_EQ(work.book(crack.lubrication, 3), Crack::length * mean * opened);
}

}  // namespace
}  // namespace perifrac
