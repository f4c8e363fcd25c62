#include "modules/solid/boundary/rigid_motion.hpp"

#include <gtest/gtest.h>

#include "modules/solid/quasi_static_solid.hpp"
#include "tests/unit/operators/test_bodies.hpp"
#include "tests/unit/solid/elastic.hpp"

namespace perifrac {
namespace {

template <int D>
struct Held {
  std::shared_ptr<const Body<D>> body = test::box_body<D>(test::cube<D>(6), 0.1);
  SolidBoundary<D> boundary{*body};

  std::string free_motion() const {
    return QuasiStaticSolid<D>(body, test::elastic<D>(*body, boundary, {1e9, 1e9}), boundary)
        .free_motion();
  }
};

TEST(RigidMotion, IsFoundIn2D) {
  Held<2> held;
  EXPECT_NE(held.free_motion(), "");
  held.boundary.roller(0, 0.0);
  EXPECT_EQ(held.free_motion(), "it can slide along y");
  held.boundary.rigid_plate(3, 1e3);
  EXPECT_EQ(held.free_motion(), "it can slide along y") << "a plate moves along";
  held.boundary.roller(2, 0.0);
  EXPECT_EQ(held.free_motion(), "");
}

TEST(RigidMotion, IsFoundIn3D) {
  Held<3> held;
  held.boundary.roller(0, 0.0);
  held.boundary.roller(4, 0.0);
  EXPECT_EQ(held.free_motion(), "it can slide along y");
  held.boundary.roller(3, 0.0);
  EXPECT_EQ(held.free_motion(), "");
}

TEST(RigidMotion, IsNoneWhereOneFaceIsFixed) {
  Held<3> held;
  held.boundary.fixed(5, {});
  EXPECT_EQ(held.free_motion(), "");
}

TEST(RigidMotion, FindsARotation) {
  // Springs at the middle hold the place of a body and let it turn.
  const auto body = test::box_body<2>({6, 6}, 1.0);
  const auto family = body->family(0);
  Eigen::SparseMatrix<double> stiffness = LinearExactOperator<2, IsotropicElasticity<2>>(
                                              family, MirrorCondition<2, 2>(*family), {1.0, 1.0})
                                              .assemble();
  const Index n = body->points().size();
  Eigen::VectorXd mean = Eigen::VectorXd::Zero(2 * n);
  mean.head(n).setOnes();
  Eigen::MatrixXd dense = stiffness;
  dense += mean * mean.transpose();
  mean.setZero();
  mean.tail(n).setOnes();
  dense += mean * mean.transpose();
  Eigen::SparseMatrix<double> all(2 * n, 2 * n);
  all.setIdentity();
  const auto times = [&](const Eigen::VectorXd& u) -> Eigen::VectorXd { return dense * u; };
  EXPECT_EQ(rigid_motion_without_energy<2>(body->points(), times, all, 0),
            "it can turn in the plane of x and y");
}

}  // namespace
}  // namespace perifrac
