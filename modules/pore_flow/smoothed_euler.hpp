#pragma once

#include <cstdint>

#include "core/time/equal_steps.hpp"
#include "core/time/forward_euler.hpp"
#include "modules/pore_flow/darcy_system.hpp"

namespace perifrac {

/// Forward Euler that smooths the pressures after every step, which no rate could express.
template <int D>
class SmoothedEuler final : public Integrator {
 public:
  SmoothedEuler(DarcySystem<D>& system, double safety) : system_(system), euler_(system, safety) {}

  void reset(double t, std::span<const double> y) override {
    euler_.reset(t, y);
    t_ = t;
  }

  void advance(double t_end, std::span<double> y) override {
    const double begin = t_, length = t_end - begin;
    const std::int64_t steps = equal_steps(length, euler_.longest_step());
    for (std::int64_t n = 1; n <= steps; ++n) {
      t_ =
          n == steps ? t_end : begin + static_cast<double>(n) / static_cast<double>(steps) * length;
      euler_.advance(t_, y);
      system_.smooth(t_, y);
    }
  }

  bool is_multistep() const override { return false; }
  double longest_step() const override { return euler_.longest_step(); }
  IntegratorStatistics statistics() const override { return euler_.statistics(); }

 private:
  DarcySystem<D>& system_;
  double t_ = 0.0;
  ForwardEuler euler_;
};

}  // namespace perifrac
