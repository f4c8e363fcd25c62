#include "app/references/solutions/cantilever_solution.hpp"

#include <cmath>

#include <Eigen/Dense>
#include <gtest/gtest.h>

#include "tests/spectra.hpp"

namespace perifrac {
namespace {

CantileverProblem beam(double length) {
  return {.youngs_modulus = 1e9,
          .poisson_ratio = 0.3,
          .density = 2000.0,
          .length = length,
          .height = 1.0,
          .load = -1e3};
}

/// Linear elements for deflection and rotation, shear at one point an element.
struct Elements {
  double angular_frequency;
  double deflection;

  explicit Elements(const CantileverProblem& problem, int elements = 120) {
    const double stiffness =
        problem.youngs_modulus / (1.0 - problem.poisson_ratio * problem.poisson_ratio);
    const double bending = stiffness * std::pow(problem.height, 3) / 12.0;
    const double shear =
        5.0 / 6.0 * problem.height * problem.youngs_modulus / (2.0 * (1.0 + problem.poisson_ratio));
    const double h = problem.length / elements;
    const int size = 2 * (elements + 1);
    Eigen::MatrixXd k = Eigen::MatrixXd::Zero(size, size);
    Eigen::MatrixXd m = k;
    Eigen::VectorXd f = Eigen::VectorXd::Zero(size);
    Eigen::Matrix2d mass;
    mass << h / 3.0, h / 6.0, h / 6.0, h / 3.0;
    for (int e = 0; e < elements; ++e) {
      const Eigen::Vector4d curvature(0.0, -1.0 / h, 0.0, 1.0 / h);
      const Eigen::Vector4d angle(-1.0 / h, -0.5, 1.0 / h, -0.5);
      k.block<4, 4>(2 * e, 2 * e) +=
          h * (bending * curvature * curvature.transpose() + shear * angle * angle.transpose());
      for (int a = 0; a < 2; ++a) {
        for (int b = 0; b < 2; ++b) {
          m(2 * (e + a), 2 * (e + b)) += problem.density * problem.height * mass(a, b);
          m(2 * (e + a) + 1, 2 * (e + b) + 1) +=
              problem.density * std::pow(problem.height, 3) / 12.0 * mass(a, b);
        }
        f(2 * (e + a)) += 0.5 * h * problem.load * problem.height;
      }
    }
    const int free = size - 2;
    const Eigen::MatrixXd held = k.bottomRightCorner(free, free);
    deflection = held.llt().solve(f.tail(free))(free - 2);
    angular_frequency =
        std::sqrt(test::symmetric_spectrum(held, m.bottomRightCorner(free, free)).values(0));
  }
};

TEST(CantileverSolution, AgreesWithElements) {
  for (const double length : {4.0, 10.0}) {
    const CantileverSolution solution(beam(length));
    const Elements elements(beam(length));
    EXPECT_NEAR(solution.angular_frequency(), elements.angular_frequency,
                2e-4 * elements.angular_frequency);
    EXPECT_NEAR(solution.static_deflection(), elements.deflection,
                2e-4 * std::abs(elements.deflection));
  }
}

TEST(CantileverSolution, OfASlenderBeamIsEulerAndBernoullis) {
  const double length = 500.0;
  const CantileverSolution solution(beam(length));
  const double stiffness = 1e9 / (1.0 - 0.09) / 12.0;
  const double expected = 1.875104 * 1.875104 / (length * length) * std::sqrt(stiffness / 2000.0);
  EXPECT_NEAR(solution.angular_frequency(), expected, 3e-5 * expected);
  EXPECT_NEAR(solution.static_deflection(), -1e3 * std::pow(length, 4) / (8.0 * stiffness),
              3e-5 * std::abs(solution.static_deflection()));
}

TEST(CantileverSolution, SwingsFromRestToTwiceTheStaticDeflection) {
  const CantileverSolution solution(beam(10.0));
  EXPECT_EQ(solution.deflection(0.0), 0.0);
  EXPECT_NEAR(solution.deflection(0.5 * solution.period()), 2.0 * solution.static_deflection(),
              1e-9);
  EXPECT_LT(solution.static_deflection(), 0.0) << "along the load";
}

}  // namespace
}  // namespace perifrac
