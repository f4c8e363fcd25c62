#pragma once

#include <memory>
#include <string>
#include <vector>

#include "core/config/key.hpp"
#include "core/config/section.hpp"

namespace perifrac {

/// A factor that changes with time and multiplies what a scene prescribes (a load, a pressure, a
/// flux): constant 1, a ramp from 0, a table, linear in between and constant beyond its ends, or
/// growth in proportion to time.
class Schedule {
 public:
  Schedule() = default;
  static Schedule ramp(double duration);  ///< from 0 at t = 0 to 1 at `duration` [s]
  /// `times` [s] rise strictly; as many factors.
  static Schedule table(std::vector<double> times, std::vector<double> factors);
  static Schedule growth(double rate);  ///< rate [1/s] times t, without end

  /// Multiplies it by a factor that somebody may change between windows.
  void follow(std::shared_ptr<const double> given) { given_ = std::move(given); }

  double factor(double t) const;                    ///< t [s]
  double integral(double begin, double end) const;  ///< of the factor, exact [s]
  bool is_constant() const { return times_.empty() && !given_; }
  /// Where the factor's rate changes, rising [s]: no step of an integrator should go across.
  const std::vector<double>& break_points() const { return times_; }

 private:
  double written_factor(double t) const;

  std::vector<double> times_;
  std::vector<double> factors_;
  double rate_ = 0.0;                    ///< growth beside the table's [1/s]
  std::shared_ptr<const double> given_;  ///< null: none
};

/// The keys of a schedule beside what it multiplies: `<prefix>schedule.ramp` and so on, where
/// `prefix` is as `boundary.*.`.
KeyTable schedule_keys(const std::string& prefix);

/// Reads `<path>.schedule`, constant where it is left out, and follows the factor that the scene
/// was given for `<path>` (Section::with_given). Throws InputError.
Schedule read_schedule(const Section& section, const std::string& path);

/// The same where the schedule's own path is `at`.
Schedule read_schedule_at(const Section& section, const std::string& at);

}  // namespace perifrac
