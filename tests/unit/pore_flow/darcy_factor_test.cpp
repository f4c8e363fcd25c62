#include "modules/pore_flow/darcy_factor.hpp"

#include "tests/unit/pore_flow/newton_setting.hpp"

namespace perifrac {
namespace {

template <int D>
void expect_inverse() {
  test::NewtonSetting<D> setting;
  DarcyFactor<D> matrix(setting.system);
  EXPECT_TRUE(matrix.exact());
  const double gamma = 0.02;
  const std::size_t size = setting.system.size();
  const std::vector<double> y(size, 0.0), r = test::random_values(size);
  std::vector<double> solution(size);
  matrix.set_up(0.0, y, gamma);
  matrix.solve(r, solution);
  for (const double left : setting.residual(r, solution, gamma)) EXPECT_NEAR(left, 0.0, 1e-12);
  EXPECT_NEAR(setting.kept_volume(solution), setting.kept_volume(r), 1e-12);
}

TEST(DarcyFactor, IsTheInverse) {
  expect_inverse<2>();
  expect_inverse<3>();
}

}  // namespace
}  // namespace perifrac
