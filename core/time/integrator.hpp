#pragma once

#include <cstdint>
#include <span>
#include <string>

namespace perifrac {

/// What an integrator has done since it was made.
struct IntegratorStatistics {
  std::int64_t steps = 0;
  std::int64_t rejected_steps = 0;  ///< failed the error test
  std::int64_t rhs_evaluations = 0;
  std::int64_t newton_iterations = 0;
  std::int64_t newton_failures = 0;
  std::int64_t matrix_set_ups = 0;
  std::int64_t linear_iterations = 0;
};

/// Advances the unknowns of one OdeSystem.
class Integrator {
 public:
  virtual ~Integrator() = default;

  /// Starts from y at t [s] and forgets what came before: what follows is a function of (t, y)
  /// alone. Called first of all, and whenever y or the system was changed from outside; smooth
  /// inputs may go on changing in time without it. Throws NumericalError.
  virtual void reset(double t, std::span<const double> y) = 0;

  /// What drives y, or y itself, jumped at t [s]: steps after it may have to be short. Until the
  /// next jump; none is known at first.
  virtual void note_jump(double) {}

  /// Takes y, as reset or the last advance left it, to exactly t_end [s] in steps of its own.
  /// Throws NumericalError; y is then not to be used.
  virtual void advance(double t_end, std::span<double> y) = 0;

  /// Its steps build on those before: they would smear a rate that jumps.
  virtual bool is_multistep() const = 0;

  /// The longest step that stability lets it take [s], known after reset; infinity where there is
  /// no limit.
  virtual double longest_step() const = 0;

  /// How the systems of its steps are solved; empty: there are none.
  virtual std::string path() const { return {}; }

  virtual IntegratorStatistics statistics() const = 0;
};

}  // namespace perifrac
