#include "modules/solid/motion/elastic_dynamics.hpp"

#include <algorithm>
#include <utility>

#include <Eigen/Dense>

#include "core/base/block_sum.hpp"
#include "core/base/eigen_view.hpp"
#include "core/base/errors.hpp"
#include "core/profile/profile.hpp"

namespace perifrac {

namespace {

/// What moves the unknowns of a body of this density [kg/m^3].
template <int D>
LumpedMass lumped(const Body<D>& body, const SolidBoundary<D>& boundary, double density) {
  const auto mirror = boundary.mirror_condition(*body.family(boundary.mirrored()));
  const Index points = body.points().size();
  return {boundary.free_unknowns(mirror), D * points,
          [&](Index k) { return density * body.points().volume[k % points]; }};
}

}  // namespace

template <int D>
ElasticDynamics<D>::ElasticDynamics(const Body<D>& body,
                                    std::shared_ptr<ElasticOperator<D>> elastic,
                                    const SolidBoundary<D>& boundary, double density)
    : body_(body),
      elastic_(std::move(elastic)),
      memory_(with_memory(*elastic_)),
      prescribed_(elastic_->size()),
      loads_(elastic_->size()),
      moved_(lumped(body, boundary, density)),
      now_{.load = Eigen::VectorXd(elastic_->size()),
           .trial = std::vector<double>(elastic_->size())},
      inner_(elastic_->size()) {
  const auto mirror = boundary.mirror_condition(*body.family(boundary.mirrored()));
  prescribed_ = boundary.prescribed(mirror);
  loads_ = boundary.loads(
      mirror, [this](const Eigen::VectorXd& stress) { return elastic_->force_of_stress(stress); });
  const Eigen::SparseMatrix<double> free = boundary.free_unknowns(mirror);
  for (Index k = 0; k < moved_.unknowns(); ++k) {
    if (moved_.owner(k) == LumpedMass::plate_alone) plates_.add(k);
  }
  for (const auto& plate : boundary.plates(mirror)) {
    plate_unknowns_.push_back(
        static_cast<Index>(Eigen::SparseMatrix<double>::InnerIterator(free, plate.column).row()));
  }
  if (prescribed_.is_anything()) now_.prescribed = prescribed_.at(0.0);
  loads_.at(0.0, now_.load);
  initial_force_ = elastic_->initial_force();
  if (std::ranges::all_of(initial_force_, [](double f) { return f == 0.0; })) {
    initial_force_ = std::vector<double>();  // gives its memory back
  }
}

template <int D>
std::string ElasticDynamics<D>::place(std::size_t unknown) const {
  const Index point = moved_.first_moved(unknown) % body_.points().size();
  return describe_point(point, body_.points().at(point));
}

template <int D>
void ElasticDynamics<D>::set_pore_stress(const PoreStressInput& input) {
  if (!pore_stress_.set(input)) return;
  note_reference();
  plates_.forget();
}

/// The stiffness of reference is another one only if the slope in it is.
template <int D>
void ElasticDynamics<D>::note_reference() {
  if (pore_stress_.note_reference()) ++version_;
}

template <int D>
void ElasticDynamics<D>::force(double t, std::span<const double> y, std::span<double> force) {
  if (!prescribed_.is_constant()) prescribed_.at(t, now_.prescribed);
  if (!loads_.is_constant()) find_loads(t);
  pore_stress_.find(t);
  work_.leave(unknowns_);
  moved_.expand(y, view(std::as_const(now_.prescribed)), unknowns_);
  place_plates(view(std::as_const(now_.load)), pore_stress_.now().value, unknowns_);
  apply(unknowns_, pore_stress_.now(), inner_,
        pore_stress_.is_there() ? std::span(dilatation_) : std::span<double>());
  inner_is_elastic_ = !pore_stress_.is_there() && fracture_ == nullptr;
  if (fracture_ != nullptr) fracture_->add(t, unknowns_, inner_);
  work_.book(unknowns_, [&](Index k) {
    return moved_.owner(k) == LumpedMass::none ? inner_[k] : now_.load[k];
  });
  moved_.gather([&](Index k) { return now_.load[k] - inner_[k]; }, force);
}

/// The inner force, less what bears the initial stress from outside.
template <int D>
void ElasticDynamics<D>::apply(std::span<const double> u, const PoreStress& pore,
                               std::span<double> force, std::span<double> dilatation) {
  const ProfileScope profiled("bond forces");
  elastic_->apply(u, pore, force, dilatation);
  take_initial_force(force);
}

template <int D>
void ElasticDynamics<D>::apply_small(std::span<const double> u, const PoreStress& pore,
                                     std::span<double> force, std::span<double> dilatation) {
  const ProfileScope profiled("bond forces");
  elastic_->apply_small(u, pore, force, dilatation);
  take_initial_force(force);
}

template <int D>
void ElasticDynamics<D>::take_initial_force(std::span<double> force) const {
  if (initial_force_.empty()) return;
  for_each_entry(static_cast<Index>(force.size()), [&](Index k) { force[k] -= initial_force_[k]; });
}

template <int D>
void ElasticDynamics<D>::stiffness_times(std::span<const double> v, std::span<double> product) {
  moved_.expand(v, {}, now_.trial);
  place_plates({}, {}, now_.trial);
  inner_is_elastic_ = false;
  apply_small(now_.trial, pore_stress_.reference(), inner_, {});
  moved_.gather([&](Index k) { return inner_[k]; }, product);
}

template <int D>
void ElasticDynamics<D>::place_plates(std::span<const double> load,
                                      std::span<const double> pore_stress,
                                      std::vector<double>& unknowns) {
  const std::vector<double>& volume = body_.points().volume;
  const auto apply_alone = [&](std::span<const double> u, std::span<double> force,
                               std::span<double> pore_volume) {
    apply_small(u, pore_stress_.at_rest(), force, pore_volume);
    for (std::size_t i = 0; i < volume.size(); ++i) {
      pore_volume[i] *= elastic_->pore_sign() * volume[i];
    }
  };
  plates_.place(load, pore_stress, volume.size(), apply_alone, unknowns);
}

template <int D>
void ElasticDynamics<D>::set_interface_force(std::span<const double> force) {
  interface_force_ = force;
  if (loads_.is_constant()) find_loads(0.0);
}

template <int D>
void ElasticDynamics<D>::find_loads(double t) {
  loads_.at(t, now_.load);
  for (std::size_t k = 0; k < interface_force_.size(); ++k) now_.load[k] += interface_force_[k];
}

template <int D>
std::vector<Index> ElasticDynamics<D>::acted_on(bool by_interface) const {
  std::vector<Index> unknowns;
  const Index points = D * body_.points().size();
  for (Index k = 0; k < moved_.unknowns(); ++k) {
    const bool is_held = moved_.owner(k) == LumpedMass::none;
    if ((by_interface && k < points) || is_held || loads_.has(k)) unknowns.push_back(k);
  }
  return unknowns;
}

template <int D>
void ElasticDynamics<D>::start() {
  unknowns_.assign(moved_.unknowns(), 0.0);
  if (memory_ != nullptr) memory_->forget();
  inner_is_elastic_ = false;
  work_.start(acted_on(false));
  pore_stress_.start();
  dilatation_.assign(body_.points().size(), 0.0);
}

template <int D>
void ElasticDynamics<D>::visit_state(StateVisitor& visitor) {
  visitor.visit("displacement", unknowns_);
  if (memory_ != nullptr) memory_->visit_state(visitor);
  work_.visit_state(visitor);
  pore_stress_.visit_state(visitor);
}

/// The step ends with the force of the bonds that it began with, and the next one begins without
/// those that broke: so no energy is lost but what they held.
template <int D>
bool ElasticDynamics<D>::changes() {
  if (fracture_ == nullptr || !fracture_->breaks(unknowns_)) return false;
  plates_.forget();
  return true;
}

template <int D>
void ElasticDynamics<D>::derive() {
  if (fracture_ != nullptr) {
    fracture_->follow_state();
    plates_.forget();
  }
  apply(unknowns_, {}, inner_, pore_stress_.is_there() ? dilatation_ : std::span<double>());
  inner_is_elastic_ = false;
}

template <int D>
std::span<double> ElasticDynamics<D>::dilatation() {
  if (!pore_stress_.is_there()) apply(unknowns_, {}, inner_, dilatation_);
  return dilatation_;
}

template <int D>
double ElasticDynamics<D>::elastic_energy() {
  if (!inner_is_elastic_) apply(unknowns_, {}, inner_, {});
  return elastic_->energy(unknowns_, inner_);
}

template <int D>
void ElasticDynamics<D>::point_velocity(double t, double step, std::span<const double> velocity,
                                        std::span<double> result) {
  for (std::size_t k = 0; k < result.size(); ++k) {
    const Index owner = moved_.owner(static_cast<Index>(k));
    result[k] = owner >= 0 ? velocity[owner] : 0.0;
  }
  if (prescribed_.is_constant()) return;
  Eigen::VectorXd now(now_.prescribed.size()), before(now.size());
  prescribed_.at(t, now);
  prescribed_.at(t - step, before);
  for (std::size_t k = 0; k < result.size(); ++k) result[k] += (now[k] - before[k]) / step;
}

template class ElasticDynamics<2>;
template class ElasticDynamics<3>;

}  // namespace perifrac
