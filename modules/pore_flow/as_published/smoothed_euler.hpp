#pragma once

#include <cstdint>
#include <functional>
#include <span>
#include <utility>

#include "core/time/equal_steps.hpp"
#include "core/time/forward_euler.hpp"

namespace perifrac {

/// Forward Euler that smooths the pressures after every step, which no rate could express.
class SmoothedEuler final : public Integrator {
 public:
  /// Smooths the state y that was reached at time t [s].
  using Smooth = std::function<void(double t, std::span<double> y)>;

  SmoothedEuler(OdeSystem& system, double safety, Smooth smooth)
      : euler_(system, safety), smooth_(std::move(smooth)) {}

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
      smooth_(t_, y);
    }
  }

  bool is_multistep() const override { return false; }
  double longest_step() const override { return euler_.longest_step(); }
  IntegratorStatistics statistics() const override { return euler_.statistics(); }

 private:
  double t_ = 0.0;
  ForwardEuler euler_;
  Smooth smooth_;
};

}  // namespace perifrac
