// How the solid is put together, and what other modules and the history read of it.

#include <cmath>

#include "modules/solid/fracturing_solid.hpp"

namespace perifrac {

namespace {

const PointSet whole_body{.name = "solid"};

}  // namespace

template <int D>
FracturingSolid<D>::FracturingSolid(
    std::shared_ptr<const Body<D>> body, std::shared_ptr<Family<D>> family,
    std::shared_ptr<BreakableElasticity<D>> elastic, const SolidBoundary<D>& boundary,
    std::optional<InitialStress<D>> initial_stress, std::vector<CrackFacet<D>> seeds,
    FractureEnergy<D> fracture_energy, const std::optional<TensileStrength<D>>& tensile_strength,
    std::unique_ptr<CrackFriction> friction)
    : body_(std::move(body)),
      seeds_(std::move(seeds)),
      ports_{
          {"pore_stress", "Pa", PortDirection::in},
          InterfaceForce::port(D),
          {"crack_pressure", "Pa", PortDirection::in},
          {"crack_viscosity", "Pa s", PortDirection::in, PortKind::intensive, PortRole::property},
          {"crack_leak_off", "m/s^0.5", PortDirection::in, PortKind::intensive, PortRole::property},
          {"displacement", "m", PortDirection::out, PortKind::intensive, PortRole::field, D},
          {"dilatation", "1", PortDirection::out},
          {"effective_stress", "Pa", PortDirection::out, PortKind::intensive, PortRole::field,
           D * D},
          {"damage", "1", PortDirection::out},
          {"crack_opening", "m", PortDirection::out},
          {"free_crack_opening", "m", PortDirection::out, PortKind::intensive, PortRole::property},
          {D == 2 ? "crack_length" : "crack_area", D == 2 ? "m" : "m^2", PortDirection::out},
          {D == 2 ? "open_crack_length" : "open_crack_area", D == 2 ? "m" : "m^2",
           PortDirection::out},
          {"elastic_energy", unit_of_total("J", D), PortDirection::out, PortKind::extensive,
           PortRole::energy_stored},
          {"external_work", unit_of_total("J", D), PortDirection::out, PortKind::extensive,
           PortRole::energy_gained},
          {"fracture_energy", unit_of_total("J", D), PortDirection::out, PortKind::extensive,
           PortRole::energy_dissipated},
          {"radiated_energy", unit_of_total("J", D), PortDirection::out, PortKind::extensive,
           PortRole::energy_dissipated},
      },
      initial_stress_(initial_stress),
      bonds_(body_->claim_bond_state()),
      cracked_(family, body_->spacing(), elastic,
               boundary.free_unknowns(boundary.mirror_condition(*family)), bonds_, initial_stress,
               seeds_),
      tips_(*body_, cracked_, fracture_energy),
      friction_(std::move(friction)) {
  if constexpr (D == 2) {
    if (tensile_strength) {
      nucleation_ = std::make_unique<CrackNucleation>(*body_, cracked_, std::move(fracture_energy),
                                                      *tensile_strength);
    }
  }
  const auto mirror = boundary.mirror_condition(*family);
  free_unknowns_ = boundary.free_unknowns(mirror);
  for (const auto& [face, column] : boundary.plates(mirror)) {
    ports_.push_back({face + "_plate_displacement", "m", PortDirection::out});
    plate_unknowns_.push_back(
        Eigen::SparseMatrix<double>::InnerIterator(free_unknowns_, column).row());
  }
  if (friction_) {
    ports_.push_back({"friction_dissipation", "J/m", PortDirection::out, PortKind::extensive,
                      PortRole::energy_dissipated});
    ports_.push_back({"crack_slip_area", "m^2", PortDirection::out});
  }
  prescribed_ = boundary.prescribed(mirror);
  load_ = boundary.loads(mirror, elastic->gradient_matrix());
  prescribes_ = !prescribed_.is_constant() || prescribed_.at(0.0).any();
  loads_are_steady_ = load_.is_constant() && !prescribes_;
  for (Index i = 0; i < family->point_count; ++i) {
    slope_.push_back(1.0 / elastic->drained_bulk_modulus(i));
  }
}

template <int D>
void FracturingSolid<D>::connect(PortId in) {
  const std::size_t count = body_->points().size();
  connected_.set(in);
  if (in == pore_stress) pore_stress_.resize(count);
  if (in == interface_impulse) interface_.connect(D * count);
}

/// An input on facets, to which cracks that grow have added.
template <int D>
std::span<double> FracturingSolid<D>::of_facets(PortId in, std::vector<double>& values) {
  if (connected_[in]) values.resize(bonds_.facet_points().count);
  return values;
}

template <int D>
PortView FracturingSolid<D>::port(PortId id) {
  const PointSet* const points = &body_->point_set();
  const PointSet* const facets = &bonds_.facet_points();
  switch (id) {
    case pore_stress:
      return {points, pore_stress_};
    case interface_impulse:
      return {points, interface_.impulse()};
    case crack_pressure:
      return {facets, of_facets(id, crack_pressure_)};
    case crack_viscosity:
      return {facets, of_facets(id, crack_viscosity_)};
    case crack_leak_off:
      return {facets, of_facets(id, crack_leak_off_)};
    case displacement:
      find_unknowns();
      return {points, std::span(unknowns_).first(D * body_->points().volume.size())};
    case dilatation:
      derive();
      return {points, dilatation_, {}, slope_};
    case effective_stress:
      find_effective_stress();
      return {points, effective_stress_};
    case damage:
      damage_.resize(body_->points().size());
      find_damage(cracked_.family(), damage_);
      return {points, damage_};
    case crack_opening:
      return {facets, {faces_.opening.data(), static_cast<std::size_t>(faces_.opening.size())}};
    case free_crack_opening: {
      take_load();
      free_opening_ = cracked_.free_opening(in_cracks());
      const Eigen::MatrixXd& slope = cracked_.compliance();
      opening_slope_.resize(slope.size());
      Eigen::Map<Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor>>(
          opening_slope_.data(), slope.rows(), slope.cols()) = slope;
      return {facets,
              {free_opening_.data(), static_cast<std::size_t>(free_opening_.size())},
              {},
              opening_slope_};
    }
    case crack_area:
      crack_area_ = 0.0;
      for (const FaceJump<D>& jump : cracked_.jumps()) crack_area_ += jump.area;
      return {&whole_body, {&crack_area_, 1}};
    case open_crack_area:
      open_area_ = 0.0;
      for (std::size_t f = 0; f < cracked_.jumps().size(); ++f) {
        if (faces_.opening[f] > 0.0) open_area_ += cracked_.jumps()[f].area;
      }
      return {&whole_body, {&open_area_, 1}};
    case elastic_energy:
      elastic_energy_now();
      return {&whole_body, {&elastic_energy_, 1}};
    case external_work:
      return {&whole_body, {&external_work_, 1}};
    case fracture_energy:
      return {&whole_body, {&spent_energy_, 1}};
    case radiated_energy:
      return {&whole_body, {&radiated_energy_, 1}};
    default:
      if (const PortId after_plates = first_plate + plate_unknowns_.size(); id >= after_plates) {
        if (id == after_plates) return {&whole_body, {&friction_->dissipation(), 1}};
        slip_area_ = 0.0;
        for (std::size_t f = 0; f < friction_->slip().size(); ++f) {
          slip_area_ += cracked_.jumps()[f].area * std::abs(friction_->slip()[f]);
        }
        return {&whole_body, {&slip_area_, 1}};
      }
      find_unknowns();
      return {&whole_body, {&unknowns_[plate_unknowns_[id - first_plate]], 1}};
  }
}

template <int D>
void FracturingSolid<D>::find_effective_stress() {
  find_unknowns();
  effective_stress_.resize(D * D * body_->points().volume.size());
  cracked_.elastic().stress(unknowns_, effective_stress_);
  for (Index i = 0; i < body_->points().size() && initial_stress_; ++i) {
    const Vector<D> there = initial_stress_->at(body_->points().at(i));
    for (std::size_t a = 0; a < D; ++a) {
      double& stress = effective_stress_[(a * D + a) * body_->points().volume.size() + i];
      stress += there[a];
      if (!pore_stress_at_rest_.empty()) stress += pore_stress_at_rest_[i];
    }
  }
}

template class FracturingSolid<2>;
template class FracturingSolid<3>;

}  // namespace perifrac
