#include "modules/pore_flow/darcy_system.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "core/base/errors.hpp"
#include "core/base/small_vector.hpp"
#include "core/bonds/bond_traversal.hpp"
#include "core/profile/profile.hpp"
#include "core/state/compensated_sum.hpp"
#include "core/time/spectral_radius.hpp"

namespace perifrac {

template <int D>
DarcySystem<D>::DarcySystem(std::unique_ptr<FlowOperator<D>> flow,
                            std::unique_ptr<PoreStorage> storage, PoreFluid fluid,
                            ScheduledVector face_pressures, ScheduledVector sources,
                            Eigen::VectorXd gravity, std::vector<HeldPoint> held)
    : flow_(std::move(flow)),
      storage_(std::move(storage)),
      fluid_(fluid),
      drive_(std::move(face_pressures), std::move(sources)),
      gravity_(std::move(gravity)),
      held_(std::move(held)),
      held_rate_(held_.size(), 0.0),
      points_(flow_->point_count()),
      face_potential_(drive_.faces()),
      potential_(flow_->size()),
      outflow_(flow_->size()),
      mobility_(fluid_.is_linear() ? 0 : points_) {
  taken_out_.resize(2 * accumulators());
  find_face_potential(0.0);
}

template <int D>
std::string DarcySystem<D>::place(std::size_t unknown) const {
  if (unknown < static_cast<std::size_t>(points_)) {
    return describe_point(unknown, flow_->place(static_cast<Index>(unknown)));
  }
  const std::size_t accumulated = unknown - points_;
  const std::size_t faces = face_potential_.size();
  if (accumulated < faces) return "the volume that came in through a face";
  if (accumulated == faces) return "the energy dissipated";
  if (smooths() && unknown + 1 == size()) return "the volume that smoothing made";
  return accumulated == faces + 1 ? "the energy brought" : "the volume of the sources";
}

template <int D>
void DarcySystem<D>::set_dilatation(const DilatationInput& input) {
  if (storage_->set_dilatation(input)) ++version_;
  is_answered_late_ = !input.slope.empty() && input.slope[0] != 0.0;
}

template <int D>
bool DarcySystem<D>::choose_storage(std::span<const double> slope) {
  if (!choice_) return false;
  std::unique_ptr<PoreStorage> chosen = choice_(slope);
  if (!chosen) return false;
  storage_ = std::move(chosen);
  choice_ = {};
  ++version_;
  ++pattern_version_;
  return true;
}

template <int D>
bool DarcySystem<D>::follow(const BondState<D>& bonds) {
  if (bond_version_ == bonds.version()) return false;
  const ProfileScope profiled("broken bonds");
  bond_version_ = bonds.version();
  flow_->follow(bonds);
  if (smoothing_) smoothing_->follow(bonds);
  storage_->take_bonds(bonds.broken());
  ++version_;
  ++pattern_version_;
  return true;
}

template <int D>
double DarcySystem<D>::held_pressure(double t, const HeldPoint& held) {
  if (held.face_value < 0) return 0.0;
  if (drive_.pressures_change()) find_face_potential(t);
  return fluid_.pressure_of(face_potential_[held.face_value] - gravity(held.point));
}

template <int D>
void DarcySystem<D>::lead_held_points(const TimeWindow& window, std::span<const double> y) {
  const std::span<const double> zeta = fluid_content(window.begin, y);
  for (std::size_t k = 0; k < held_.size(); ++k) {
    const auto [i, face_value] = held_[k];
    if (face_value < 0) {
      held_rate_[k] = exchange_.has_rate() ? exchange_.rate(i) : 0.0;
      continue;
    }
    const double content = storage_->content(window.end, i, held_pressure(window.end, held_[k]));
    const double handed_over = exchange_.is_beside() ? exchange_.added_beside(i) : 0.0;
    held_rate_[k] = (content - handed_over - zeta[i]) / window.length();
  }
}

template <int D>
void DarcySystem<D>::set_smoothing(PressureSmoothing<D> smoothing) {
  smoothing_ = std::move(smoothing);
  taken_out_.resize(2 * accumulators());
}

template <int D>
void DarcySystem<D>::smooth(double t, std::span<double> y) {
  // Of the potential: a mean of pressures would stir fluid that is at rest under its own weight.
  pressure(t, y, potential_);
  pressure_to_potential(t);
  const std::span<const double> smoothed = smoothing_->apply(potential_);
  const auto points = smoothing_->points();
  const std::span<const double> zeta = fluid_content(t, y);
  double made = 0.0;
  for (std::size_t k = 0; k < points.size(); ++k) {
    const Index i = points[k];
    const double p = fluid_.pressure_of(smoothed[k] - gravity(i));
    const double change = storage_->content(t, i, p) - zeta[i];
    y[i] += change;
    smoothing_->gained()[k] = volume()[i] * change;
    made += volume()[i] * change;
  }
  if (smoothing_->is_compensated()) {
    const std::span<const double> given = smoothing_->given();
    for (Index i = 0; i < points_; ++i) {
      y[i] -= given[i] / volume()[i];
      made -= given[i];
    }
  }
  y.back() += made;
}

template <int D>
std::span<const double> DarcySystem<D>::fluid_content(double t, std::span<const double> y) {
  if (!exchange_.is_beside()) return y.first(points_);
  return exchange_.content(t, y.first(points_));
}

template <int D>
double DarcySystem<D>::exchanged_energy(std::span<const double> p) const {
  double sum = 0.0;
  for (Index i = 0; i < points_; ++i) {
    const double potential = fluid_.potential(p[i]) + gravity(i);
    sum += volume()[i] * exchange_.added()[i] * potential;
  }
  return sum;
}

template <int D>
void DarcySystem<D>::pressure(double t, std::span<const double> y, std::span<double> p) {
  storage_->pressure(t, fluid_content(t, y), p);
  for (const HeldPoint& held : held_) p[held.point] = held_pressure(t, held);
}

template <int D>
std::span<const double> DarcySystem<D>::effective_storage(double t, std::span<const double> y) {
  return storage_->effective_storage(t, y.empty() ? y : fluid_content(t, y));
}

template <int D>
void DarcySystem<D>::find_face_potential(double t) {
  drive_.pressures_at(t, face_potential_);
  for (double& value : face_potential_) value = fluid_.potential(value);
  if (gravity_.size() > 0) face_potential_ += gravity_.tail(face_potential_.size());
}

/// Empty p: no pressure.
template <int D>
void DarcySystem<D>::scale_mobility(std::span<const double> p) {
  for_each_point(points_, [&](Index i) {
    const double ratio = p.empty() ? 1.0 : fluid_.density_ratio(p[i]);
    mobility_[i] = ratio * ratio;
  });
  flow_->scale_mobility(mobility_);
}

template <int D>
void DarcySystem<D>::pressure_to_potential(double t) {
  if (drive_.pressures_change()) find_face_potential(t);
  std::copy_n(face_potential_.data(), mirrored_faces(), potential_.begin() + points_);
  if (!fluid_.is_linear()) {
    scale_mobility(std::span(potential_).first(points_));
    for_each_point(points_, [&](Index i) { potential_[i] = fluid_.potential(potential_[i]); });
  }
  if (gravity_.size() > 0) {
    for (Index i = 0; i < points_; ++i) potential_[i] += gravity_[i];
  }
}

template <int D>
void DarcySystem<D>::rhs(double t, std::span<const double> y, std::span<double> dydt) {
  pressure(t, y, potential_);
  pressure_to_potential(t);
  flow_->apply(potential_, outflow_);
  const std::vector<double>& v = volume();
  for (Index i = 0; i < points_; ++i) dydt[i] = -outflow_[i] / v[i];

  const std::size_t faces = face_potential_.size();
  double dissipated = 0.0, brought = 0.0;
  for (std::size_t k = 0; k < potential_.size(); ++k) dissipated += potential_[k] * outflow_[k];
  const std::span<double> accumulated = dydt.subspan(points_);
  std::fill_n(accumulated.begin(), faces, 0.0);
  std::copy_n(outflow_.begin() + points_, mirrored_faces(), accumulated.begin());
  accumulated[faces] = dissipated;
  if (drive_.has_sources()) {
    if (brings_volume()) drive_.find_sources(t);
    const Eigen::VectorXd& rate = drive_.source_rate();
    for (Index i = 0; i < points_; ++i) {
      dydt[i] += rate[i] / v[i];
      brought += rate[i] * potential_[i];
    }
  }
  if (exchange_.has_rate()) {
    for (Index i = 0; i < points_; ++i) dydt[i] += exchange_.rate(i);
  }
  for (std::size_t k = 0; k < held_.size(); ++k) {
    const auto [i, face_value] = held_[k];
    if (face_value >= 0) accumulated[face_value] += v[i] * (held_rate_[k] - dydt[i]);
    dydt[i] = held_rate_[k];
  }
  if (drive_.pressures_change()) {
    for (std::size_t f = 0; f < faces; ++f) brought += face_potential_[f] * accumulated[f];
  }
  if (brings_energy()) accumulated[faces + 1] = brought;
  if (brings_volume()) accumulated[faces + 2] = drive_.source_rate().sum();
  if (smooths()) accumulated.back() = 0.0;
}

template <int D>
void DarcySystem<D>::jacobian_times(double t, std::span<const double> y, std::span<const double> v,
                                    std::span<double> product) {
  if (!fluid_.is_linear()) {
    // How the mobility follows the pressure is left out: Newton's method makes up for it.
    if (!y.empty()) pressure(t, y, potential_);
    scale_mobility(std::span(potential_).first(y.empty() ? 0 : points_));
  }
  storage_->pressure_change(t, y.empty() ? y : fluid_content(t, y), v, potential_,
                            PoreStorage::to_rounding);
  std::fill(potential_.begin() + points_, potential_.end(), 0.0);
  for (const HeldPoint& held : held_) potential_[held.point] = 0.0;
  flow_->apply(potential_, outflow_);
  for (Index i = 0; i < points_; ++i) product[i] = -outflow_[i] / volume()[i];
  // Energies follow the flow and nothing follows them: their rows may be left out.
  std::ranges::fill(product.subspan(points_), 0.0);
  std::copy_n(outflow_.begin() + points_, mirrored_faces(), product.begin() + points_);
  for (const auto& [i, face_value] : held_) {
    if (face_value >= 0) product[points_ + face_value] += outflow_[i];
    product[i] = 0.0;
  }
}

/// J is that of M dp/dt = -H p, M = volume d(zeta)/d(potential): both are symmetric. The bound has
/// a margin of two hundredths: solutions need not be better than that by far.
template <int D>
double DarcySystem<D>::fastest_rate(double t) {
  if (!flow_->is_symmetric()) return OdeSystem::fastest_rate(t);
  if (!fluid_.is_linear()) scale_mobility({});
  constexpr double tolerance = 1e-6;
  std::vector<double> change(points_);
  return symmetric_spectral_radius(
      name(), t, points_,
      [&](std::span<const double> p, std::span<double> outflow) {
        std::ranges::fill(potential_, 0.0);
        std::ranges::copy(p, potential_.begin());
        for (const HeldPoint& held : held_) potential_[held.point] = 0.0;
        flow_->apply(potential_, outflow_);
        std::copy_n(outflow_.begin(), points_, outflow.begin());
        for (const HeldPoint& held : held_) outflow[held.point] = 0.0;
      },
      [&](std::span<const double> content, std::span<double> p) {
        for (Index i = 0; i < points_; ++i) change[i] = content[i] / volume()[i];
        storage_->pressure_change(t, {}, change, p, tolerance);
      });
}

template <int D>
double DarcySystem<D>::jacobian_growth(double t, std::span<const double> y) {
  if (fluid_.is_linear()) return 1.0;
  // J = V^-1 H(mobility) / storage: a bound for each of the two factors.
  const std::span<const double> rest = effective_storage(t, {});
  const std::vector<double> at_rest(rest.begin(), rest.end());
  const std::span<const double> now = effective_storage(t, y);
  pressure(t, y, potential_);
  double of_storage = 0.0, of_mobility = 0.0;
  for (Index i = 0; i < points_; ++i) {
    const double ratio = fluid_.density_ratio(potential_[i]);
    of_storage = std::max(of_storage, at_rest[i] / now[i]);
    of_mobility = std::max(of_mobility, ratio * ratio);
  }
  return of_storage * of_mobility;
}

template <int D>
void DarcySystem<D>::magnitudes(double t, std::span<const double> y, std::span<double> magnitude) {
  // Where a run starts from no pressure at all: what strains the fluid by so little.
  constexpr double negligible = 1e-12;
  pressure(t, y, potential_);
  double largest = std::max(negligible * fluid_.bulk_modulus, drive_.largest_pressure());
  for (Index i = 0; i < points_; ++i) largest = std::max(largest, std::abs(potential_[i]));
  const std::span<const double> storage = effective_storage(t, y);
  for (Index i = 0; i < points_; ++i) magnitude[i] = storage[i] * largest;
  std::ranges::fill(magnitude.subspan(points_), std::numeric_limits<double>::infinity());
  for (const HeldPoint& held : held_) {
    magnitude[held.point] = std::numeric_limits<double>::infinity();
  }
}

template <int D>
void DarcySystem<D>::darcy_velocity(double t, std::span<const double> p,
                                    std::span<double> velocity) {
  std::ranges::copy(p, potential_.begin());
  pressure_to_potential(t);
  flow_->velocity(potential_, velocity);
  if (fluid_.is_linear()) return;
  for (std::size_t k = 0; k < velocity.size(); ++k) {
    velocity[k] /= fluid_.density_ratio(p[k % points_]);  // mass flux over rho_0 to volume
  }
}

template <int D>
void DarcySystem<D>::renew(std::span<double> y) {
  for (std::size_t k = 0; k < accumulators(); ++k) {
    add_compensated(taken_out_[2 * k], taken_out_[2 * k + 1], y[points_ + k]);
    y[points_ + k] = 0.0;
  }
  exchange_.merge_into(y);
}

template <int D>
void DarcySystem<D>::visit_state(StateVisitor& visitor) {
  visitor.visit("accumulated", taken_out_);
  exchange_.visit_state(visitor);
}

template <int D>
double DarcySystem<D>::gained_volume(double start, double t, std::span<const double> y) const {
  CompensatedSum sum;
  const auto add = [&](std::size_t k) {
    for (const double part : {taken_out_[2 * k], taken_out_[2 * k + 1], y[points_ + k]}) {
      sum.add(part);
    }
  };
  for (Index f = 0; f < faces(); ++f) add(f);
  if (brings_volume()) {
    add(faces() + 2);
  } else if (drive_.has_sources()) {
    sum.add((t - start) * drive_.source_rate().sum());
  }
  return sum.value();
}

template <int D>
double DarcySystem<D>::gained_energy(std::span<const double> y) const {
  double sum = brings_energy() ? accumulated(y, faces() + 1) : 0.0;
  if (drive_.pressures_change()) return sum;
  for (Index f = 0; f < faces(); ++f) sum += face_potential_[f] * accumulated(y, f);
  return sum;
}

template <int D>
double DarcySystem<D>::stored_energy(std::span<const double> zeta,
                                     std::span<const double> p) const {
  double sum = 0.0;
  for (Index i = 0; i < points_; ++i) {
    sum += volume()[i] * (storage_->energy(i, zeta[i], p[i]) + gravity(i) * zeta[i]);
  }
  return sum + storage_->energy_between_points(p);
}

template class DarcySystem<2>;
template class DarcySystem<3>;

}  // namespace perifrac
