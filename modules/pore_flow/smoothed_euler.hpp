#pragma once

#include <algorithm>
#include <cmath>

#include "core/time/forward_euler.hpp"
#include "modules/pore_flow/darcy_system.hpp"

namespace perifrac {

/// Forward Euler that smooths the pressures after every step, which no rate could express.
template <int D>
class SmoothedEuler final : public Integrator {
 public:
  SmoothedEuler(DarcySystem<D>& system, double safety)
      : system_(system), safety_(safety), euler_(system, safety) {}

  void reset(double t, std::span<const double> y) override {
    euler_.reset(t, y);
    t_ = t;
  }

  void advance(double t_end, std::span<double> y) override {
    const double begin = t_, length = t_end - begin;
    // A little more than enough, so that none of the steps is divided again.
    const double steps =
        std::max(1.0, std::ceil(length / (safety_ * euler_.stable_step()) * (1.0 + 1e-9)));
    for (double n = 1.0; n <= steps; ++n) {
      t_ = n == steps ? t_end : begin + n / steps * length;
      euler_.advance(t_, y);
      system_.smooth(t_, y);
    }
  }

  double stable_step() const override { return euler_.stable_step(); }
  IntegratorStatistics statistics() const override { return euler_.statistics(); }

 private:
  DarcySystem<D>& system_;
  double safety_;
  double t_ = 0.0;
  ForwardEuler euler_;
};

}  // namespace perifrac
