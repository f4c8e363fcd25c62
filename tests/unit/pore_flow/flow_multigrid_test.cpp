#include "modules/pore_flow/flow_multigrid.hpp"

#include <cmath>
#include <span>

#include <gtest/gtest.h>

#include "core/base/eigen_view.hpp"
#include "core/operators/nonlocal_gradient.hpp"
#include "tests/unit/operators/test_bodies.hpp"

namespace perifrac {
namespace {

/// The bonds' flow in a square of `edge` points held at its left column, its middle third
/// `contrast` times as permeable, and what is stored beside gamma = 1.
class Square {
 public:
  Square(int edge, double contrast, double storage, test::Cloud cloud = test::Cloud::lattice)
      : body_(test::box_body<2>({edge, edge}, 1.0 / edge, cloud)),
        storage_(Eigen::VectorXd::Constant(body_->points().size(), storage)) {
    const auto family = body_->family(0);
    const Points<2>& points = body_->points();
    std::vector<double> stiffness(points.size());
    held_.resize(points.size());
    for (Index i = 0; i < points.size(); ++i) {
      const double x = points.position[0][i];
      stiffness[i] = x > 1.0 / 3.0 && x < 2.0 / 3.0 ? contrast : 1.0;
      held_[i] = x < 1.0 / edge;
    }
    flow_ =
        bond_matrix(*family, MirrorCondition<2, 1>(*family), std::span<const double>(stiffness));
  }

  std::unique_ptr<FlowMultigrid> multigrid() const {
    auto result = std::make_unique<FlowMultigrid>(flow_, held_);
    result->set(storage_, 1.0);
    return result;
  }
  Eigen::VectorXd times_matrix(const Eigen::VectorXd& p) const {
    Eigen::VectorXd product = storage_.cwiseProduct(p) + flow_ * p;
    for (Eigen::Index i = 0; i < product.size(); ++i) {
      if (held_[i]) product[i] = 0.0;
    }
    return product;
  }
  Eigen::VectorXd some(int seed) const {
    std::vector<double> values = test::random_values(held_.size(), seed);
    Eigen::VectorXd p = view(values);
    for (Eigen::Index i = 0; i < p.size(); ++i) {
      if (held_[i]) p[i] = 0.0;
    }
    return p;
  }

  /// Part of an error that a cycle leaves, of the error that it damps least, in the energy's norm.
  double left_by_a_cycle() const {
    const auto multigrid = this->multigrid();
    Eigen::VectorXd error = some(1), correction(error.size());
    double left = 0.0;
    for (int k = 0; k < 12; ++k) {
      const Eigen::VectorXd residual = times_matrix(error);
      const double before = error.dot(residual);
      multigrid->apply(residual, correction);
      error -= correction;
      left = std::sqrt(error.dot(times_matrix(error)) / before);
      error /= error.norm();
    }
    return left;
  }

 private:
  std::shared_ptr<const Body<2>> body_;
  Eigen::SparseMatrix<double> flow_;
  std::vector<bool> held_;
  Eigen::VectorXd storage_;
};

TEST(FlowMultigrid, IsSymmetric) {
  const Square square(48, 100.0, 1e-8);
  const auto multigrid = square.multigrid();
  const Eigen::VectorXd u = square.some(1), v = square.some(2);
  Eigen::VectorXd bu(u.size()), bv(v.size());
  multigrid->apply(u, bu);
  multigrid->apply(v, bv);
  EXPECT_NEAR(v.dot(bu), u.dot(bv), 1e-10 * std::abs(v.dot(bu)));
}

/// Whatever the number of points, their places, and how fast flow is beside what is stored.
TEST(FlowMultigrid, LeavesLittleOfAnError) {
  for (const int edge : {30, 120}) {
    for (const double storage : {1e-12, 1e-8, 1e-5, 1e-2}) {
      EXPECT_LT(Square(edge, 1.0, storage).left_by_a_cycle(), 0.27) << edge << " " << storage;
    }
  }
  for (const double contrast : {1e-6, 1e-2, 1e2, 1e6}) {
    EXPECT_LT(Square(60, contrast, 1e-8).left_by_a_cycle(), 0.4) << contrast;
  }
  EXPECT_LT(Square(60, 1.0, 1e-8, test::Cloud::jittered).left_by_a_cycle(), 0.3);
}

}  // namespace
}  // namespace perifrac
