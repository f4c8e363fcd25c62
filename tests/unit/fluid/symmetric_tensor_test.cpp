#include "modules/fluid/points/symmetric_tensor.hpp"

#include <random>

#include <gtest/gtest.h>

#include "core/solvers/symmetric_spectrum.hpp"
#include "tests/orthonormal.hpp"

namespace perifrac {
namespace {

template <int D>
using Matrix = Eigen::Matrix<double, D, D>;

template <int D>
SymmetricTensor<D> tensor(const Matrix<D>& m) {
  SymmetricTensor<D> t;
  for (int a = 0; a < D; ++a) {
    for (int b = a; b < D; ++b) t[symmetric_index<D>(a, b)] = m(a, b);
  }
  return t;
}

template <int D>
Matrix<D> matrix(const SymmetricTensor<D>& t) {
  Matrix<D> m;
  for (int a = 0; a < D; ++a) {
    for (int b = 0; b < D; ++b) m(a, b) = t[symmetric_index<D>(std::min(a, b), std::max(a, b))];
  }
  return m;
}

/// Q diag(values) Q^T with a random rotation Q.
template <int D>
Matrix<D> with_eigenvalues(const Eigen::Matrix<double, D, 1>& values, std::mt19937& bits) {
  std::normal_distribution<double> normal;
  Matrix<D> random;
  for (int k = 0; k < D * D; ++k) random(k) = normal(bits);
  const Matrix<D> rotation = test::orthonormal<D>(random);
  const Matrix<D> m = rotation * values.asDiagonal() * rotation.transpose();
  return 0.5 * (m + m.transpose());
}

template <int D>
class SymmetricTensors : public testing::Test {
 protected:
  void check(const Matrix<D>& m, double least) const {
    const SymmetricTensor<D> t = tensor<D>(m);
    const double size = m.norm();
    EXPECT_NEAR(trace<D>(t), m.trace(), 1e-15 * size);
    // Two equal eigenvalues cost half the digits (acos near -1).
    EXPECT_NEAR(least_eigenvalue<D>(t), least, 2e-8 * size);
    EXPECT_LE(least_eigenvalue_bound<D>(t), least + 1e-14 * size);
    EXPECT_NEAR(least_eigenvalue<D>(t), symmetric_spectrum(m).values[0], 2e-8 * size);
    if (std::abs(least) < 1e-3 * size) return;
    EXPECT_NEAR((matrix<D>(inverse<D>(t)) * m - Matrix<D>::Identity()).norm(), 0.0, 1e-10);
  }

  void check_all() const {
    std::mt19937 bits(7);
    std::uniform_real_distribution<double> value(0.1, 3.0);
    for (int n = 0; n < 200; ++n) {
      Eigen::Matrix<double, D, 1> values;
      for (int a = 0; a < D; ++a) values[a] = value(bits);
      std::sort(values.begin(), values.end());
      check(with_eigenvalues<D>(values, bits), values[0]);
      values[D - 1] = values[D - 2];  // twice the same
      check(with_eigenvalues<D>(values, bits), values[0]);
      values[0] = 0.0;  // points on a line or in a plane
      check(with_eigenvalues<D>(values, bits), 0.0);
    }
    check(2.5 * Matrix<D>::Identity(), 2.5);
    EXPECT_EQ(least_eigenvalue<D>(SymmetricTensor<D>{}), 0.0);
  }
};

class SymmetricTensors2D : public SymmetricTensors<2> {};
class SymmetricTensors3D : public SymmetricTensors<3> {};

TEST_F(SymmetricTensors2D, InverseAndLeastEigenvalue) { check_all(); }
TEST_F(SymmetricTensors3D, InverseAndLeastEigenvalue) { check_all(); }

TEST(SymmetricTensorIndex, GoesThroughTheUpperTriangle) {
  int k = 0;
  for (int a = 0; a < 3; ++a) {
    for (int b = a; b < 3; ++b) EXPECT_EQ(symmetric_index<3>(a, b), k++);
  }
  EXPECT_EQ(k, symmetric_size<3>);
}

}  // namespace
}  // namespace perifrac
