#include <numbers>

#include <Eigen/Dense>
#include <gtest/gtest.h>

#include "modules/solid/material/corotational_elasticity.hpp"
#include "tests/unit/solid/turning.hpp"

namespace perifrac {
namespace {

using test::Cloud;
using test::rotation;
using test::Square;
using test::Turning;

template <int D>
using Place = Eigen::Matrix<double, D, 1>;

template <int D>
Tensor<D, D> gradient_of(const Square<D>& f) {
  Tensor<D, D> g;
  for (int k = 0; k < D * D; ++k) g[k] = f(k / D, k % D) - (k / D == k % D ? 1.0 : 0.0);
  return g;
}

template <int D>
Square<D> matrix(const Tensor<D, D>& t) {
  return Eigen::Map<const Eigen::Matrix<double, D, D, Eigen::RowMajor>>(t.data());
}

template <class T>
class Corotational : public testing::Test {
 public:
  static constexpr int D = T::value;

  /// A lattice (packets) or not, with points whose bonds span no space, or none, beside whole ones.
  static std::shared_ptr<const Body<D>> body(Cloud cloud) {
    return test::box_body<D>(test::cube<D>(D == 2 ? 7 : 5), 0.5, cloud);
  }
  static Turning<D> torn(const Body<D>& body) {
    Turning<D> parts(body, SolidBoundary<D>(body));
    parts.cut(0, [](Index) { return true; });
    const double x = body.points().position[0][2], y = body.points().position[1][2];
    parts.cut(2, [&](Index j) {
      return std::abs(body.points().position[0][j] - x) > 0.8 ||
             std::abs(body.points().position[1][j] - y) > 0.3 ||
             (D == 3 &&
              std::abs(body.points().position[2][j] - body.points().position[2][2]) > 0.3);
    });
    return parts;
  }
  /// No rotation anywhere, strains of every kind.
  static Place<D> bend(const Place<D>& x, double size) {
    Place<D> to = x;
    for (int a = 0; a < D; ++a) {
      to[a] += size * (std::sin(1.1 * x[(a + 1) % D] + a) + 0.3 * x[a] * x[(a + 1) % D]);
    }
    return to;
  }
};

struct Names {
  template <class T>
  static std::string GetName(int) {
    return T::value == 2 ? "plane" : "space";
  }
};
using Dimensions = testing::Types<std::integral_constant<int, 2>, std::integral_constant<int, 3>>;
TYPED_TEST_SUITE(Corotational, Dimensions, Names);

TYPED_TEST(Corotational, FindsTheRotationAndTheStrainThatMadeAGradient) {
  constexpr int D = TypeParam::value;
  for (const double angle : {0.0, 1e-7, 0.3, 1.5, 2.0, 3.1, std::numbers::pi, -2.5}) {
    for (const double stretch : {0.0, 1e-6, 0.2, -0.6}) {
      Square<D> u = Square<D>::Identity();
      u(0, 0) += stretch;
      u(1, 1) -= 0.4 * stretch;
      u(0, 1) = u(1, 0) = 0.3 * stretch;
      const auto found = turned(gradient_of<D>(rotation<D>(angle) * u));
      EXPECT_LT((matrix<D>(found.rotation) - rotation<D>(angle)).norm(), 4e-15);
      EXPECT_LT((matrix<D>(found.strain) - u + Square<D>::Identity()).norm(), 4e-15);
    }
  }
}

/// The nearest rotation of what is turned inside out, and no word that is not a number.
TYPED_TEST(Corotational, StaysARotationWherePointsCollapse) {
  constexpr int D = TypeParam::value;
  for (const double left : {1e-3, 0.0, -0.5}) {
    Square<D> u = 0.8 * Square<D>::Identity();
    u(D - 1, D - 1) = left;
    const auto found = turned(gradient_of<D>(rotation<D>(0.7) * u));
    EXPECT_LT((matrix<D>(found.rotation) - rotation<D>(0.7)).norm(), 1e-13) << left;
    EXPECT_LT((matrix<D>(found.strain) - u + Square<D>::Identity()).norm(), 1e-13) << left;
  }
  const auto gone = matrix<D>(turned(gradient_of<D>(Square<D>::Zero())).rotation);
  EXPECT_LT((gone * gone.transpose() - Square<D>::Identity()).norm(), 1e-14);
}

TYPED_TEST(Corotational, PacketsAreWhatTheirNumbersAre) {
  constexpr int D = TypeParam::value;
  std::array<Packet, D * D> packets;
  for (auto& packet : packets) packet = Packet{};
  const auto values = test::random_values(D * D * packet_size);
  for (int l = 1; l < packet_size; ++l) {  // the first is at rest
    for (int k = 0; k < D * D; ++k) packets[k][l] = values[l * D * D + k];
  }
  const auto found = turned(packets);
  for (int l = 0; l < packet_size; ++l) {
    Tensor<D, D> one;
    for (int k = 0; k < D * D; ++k) one[k] = packets[k][l];
    const auto expected = turned(one);
    for (int k = 0; k < D * D; ++k) {
      EXPECT_NEAR(found.rotation[k][l], expected.rotation[k], 1e-15);
      EXPECT_NEAR(found.strain[k][l], expected.strain[k], 1e-15);
    }
  }
}

TYPED_TEST(Corotational, ARigidMotionMakesNoForceAndNoStrain) {
  constexpr int D = TypeParam::value;
  for (const Cloud cloud : {Cloud::lattice, Cloud::jittered}) {
    const auto body = this->body(cloud);
    for (const bool broken : {false, true}) {
      Turning<D> parts = broken ? this->torn(*body) : Turning<D>(*body, SolidBoundary<D>(*body));
      for (const double angle : {1e-3, 0.5, 1.6, std::numbers::pi, 5.0}) {
        const auto turn = rotation<D>(angle);
        const auto u = test::moved(
            *body, [&](const auto& x) -> Place<D> { return turn * x + Place<D>::Constant(0.7); });
        const double linear = test::size(parts.small_force(u));
        EXPECT_LT(test::size(parts.force(u)), 1e-13 * std::max(linear, 1.0));
        if (angle > 0.1) {  // what a small rotation would make of it
          EXPECT_GT(linear, 1.0);
        }
        EXPECT_LT(parts.elastic->energy(u, {}), 1e-25);
        std::vector<double> stress(D * D * body->points().size());
        parts.elastic->stress(u, stress);
        EXPECT_LT(test::size(stress), 1e-12);
      }
    }
  }
}

TYPED_TEST(Corotational, AStrainedBodyThatTurnedHasTheTurnedForces) {
  constexpr int D = TypeParam::value;
  for (const Cloud cloud : {Cloud::lattice, Cloud::jittered}) {
    const auto body = this->body(cloud);
    Turning<D> parts = this->torn(*body);
    const auto u = test::moved(*body, [&](const auto& x) { return this->bend(x, 1e-3); });
    const auto force = parts.force(u);
    const double energy = parts.elastic->energy(u, {});
    for (const double angle : {0.5 * std::numbers::pi, 0.2, 3.0}) {
      const auto turn = rotation<D>(angle);
      const auto turned_u =
          test::moved(*body, [&](const auto& x) -> Place<D> { return turn * this->bend(x, 1e-3); });
      const auto turned_force = parts.force(turned_u);
      double error = 0.0;
      for (Index i = 0; i < body->points().size(); ++i) {
        error =
            std::max(error, (test::at<D>(turned_force, i) - turn * test::at<D>(force, i)).norm());
      }
      EXPECT_LT(error, 1e-12 * test::size(force));
      EXPECT_NEAR(parts.elastic->energy(turned_u, {}), energy, 1e-12 * energy);
    }
  }
}

TYPED_TEST(Corotational, AgreesWithSmallRotationsToTheirSquare) {
  constexpr int D = TypeParam::value;
  const auto body = this->body(Cloud::lattice);
  Turning<D> parts = this->torn(*body);
  std::vector<double> apart;
  for (const double size : {1e-3, 1e-4}) {
    const auto turn = rotation<D>(size);
    const auto u =
        test::moved(*body, [&](const auto& x) -> Place<D> { return turn * this->bend(x, size); });
    const auto exact = parts.force(u);
    apart.push_back(test::distance(exact, parts.small_force(u)));
    EXPECT_LT(apart.back(), 10.0 * size * test::size(exact));
  }
  EXPECT_NEAR(std::log10(apart[0] / apart[1]), 2.0, 0.02);
}

/// Beside mirrored faces of either kind, pore pressure and points of few bonds too, at strains and
/// rotations of any size.
TYPED_TEST(Corotational, TheForceIsTheDerivativeOfTheEnergy) {
  constexpr int D = TypeParam::value;
  for (const Cloud cloud : {Cloud::lattice, Cloud::jittered}) {
    const auto body = this->body(cloud);
    SolidBoundary<D> boundary(*body);
    boundary.roller(0, 0.0);
    boundary.fixed(2, {});
    Turning<D> parts(*body, boundary);
    parts.cut(8, [](Index) { return true; });
    parts.cut(24, [](Index j) { return j > 26; });
    const std::size_t unknowns = parts.elastic->size(), points = body->points().size();
    const std::vector<double> p = test::random_values(points, 3), slope(points, -0.4);
    const auto turn = rotation<D>(0.9);
    auto u =
        test::moved(*body, [&](const auto& x) -> Place<D> { return turn * this->bend(x, 0.1); });
    u.resize(unknowns, 0.02);
    const auto direction = test::random_values(unknowns, 5);
    for (const bool wet : {false, true}) {
      const PoreStress pore = wet ? PoreStress{p, slope} : PoreStress{};
      std::vector<double> theta(points), force(unknowns), other(unknowns);
      const auto energy = [&](double along) {
        auto there = u;
        for (std::size_t k = 0; k < unknowns; ++k) there[k] += along * direction[k];
        parts.elastic->apply(there, {}, other, theta);
        double sum = parts.elastic->energy(there, other);
        for (std::size_t i = 0; wet && i < points; ++i) {
          sum -= body->points().volume[i] * (p[i] + 0.5 * slope[i] * theta[i]) * theta[i];
        }
        return sum;
      };
      parts.elastic->apply(u, pore, force, {});
      double slope_of_energy = 0.0;
      for (std::size_t k = 0; k < unknowns; ++k) slope_of_energy += force[k] * direction[k];
      const double h = 1e-4;
      const double measured =
          (8.0 * (energy(h) - energy(-h)) - (energy(2.0 * h) - energy(-2.0 * h))) / (12.0 * h);
      EXPECT_NEAR(slope_of_energy, measured, 1e-8 * std::abs(measured));
    }
  }
}

TYPED_TEST(Corotational, InnerForcesHaveNoSumAndNoMoment) {
  constexpr int D = TypeParam::value;
  for (const Cloud cloud : {Cloud::lattice, Cloud::jittered}) {
    const auto body = this->body(cloud);
    Turning<D> parts = this->torn(*body);
    const auto turn = rotation<D>(2.2);
    const auto u = test::moved(*body, [&](const auto& x) -> Place<D> {
      return turn * this->bend(x, 0.2) + Place<D>::Constant(3.0);
    });
    const auto force = parts.force(u);
    Place<D> sum = Place<D>::Zero();
    Square<D> moment = Square<D>::Zero();
    for (Index i = 0; i < body->points().size(); ++i) {
      const Place<D> f = test::at<D>(force, i);
      sum += f;
      moment += f * (test::place(*body, i) + test::at<D>(u, i)).transpose();
    }
    EXPECT_LT(sum.norm(), 1e-13 * test::size(force));
    EXPECT_LT((moment - moment.transpose()).norm(), 1e-12 * test::size(force));
  }
}

}  // namespace
}  // namespace perifrac
