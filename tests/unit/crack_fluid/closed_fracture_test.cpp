#include <numbers>

#include <gtest/gtest.h>

#include "core/state/snapshot.hpp"
#include "tests/unit/crack_fluid/crack_run.hpp"

namespace perifrac {
namespace {

using namespace test;

/// A straight crack in an infinite plane under a confining stress, whose faces do not overlap.
class ConfinedCrack {
 public:
  ConfinedCrack(int facets, double plane_strain_modulus, double confining)
      : stiffness_(facets, facets), is_open_(facets, 1), confining_(confining) {
    for (int i = 0; i < facets; ++i) {
      for (int j = 0; j < facets; ++j) {
        const double x = (i - j) * dx;
        stiffness_(i, j) =
            -plane_strain_modulus * dx / (4.0 * std::numbers::pi * (x * x - 0.25 * dx * dx));
      }
    }
  }

  /// What the fluid module is told: how facets would open that may overlap.
  Eigen::MatrixXd compliance() const { return stiffness_.inverse(); }

  /// Finds which facets are open under the pressures, and how wide they are.
  void solve(std::span<const double> pressure) {
    const int n = static_cast<int>(is_open_.size());
    for (int pass = 0; pass < 100; ++pass) {
      Eigen::MatrixXd matrix = stiffness_;
      Eigen::VectorXd load(n);
      for (int i = 0; i < n; ++i) {
        load[i] = is_open_[i] ? pressure[i] - confining_ : 0.0;
        if (is_open_[i]) continue;
        matrix.row(i).setZero();
        matrix(i, i) = stiffness_(i, i);
      }
      opening = matrix.partialPivLu().solve(load);
      const Eigen::VectorXd carried = stiffness_ * opening;
      bool changed = false;
      for (int i = 0; i < n; ++i) {
        const bool opens = is_open_[i] ? opening[i] >= 0.0 : pressure[i] - confining_ > carried[i];
        changed = changed || opens != bool(is_open_[i]);
        is_open_[i] = opens;
      }
      if (!changed) return;
    }
    ADD_FAILURE() << "contact";
  }

  Eigen::VectorXd opening;

 private:
  Eigen::MatrixXd stiffness_;
  std::vector<char> is_open_;
  double confining_;
};

struct ConfinedRun {
  static constexpr int n = 81;
  static constexpr double confining = 3e6;

  CrackRun run;
  ConfinedCrack rock{n, 4e9, confining};
  Eigen::MatrixXd slope = rock.compliance();
  std::vector<double> pressure;

  explicit ConfinedRun(std::vector<CrackInlet> inlets) : run(liquid(), std::move(inlets)) {
    run.add_line(straight_line({0.0, 0.0}, 0.0, dx, n));
  }
  static CrackLiquid liquid() {
    CrackLiquid liquid = water;
    liquid.residual_aperture = 2e-6;
    return liquid;
  }

  void advance(const TimeWindow& window) {
    const PortView view = run.port("free_crack_opening");
    const Eigen::VectorXd value = slope * Eigen::VectorXd::Constant(n, -confining);
    std::copy_n(value.data(), n, view.value.begin());
    Eigen::Map<Eigen::Matrix<double, -1, -1, Eigen::RowMajor>>(view.slope.data(), n, n) = slope;
    run.module().advance(window);
    pressure = run.values("crack_pressure");
  }
};

/// Stiff fluid pushes a closed crack open, front and opening ahead of each other by turns; then it
/// comes to rest. Its facets are as wide as the rock says that they are.
TEST(ClosedFracture, OpensAsFarAsContactLetsIt) {
  const double rate = 1e-4, pumped = 0.02, window = 5e-4;
  ConfinedRun both({rate_inlet({0.5 * ConfinedRun::n * dx, 0.0}, rate,
                               Schedule::table({pumped, pumped + 1e-9}, {1.0, 0.0}))});
  double wetted = 0.0;
  for (int k = 0; k < 40; ++k) {
    both.advance({k * window, (k + 1) * window});
    EXPECT_LT(both.run.mass_error(), 1e-14);
    EXPECT_GE(both.run.scalar("wetted_length"), wetted);
    wetted = both.run.scalar("wetted_length");
    both.rock.solve(both.pressure);
    const double least = ConfinedRun::liquid().residual_aperture;
    const double volume = dx * both.rock.opening.cwiseMax(least).sum();
    EXPECT_NEAR(both.run.scalar("crack_volume"), volume, 1e-9 * volume) << k;
  }
  EXPECT_GT(both.pressure[ConfinedRun::n / 2], ConfinedRun::confining);
  for (int k = 0; k < 10; ++k) {
    both.advance({pumped + k * pumped, pumped + (k + 1) * pumped});
  }
  // All open: the pressure at which the crack holds what was pumped.
  const CrackLiquid liquid = ConfinedRun::liquid();
  const double p = both.pressure[0];
  EXPECT_NEAR(both.pressure[ConfinedRun::n / 2], p, 1e-6 * p);
  const double volume = both.slope.sum() * (p - ConfinedRun::confining) * dx;
  EXPECT_NEAR(liquid.density_at(p) * volume, liquid.density * (rate * pumped + 0.5e-9 * rate),
              1e-5 * liquid.density * rate * pumped);
}

}  // namespace
}  // namespace perifrac
