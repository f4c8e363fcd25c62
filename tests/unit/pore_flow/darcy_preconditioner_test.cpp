#include "modules/pore_flow/darcy_preconditioner.hpp"

#include "tests/unit/pore_flow/newton_setting.hpp"

namespace perifrac {
namespace {

constexpr std::array gammas = {1e-3, 1.0, 1e4, 1e8};

template <int D>
void expect_volume_kept() {
  test::NewtonSetting<D> setting;
  DarcyPreconditioner<D> matrix(setting.system);
  EXPECT_FALSE(matrix.exact());
  const std::size_t size = setting.system.size();
  const std::vector<double> y(size, 0.0), r = test::random_values(size);
  std::vector<double> solution(size);
  for (const double gamma : gammas) {
    matrix.set_up(0.0, y, gamma);
    matrix.solve(r, solution);
    EXPECT_NEAR(setting.kept_volume(solution), setting.kept_volume(r), 1e-12) << gamma;
  }
}

TEST(DarcyPreconditioner, LosesNoVolume) {
  expect_volume_kept<2>();
  expect_volume_kept<3>();
}

/// What so many corrections by the preconditioner alone leave of r, in the mean of one.
template <int D>
double left_by_one(int edge, double gamma) {
  constexpr int corrections = 6;
  test::NewtonSetting<D> setting(edge, FlowScheme::bond);
  DarcyPreconditioner<D> matrix(setting.system);
  const std::size_t size = setting.system.size();
  const std::vector<double> y(size, 0.0);
  std::vector<double> r = test::random_values(size), solution(size, 0.0), step(size);
  std::fill(r.begin() + static_cast<std::ptrdiff_t>(setting.followed()), r.end(), 0.0);
  matrix.set_up(0.0, y, gamma);
  const auto error = [&](const std::vector<double>& left) {
    double sum = 0.0;
    for (Index i = 0; i < setting.system.points(); ++i) sum += left[i] * left[i];
    return std::sqrt(sum);
  };
  std::vector<double> left = setting.residual(r, solution, gamma);
  const double before = error(left);
  for (int k = 0; k < corrections; ++k) {
    matrix.solve(left, step);
    for (std::size_t n = 0; n < size; ++n) solution[n] += step[n];
    left = setting.residual(r, solution, gamma);
  }
  return std::pow(error(left) / before, 1.0 / corrections);
}

/// Alone it converges where the bonds' flow is the flow, however fast that is beside a step and
/// however many points there are.
TEST(DarcyPreconditioner, ConvergesByItselfOnBonds) {
  for (const double gamma : gammas) {
    EXPECT_LT(left_by_one<2>(12, gamma), 0.21) << gamma;
    EXPECT_LT(left_by_one<2>(60, gamma), 0.21) << gamma;
    EXPECT_LT(left_by_one<3>(12, gamma), 0.21) << gamma;
  }
}

}  // namespace
}  // namespace perifrac
