#include "modules/pore_flow/darcy_system.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "core/errors.hpp"

namespace perifrac {

template <int D>
DarcySystem<D>::DarcySystem(std::unique_ptr<FlowOperator<D>> flow, PoreMaterial material,
                            Eigen::VectorXd face_pressures, Eigen::VectorXd sources,
                            std::vector<HeldPoint> held)
    : flow_(std::move(flow)),
      material_(material),
      face_pressures_(std::move(face_pressures)),
      sources_(std::move(sources)),
      held_(std::move(held)),
      held_rate_(held_.size(), 0.0),
      points_(flow_->family().point_count),
      effective_storage_(points_, material.storage),
      pressure_(flow_->size()),
      outflow_(flow_->size()) {}

template <int D>
std::string DarcySystem<D>::place(std::size_t unknown) const {
  if (unknown < static_cast<std::size_t>(points_)) {
    Vector<D> position;
    for (int a = 0; a < D; ++a) position[a] = flow_->family().position[a][unknown];
    return describe_point(unknown, position);
  }
  const std::size_t accumulated = unknown - points_;
  const std::size_t faces = face_pressures_.size();
  if (accumulated < faces) return "the volume that came in through a face";
  if (accumulated == faces) return "the energy dissipated";
  return smooths() && unknown + 1 == size() ? "the volume that smoothing made"
                                            : "the energy of the sources";
}

template <int D>
void DarcySystem<D>::set_dilatation(const DilatationInput& input) {
  dilatation_ = input;
  const double alpha = material_.biot_coefficient;
  bool changed = false;
  for (std::size_t i = 0; i < input.slope.size(); ++i) {
    const double storage = material_.storage + alpha * alpha * input.slope[i];
    changed = changed || storage != effective_storage_[i];
    effective_storage_[i] = storage;
  }
  if (changed) ++version_;
}

template <int D>
double DarcySystem<D>::dilated(double t, Index i) const {
  return material_.biot_coefficient *
         (dilatation_.value[i] + (t - dilatation_.end) * dilatation_.rate[i]);
}

template <int D>
void DarcySystem<D>::lead_held_points(const TimeWindow& window, std::span<const double> y) {
  for (std::size_t k = 0; k < held_.size(); ++k) {
    const Index i = held_[k].point;
    if (held_[k].face_value < 0) continue;  // dry
    double content = effective_storage_[i] * held_pressure(held_[k]);
    if (!dilatation_.value.empty()) content += dilated(window.end, i);
    held_rate_[k] = (content - y[i]) / window.length();
  }
}

template <int D>
void DarcySystem<D>::set_smoothing(PressureSmoothing<D> smoothing) {
  smoothing_ = std::move(smoothing);
  smoothed_.resize(smoothing_->points().size());
}

template <int D>
void DarcySystem<D>::smooth(double t, std::span<double> y) {
  pressure(t, y, pressure_);
  std::copy_n(face_pressures_.data(), mirrored_faces(), pressure_.begin() + points_);
  smoothing_->apply(pressure_, smoothed_);
  const auto points = smoothing_->points();
  double made = 0.0;
  for (std::size_t k = 0; k < points.size(); ++k) {
    const Index i = points[k];
    const double change = effective_storage_[i] * (smoothed_[k] - pressure_[i]);
    y[i] += change;
    made += volume()[i] * change;
  }
  y.back() += made;
}

template <int D>
void DarcySystem<D>::pressure(double t, std::span<const double> y, std::span<double> p) const {
  if (dilatation_.value.empty()) {
    for (Index i = 0; i < points_; ++i) p[i] = y[i] / effective_storage_[i];
  } else {
    for (Index i = 0; i < points_; ++i) p[i] = (y[i] - dilated(t, i)) / effective_storage_[i];
  }
  for (const HeldPoint& held : held_) p[held.point] = held_pressure(held);
}

template <int D>
void DarcySystem<D>::rhs(double t, std::span<const double> y, std::span<double> dydt) {
  pressure(t, y, pressure_);
  const auto faces = face_pressures_.size();
  std::copy_n(face_pressures_.data(), mirrored_faces(), pressure_.begin() + points_);
  flow_->apply(pressure_, outflow_);
  const std::vector<double>& v = volume();
  for (Index i = 0; i < points_; ++i) dydt[i] = -outflow_[i] / v[i];

  double dissipated = 0.0;
  for (std::size_t k = 0; k < pressure_.size(); ++k) dissipated += pressure_[k] * outflow_[k];
  const std::span<double> accumulated = dydt.subspan(points_);
  std::fill_n(accumulated.begin(), faces, 0.0);
  std::copy_n(outflow_.begin() + points_, mirrored_faces(), accumulated.begin());
  accumulated[faces] = dissipated;
  if (sources_.size() > 0) {
    double brought = 0.0;
    for (Index i = 0; i < points_; ++i) {
      dydt[i] += sources_[i] / v[i];
      brought += sources_[i] * pressure_[i];
    }
    accumulated[faces + 1] = brought;
  }
  if (smoothing_) dydt.back() = 0.0;
  for (std::size_t k = 0; k < held_.size(); ++k) {
    const auto [i, face_value] = held_[k];
    if (face_value >= 0) accumulated[face_value] += v[i] * (held_rate_[k] - dydt[i]);
    dydt[i] = held_rate_[k];
  }
}

template <int D>
void DarcySystem<D>::jacobian_times(double, std::span<const double>, std::span<const double> v,
                                    std::span<double> product) {
  for (Index i = 0; i < points_; ++i) pressure_[i] = v[i] / effective_storage_[i];
  std::fill(pressure_.begin() + points_, pressure_.end(), 0.0);
  for (const HeldPoint& held : held_) pressure_[held.point] = 0.0;
  flow_->apply(pressure_, outflow_);
  for (Index i = 0; i < points_; ++i) product[i] = -outflow_[i] / volume()[i];
  // Energies follow the flow and nothing follows them: their rows may be left out.
  std::ranges::fill(product.subspan(points_), 0.0);
  std::copy_n(outflow_.begin() + points_, mirrored_faces(), product.begin() + points_);
  for (const auto& [i, face_value] : held_) {
    if (face_value >= 0) product[points_ + face_value] += outflow_[i];
    product[i] = 0.0;
  }
}

template <int D>
void DarcySystem<D>::magnitudes(double t, std::span<const double> y, std::span<double> magnitude) {
  constexpr double negligible = 1e-3;  // [Pa], where a run starts from no pressure at all
  pressure(t, y, pressure_);
  double largest = negligible;
  for (Index i = 0; i < points_; ++i) largest = std::max(largest, std::abs(pressure_[i]));
  for (const double p : face_pressures_) largest = std::max(largest, std::abs(p));
  for (Index i = 0; i < points_; ++i) magnitude[i] = effective_storage_[i] * largest;
  std::ranges::fill(magnitude.subspan(points_), std::numeric_limits<double>::infinity());
  for (const HeldPoint& held : held_) {
    magnitude[held.point] = std::numeric_limits<double>::infinity();
  }
}

template <int D>
void DarcySystem<D>::darcy_velocity(std::span<const double> p, std::span<double> velocity) {
  std::ranges::copy(p, pressure_.begin());
  std::copy_n(face_pressures_.data(), mirrored_faces(), pressure_.begin() + points_);
  flow_->velocity(pressure_, velocity);
}

template class DarcySystem<2>;
template class DarcySystem<3>;

}  // namespace perifrac
