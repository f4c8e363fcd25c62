#pragma once

#include <limits>
#include <optional>
#include <vector>

#include "core/time/integrator.hpp"
#include "core/time/ode_system.hpp"

namespace perifrac {

/// y <- y + h f(t + h, y) in equal sub-steps, for systems whose J has real eigenvalues <= 0
/// (diffusion). Inputs of f, which may follow what y did to others, are those of the sub-step's
/// end. The stable limit is 2 / |largest eigenvalue|.
///
/// Near the limit the fastest modes change sign with every step: after a jump, which is made of
/// them, a solution would swing. Steps then begin at an eighth of the longest and grow with the
/// time since, to half of it at most in each, as the modes that are left grow slower: some five
/// more steps a jump.
class ForwardEuler final : public Integrator {
 public:
  /// The system must outlive the integrator. A sub-step is at most safety (0 to 1) times the
  /// stable limit.
  explicit ForwardEuler(OdeSystem& system, double safety = 0.9);

  void reset(double t, std::span<const double> y) override;
  void advance(double t_end, std::span<double> y) override;
  void note_jump(double t) override { jump_ = t; }
  bool is_multistep() const override { return false; }
  double longest_step() const override { return safety_ * stable_step_; }
  /// 2 / |largest eigenvalue of J| [s].
  double stable_step() const { return stable_step_; }
  IntegratorStatistics statistics() const override { return statistics_; }

 private:
  double limit_at(double t, double growth) const;
  std::int64_t steps_over(double length, double limit) const;

  OdeSystem& system_;
  double safety_;
  double t_ = 0.0;
  double jump_ = -std::numeric_limits<double>::infinity();  ///< time of the last one
  double stable_step_ = std::numeric_limits<double>::infinity();
  std::optional<std::uint64_t> limit_version_;  // the J that stable_step_ belongs to
  std::vector<double> rate_;
  std::vector<double> lost_;  ///< to rounding, by accumulator: they add up very many steps
  IntegratorStatistics statistics_;
};

}  // namespace perifrac
