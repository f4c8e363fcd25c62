#include "modules/solid/motion/elastic_dynamics.hpp"

#include <algorithm>

#include <Eigen/Dense>

#include "core/base/block_sum.hpp"
#include "core/base/errors.hpp"
#include "core/profile/profile.hpp"

namespace perifrac {

namespace {

constexpr Index none = -1;         // moved by nothing that has a mass: prescribed
constexpr Index plate_alone = -2;  // a plate without mass

std::span<const double> view(const Eigen::VectorXd& values) {
  return {values.data(), static_cast<std::size_t>(values.size())};
}

}  // namespace

template <int D>
ElasticDynamics<D>::ElasticDynamics(const Body<D>& body,
                                    std::shared_ptr<ElasticOperator<D>> elastic,
                                    const SolidBoundary<D>& boundary, double density)
    : body_(body),
      elastic_(std::move(elastic)),
      prescribed_(elastic_->size()),
      loads_(elastic_->size()),
      owner_(elastic_->size(), none),
      prescribed_now_(elastic_->size()),
      load_now_(elastic_->size()),
      trial_(elastic_->size()),
      inner_(elastic_->size()),
      scratch_(body.points().size()) {
  const auto mirror = boundary.mirror_condition(*body.family(boundary.mirrored()));
  prescribed_ = boundary.prescribed(mirror);
  loads_ = boundary.loads(mirror, elastic_->gradient_matrix());
  const Eigen::SparseMatrix<double> free = boundary.free_unknowns(mirror);
  const Index points = body.points().size();
  for (Index column = 0; column < free.cols(); ++column) {
    Eigen::SparseMatrix<double>::InnerIterator moved(free, column);
    if (moved.row() >= D * points) {
      owner_[moved.row()] = plate_alone;
      plates_.push_back({static_cast<Index>(moved.row()), {}, {}});
      continue;
    }
    const Index y = static_cast<Index>(mass_.size());
    first_moved_.push_back(moved.row());
    mass_.push_back(0.0);
    for (; moved; ++moved) {
      owner_[moved.row()] = y;
      mass_[y] += density * body.points().volume[moved.row() % points];
      if (moved.row() != first_moved_[y]) also_moved_.emplace_back(y, moved.row());
    }
  }
  for (const auto& plate : boundary.plates(mirror)) {
    plate_unknowns_.push_back(Eigen::SparseMatrix<double>::InnerIterator(free, plate.column).row());
  }
  prescribed_.at(0.0, prescribed_now_);
  prescribes_ = !prescribed_.is_constant() || !prescribed_now_.isZero(0.0);
  loads_.at(0.0, load_now_);
  initial_force_ = elastic_->initial_force();
  if (std::ranges::all_of(initial_force_, [](double f) { return f == 0.0; })) initial_force_ = {};
  find_acted_on();
}

template <int D>
std::string ElasticDynamics<D>::place(std::size_t unknown) const {
  const Index point = first_moved_[unknown] % body_.points().size();
  return describe_point(point, body_.points().at(point));
}

template <int D>
void ElasticDynamics<D>::set_pore_stress(const PoreStressInput& input) {
  pore_ = input;
  // Going back to before the first window takes the reference away again.
  if (!reference_slope_.empty() && std::ranges::equal(input.slope, pore_slope_)) return;
  if (reference_slope_.empty()) {
    if (std::ranges::all_of(input.slope, [](double s) { return s == 0.0; })) return;
    reference_slope_.assign(input.slope.begin(), input.slope.end());
    note_reference();
  }
  pore_slope_.assign(input.slope.begin(), input.slope.end());
  plate_rows_known_ = false;
  growth_ = 1.0;
  for (std::size_t i = 0; i < pore_slope_.size(); ++i) {
    if (reference_slope_[i] != 0.0) {
      growth_ = std::max(growth_, pore_slope_[i] / reference_slope_[i]);
    }
  }
}

/// The stiffness of reference is another one only if the slope in it is.
template <int D>
void ElasticDynamics<D>::note_reference() {
  if (reference_slope_ == noted_slope_) return;
  noted_slope_ = reference_slope_;
  no_pore_stress_.assign(noted_slope_.size(), 0.0);
  ++version_;
}

template <int D>
void ElasticDynamics<D>::force(double t, std::span<const double> y, std::span<double> force) {
  if (!prescribed_.is_constant()) prescribed_.at(t, prescribed_now_);
  if (!loads_.is_constant()) find_loads(t);
  find_pore_stress(t);
  before_.swap(unknowns_);
  unknowns_.resize(owner_.size());
  expand(y, prescribes_ ? view(prescribed_now_) : std::span<const double>(), unknowns_);
  place_plates(view(load_now_), pore_stress_, unknowns_);
  const bool answers = !pore_.value.empty();
  apply(unknowns_, {pore_stress_, pore_slope_}, inner_,
        answers ? std::span(dilatation_) : std::span<double>());
  if (fracture_ != nullptr) fracture_->add(t, unknowns_, inner_);
  // Trapezoidal in time: the work that this scheme's energy answers to.
  external_work_ += block_sum(static_cast<Index>(acted_on_.size()), block_sums_, [&](Index n) {
    const Index k = acted_on_[n];
    const double now = owner_[k] == none ? inner_[k] : load_now_[k];
    const double work = 0.5 * (external_force_[k] + now) * (unknowns_[k] - before_[k]);
    external_force_[k] = now;
    return work;
  });
  gather([&](Index k) { return load_now_[k] - inner_[k]; }, force);
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
  expand(v, {}, trial_);
  place_plates({}, {}, trial_);
  apply_small(trial_, {no_pore_stress_, reference_slope_}, inner_, {});
  gather([&](Index k) { return inner_[k]; }, product);
}

/// Every unknown from what has a mass and what is prescribed (empty: 0); plates at 0.
template <int D>
void ElasticDynamics<D>::expand(std::span<const double> y, std::span<const double> prescribed,
                                std::vector<double>& unknowns) const {
  for_each_entry(static_cast<Index>(owner_.size()), [&](Index k) {
    unknowns[k] = owner_[k] >= 0 ? y[owner_[k]] : 0.0;
    if (!prescribed.empty()) unknowns[k] += prescribed[k];
  });
}

/// Force on what has a mass from that on an unknown.
template <int D>
template <class ForceOn>
void ElasticDynamics<D>::gather(ForceOn&& force_on, std::span<double> y) const {
  for_each_entry(static_cast<Index>(first_moved_.size()),
                 [&](Index i) { y[i] = force_on(first_moved_[i]); });
  for (const auto& [i, unknown] : also_moved_) y[i] += force_on(unknown);
}

/// Each plate where its row of the equations is in equilibrium with its load and the pore stress
/// (empty: none), given everything else.
template <int D>
void ElasticDynamics<D>::place_plates(std::span<const double> load, std::span<const double> pore,
                                      std::vector<double>& unknowns) {
  if (plates_.empty()) return;
  if (!plate_rows_known_) find_plate_rows();
  Eigen::VectorXd missing(plates_.size());
  for (std::size_t p = 0; p < plates_.size(); ++p) {
    missing[p] = load.empty() ? 0.0 : load[plates_[p].unknown];
    for (const auto& [k, stiffness] : plates_[p].stiffness) missing[p] -= stiffness * unknowns[k];
    if (pore.empty()) continue;
    for (const auto& [i, dilatation] : plates_[p].dilatation) missing[p] += dilatation * pore[i];
  }
  const Eigen::VectorXd place = plate_compliance_ * missing;
  for (std::size_t p = 0; p < plates_.size(); ++p) unknowns[plates_[p].unknown] = place[p];
}

/// The stiffness is symmetric: a plate's row is what it does to the others when it moves alone.
template <int D>
void ElasticDynamics<D>::find_plate_rows() {
  const auto entries = [](const std::vector<double>& values) {
    std::vector<std::pair<Index, double>> result;
    for (std::size_t k = 0; k < values.size(); ++k) {
      if (values[k] != 0.0) result.emplace_back(static_cast<Index>(k), values[k]);
    }
    return result;
  };
  const auto count = static_cast<Eigen::Index>(plates_.size());
  Eigen::MatrixXd own(count, count);
  std::vector<double> unit(owner_.size(), 0.0), row(owner_.size());
  for (Eigen::Index p = 0; p < count; ++p) {
    unit[plates_[p].unknown] = 1.0;
    apply_small(unit, {no_pore_stress_, pore_slope_}, row, scratch_);
    unit[plates_[p].unknown] = 0.0;
    for (Eigen::Index q = 0; q < count; ++q) {
      own(q, p) = row[plates_[q].unknown];
      row[plates_[q].unknown] = 0.0;
    }
    plates_[p].stiffness = entries(row);
    for (Index i = 0; i < body_.points().size(); ++i) {
      scratch_[i] *= elastic_->pore_sign() * body_.points().volume[i];
    }
    plates_[p].dilatation = entries(scratch_);
  }
  plate_compliance_ = own.inverse();
  plate_rows_known_ = true;
}

template <int D>
void ElasticDynamics<D>::set_interface_force(std::span<const double> force) {
  const bool is_first = interface_force_.empty() && !force.empty();
  interface_force_ = force;
  if (is_first) find_acted_on();
  if (loads_.is_constant()) find_loads(0.0);
}

template <int D>
void ElasticDynamics<D>::find_loads(double t) {
  loads_.at(t, load_now_);
  for (std::size_t k = 0; k < interface_force_.size(); ++k) load_now_[k] += interface_force_[k];
}

template <int D>
void ElasticDynamics<D>::find_pore_stress(double t) {
  pore_stress_.resize(pore_.value.size());
  const double since_end = t - pore_.end;
  for_each_entry(static_cast<Index>(pore_stress_.size()),
                 [&](Index i) { pore_stress_[i] = pore_.value[i] + since_end * pore_.rate[i]; });
}

template <int D>
std::span<const double> ElasticDynamics<D>::acting_pore_stress() {
  acting_pore_stress_.resize(pore_stress_.size());
  with_pore_stress({pore_stress_, pore_slope_}, [&](auto&& at) {
    for (std::size_t i = 0; i < pore_stress_.size(); ++i) {
      acting_pore_stress_[i] = at(static_cast<Index>(i), dilatation_[i]);
    }
  });
  return acting_pore_stress_;
}

template <int D>
void ElasticDynamics<D>::find_acted_on() {
  acted_on_.clear();
  const Index points = D * body_.points().size();
  for (Index k = 0; k < static_cast<Index>(owner_.size()); ++k) {
    const bool by_interface = !interface_force_.empty() && k < points;
    if (by_interface || owner_[k] == none || loads_.has(k)) acted_on_.push_back(k);
  }
}

template <int D>
void ElasticDynamics<D>::start() {
  unknowns_.assign(owner_.size(), 0.0);
  external_force_.assign(owner_.size(), 0.0);
  external_work_ = 0.0;
  reference_slope_.clear();
  dilatation_.assign(body_.points().size(), 0.0);
}

template <int D>
void ElasticDynamics<D>::visit_state(StateVisitor& visitor) {
  visitor.visit("displacement", unknowns_);
  visitor.visit("external_force", external_force_);
  visitor.visit("external_work", external_work_);
  visitor.visit("pore_slope_of_reference", reference_slope_);
}

/// The step ends with the force of the bonds that it began with, and the next one begins without
/// those that broke: so no energy is lost but what they held.
template <int D>
bool ElasticDynamics<D>::changes() {
  if (fracture_ == nullptr || !fracture_->breaks(unknowns_)) return false;
  plate_rows_known_ = false;
  return true;
}

template <int D>
void ElasticDynamics<D>::derive() {
  if (fracture_ != nullptr) {
    fracture_->follow_state();
    plate_rows_known_ = false;
  }
  apply(unknowns_, {}, inner_, pore_.value.empty() ? std::span<double>() : dilatation_);
}

template <int D>
std::vector<double> ElasticDynamics<D>::position() const {
  std::vector<double> y(first_moved_.size());
  for (std::size_t i = 0; i < y.size(); ++i) y[i] = unknowns_[first_moved_[i]];
  return y;
}

template <int D>
std::span<double> ElasticDynamics<D>::dilatation() {
  if (pore_.value.empty()) apply(unknowns_, {}, inner_, dilatation_);
  return dilatation_;
}

template <int D>
double ElasticDynamics<D>::elastic_energy() {
  apply(unknowns_, {}, inner_, {});
  return elastic_->energy(unknowns_, inner_);
}

template <int D>
void ElasticDynamics<D>::point_velocity(double t, double step, std::span<const double> velocity,
                                        std::span<double> result) {
  for (std::size_t k = 0; k < result.size(); ++k) {
    result[k] = owner_[k] >= 0 ? velocity[owner_[k]] : 0.0;
  }
  if (prescribed_.is_constant()) return;
  Eigen::VectorXd now(prescribed_now_.size()), before(now.size());
  prescribed_.at(t, now);
  prescribed_.at(t - step, before);
  for (std::size_t k = 0; k < result.size(); ++k) result[k] += (now[k] - before[k]) / step;
}

template class ElasticDynamics<2>;
template class ElasticDynamics<3>;

}  // namespace perifrac
