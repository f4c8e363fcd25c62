#include "core/time/velocity_verlet.hpp"

#include <algorithm>
#include <cmath>

#include "core/base/block_sum.hpp"
#include "core/base/errors.hpp"
#include "core/state/all_finite.hpp"
#include "core/time/equal_steps.hpp"
#include "core/time/spectral_radius.hpp"

namespace perifrac {

VelocityVerlet::VelocityVerlet(SecondOrderSystem& system, double damping, double safety)
    : system_(system), damping_(damping), safety_(safety) {}

void VelocityVerlet::evaluate(double t, Motion& motion) {
  motion.acceleration.resize(motion.position.size());
  system_.force(t, motion.position, motion.acceleration);
  const double* const mass = system_.mass().data();
  double* const a = motion.acceleration.data();
  for_each_entry(static_cast<Index>(motion.acceleration.size()), [=](Index i) { a[i] /= mass[i]; });
}

void VelocityVerlet::advance(double begin, double end, Motion& motion) {
  if (end == begin) return;
  for (double t = begin; t < end;) {  // once, unless the stiffness changes on the way
    const double first = t, growth = system_.stiffness_growth();
    const std::int64_t steps = equal_steps(end - first, longest_step(first));
    const double length = (end - first) / static_cast<double>(steps);
    for (std::int64_t n = 1; n <= steps && system_.stiffness_growth() == growth; ++n) {
      t = n == steps ? end : first + static_cast<double>(n) * length;
      step(t, length, motion);
      ++steps_;
    }
  }
  if (all_finite(motion.position)) return;
  const auto bad =
      std::ranges::find_if_not(motion.position, [](double x) { return std::isfinite(x); });
  throw NumericalError(std::string(system_.name()), system_.place(bad - motion.position.begin()),
                       end, "a value is not finite");
}

/// One step of `length` that ends at t.
void VelocityVerlet::step(double t, double length, Motion& motion) {
  const double factor = std::exp(-0.5 * damping_ * length);
  damp(factor, motion);
  system_.begin_step(length, motion.velocity);
  const auto count = static_cast<Index>(motion.position.size());
  const double half = 0.5 * length;
  const double* const mass = system_.mass().data();
  double* const y = motion.position.data();
  double* const v = motion.velocity.data();
  double* const a = motion.acceleration.data();
  for_each_entry(count, [=](Index i) {
    v[i] += half * a[i];
    y[i] += length * v[i];
  });
  system_.force(t, motion.position, motion.acceleration);
  for_each_entry(count, [=](Index i) {
    a[i] /= mass[i];
    v[i] += half * a[i];
  });
  system_.end_step(length, motion.velocity);
  damp(factor, motion);
  if (system_.changes()) evaluate(t, motion);
}

void VelocityVerlet::damp(double factor, Motion& motion) {
  if (damping_ == 0.0) return;
  const double* const mass = system_.mass().data();
  double* const v = motion.velocity.data();
  const double before =
      block_sum(static_cast<Index>(motion.velocity.size()), block_sums_, [=](Index i) {
        const double energy = 0.5 * mass[i] * v[i] * v[i];
        v[i] *= factor;
        return energy;
      });
  motion.damped_energy += (1.0 - factor * factor) * before;
}

double VelocityVerlet::stable_step(double t) {
  if (limit_version_ != system_.stiffness_version()) {
    const double largest =
        symmetric_spectral_radius(system_.name(), t, system_.mass(),
                                  [&](std::span<const double> v, std::span<double> product) {
                                    system_.stiffness_times(v, product);
                                  });
    stable_step_ = 2.0 / std::sqrt(largest);  // infinity where nothing pulls back
    limit_version_ = system_.stiffness_version();
  }
  return stable_step_ / std::sqrt(system_.stiffness_growth());
}

double kinetic_energy(std::span<const double> mass, std::span<const double> velocity) {
  double sum = 0.0;
  for (std::size_t i = 0; i < mass.size(); ++i) sum += 0.5 * mass[i] * velocity[i] * velocity[i];
  return sum;
}

}  // namespace perifrac
