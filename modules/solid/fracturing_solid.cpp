#include "modules/solid/fracturing_solid.hpp"

#include <cmath>
#include <limits>

#include "core/base/eigen_view.hpp"
#include "core/base/errors.hpp"
#include "core/solvers/sparse_cholesky.hpp"
#include "modules/solid/boundary/rigid_motion.hpp"
#include "modules/solid/equilibrium/cracked_solver.hpp"
#include "modules/solid/fracture/loose_piece.hpp"
#include "modules/solid/whole_solid.hpp"

namespace perifrac {

namespace {

/// The first unknown that a free one moves.
Index first_row(const Eigen::SparseMatrix<double>& free_unknowns, Eigen::Index column) {
  return static_cast<Index>(
      Eigen::SparseMatrix<double>::InnerIterator(free_unknowns, column).row());
}

}  // namespace

template <int D>
FracturingSolid<D>::FracturingSolid(
    std::shared_ptr<const Body<D>> body, std::shared_ptr<Family<D>> family,
    std::shared_ptr<BreakableElasticity<D>> elastic, const SolidBoundary<D>& boundary,
    std::optional<InitialStress<D>> initial_stress, std::vector<CrackFacet<D>> seeds,
    FractureEnergy<D> fracture_energy, const std::optional<TensileStrength<D>>& tensile_strength,
    std::unique_ptr<CrackFriction> friction, const SolverChoice& choice)
    : body_(std::move(body)),
      seeds_(std::move(seeds)),
      bonds_(body_->claim_bond_state()),
      cracked_(make_cracked_body<D>(*body_, boundary, family, elastic, bonds_, initial_stress,
                                    seeds_, friction != nullptr, choice)),
      load_(body_, elastic, *cracked_, boundary, boundary.mirror_condition(*family)),
      fluid_(bonds_.facet_points()),
      friction_(std::move(friction)),
      equilibrium_(*cracked_, load_, fluid_, friction_.get(), initial_stress),
      work_(equilibrium_),
      growth_(*body_, equilibrium_, work_, std::move(fracture_energy), tensile_strength) {
  for (const auto& [face, column] : boundary.plates(boundary.mirror_condition(*family))) {
    plates_.emplace_back(face, first_row(cracked_->free_unknowns(), column));
  }
  for (Index i = 0; i < family->point_count; ++i) {
    dilatation_slope_.push_back(1.0 / elastic->drained_bulk_modulus(i));
  }
  make_ports();
}

template <int D>
void FracturingSolid<D>::make_ports() {
  load_.add_ports(ports_);
  fluid_.add_ports(ports_);
  make_field_ports();
  make_crack_ports();
  make_energy_ports();
}

template <int D>
void FracturingSolid<D>::make_field_ports() {
  const PointSet* const points = &body_->point_set();
  const std::size_t count = body_->points().size();
  ports_.out({.name = "displacement", .unit = "m", .components = D}, [this, points, count] {
    return PortView{points, equilibrium_.unknowns().first(D * count)};
  });
  ports_.out({.name = "dilatation", .unit = "1", .negligible = negligible_strain}, [this, points] {
    return PortView{points, equilibrium_.dilatation(), {}, dilatation_slope_};
  });
  ports_.out({.name = "effective_stress", .unit = "Pa", .components = D * D}, [this, points] {
    return PortView{points, equilibrium_.effective_stress()};
  });
  ports_.found({.name = "damage", .unit = "1", .negligible = negligible_strain}, *points,
               [this, count](std::vector<double>& damage) {
                 damage.resize(count);
                 find_damage(cracked_->family(), damage);
               });
}

template <int D>
void FracturingSolid<D>::make_crack_ports() {
  const PointSet* const facets = &bonds_.facet_points();
  const char* const measure = D == 2 ? "length" : "area";
  const char* const unit = D == 2 ? "m" : "m^2";
  ports_.out({"crack_opening", "m"}, [this, facets] {
    return PortView{facets, view(equilibrium_.faces().opening)};
  });
  if (growth_.has_moving_tips()) {
    ports_.out({.name = "crack_part", .unit = "1", .role = PortRole::property}, [this, facets] {
      return PortView{facets, growth_.parts()};
    });
  }
  using Matrix = Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor>;
  ports_.out({.name = "free_crack_opening", .unit = "m", .role = PortRole::property},
             [this, facets, opening = Eigen::VectorXd(), slope = Matrix()]() mutable {
               opening = equilibrium_.free_opening();
               slope = cracked_->opening_slope();
               const std::span<double> rows(slope.data(), static_cast<std::size_t>(slope.size()));
               return PortView{facets, view(opening), {}, rows};
             });
  ports_.total({std::string("crack_") + measure, unit}, whole_solid, [this] {
    double area = 0.0;
    const std::vector<double>& part = growth_.parts();
    for (std::size_t f = 0; f < part.size(); ++f) area += part[f] * cracked_->jumps()[f].area;
    return area;
  });
  ports_.total({std::string("open_crack_") + measure, unit}, whole_solid, [this] {
    double area = 0.0;
    const std::vector<double>& part = growth_.parts();
    for (std::size_t f = 0; f < part.size(); ++f) {
      if (equilibrium_.faces().opening[f] > 0.0) area += part[f] * cracked_->jumps()[f].area;
    }
    return area;
  });
  if (!friction_) return;
  ports_.found({"crack_slip", "m"}, bonds_.facet_points(), [this](std::vector<double>& slip) {
    slip.assign(friction_->slip().begin(), friction_->slip().end());
    slip.resize(bonds_.facet_points().count);
  });
  ports_.total({"crack_slip_area", "m^2"}, whole_solid, [this] {
    double area = 0.0;
    for (std::size_t f = 0; f < friction_->slip().size(); ++f) {
      area += cracked_->jumps()[f].area * std::abs(friction_->slip()[f]);
    }
    return area;
  });
}

template <int D>
void FracturingSolid<D>::make_energy_ports() {
  const auto energy = [this](const char* name, PortRole role, std::function<double()> find) {
    ports_.total(total_port(name, "J", role, D), whole_solid, std::move(find));
  };
  using enum PortRole;
  energy("elastic_energy", energy_stored, [this] { return work_.elastic_energy(); });
  energy("external_work", energy_gained, [this] { return work_.external_work(); });
  energy("fracture_energy", energy_dissipated, [this] { return work_.fracture_energy(); });
  energy("radiated_energy", energy_dissipated, [this] { return work_.radiated_energy(); });
  for (const auto& [face, unknown] : plates_) {
    ports_.total({face + "_plate_displacement", "m"}, whole_solid,
                 [this, unknown = unknown] { return equilibrium_.unknowns()[unknown]; });
  }
  if (!friction_) return;
  energy("friction_dissipation", energy_dissipated, [this] { return friction_->dissipation(); });
}

template <int D>
std::string FracturingSolid<D>::free_motion() {
  return rigid_motion_without_energy<D>(
      body_->points(), [&](const Eigen::VectorXd& u) { return cracked_->stiffness_times(u); },
      cracked_->free_unknowns(), static_cast<Eigen::Index>(plates_.size()));
}

/// Of the point that this one of what is solved for moves.
template <int D>
std::string FracturingSolid<D>::place_of(Eigen::Index free) const {
  const Index point = first_row(cracked_->free_unknowns(), free) % body_->points().size();
  return describe_point(point, body_->points().at(point));
}

template <int D>
BodyError FracturingSolid<D>::loose_piece(const std::string& piece) const {
  return {"its cracks leave " + piece,
          "cracks that leave every piece held by a face or by solid.pins, some points thick"};
}

template <int D>
void FracturingSolid<D>::initialize(double t) {
  if (const auto loose = cracked_->loose_pieces(); !loose.empty()) {
    throw loose_piece(describe_piece<D>(cracked_->family(), loose.front()) +
                      ", which nothing holds");
  }
  try {
    cracked_->start();
  } catch (const NotPositiveDefinite& error) {
    throw loose_piece("a piece that is too thin to bear anything, at " + place_of(error.row()));
  }
  growth_.start(seeds_, t);
  equilibrium_.start(t);
  work_.start();
}

template <int D>
double FracturingSolid<D>::stable_time_step() const {
  return std::numeric_limits<double>::infinity();
}

template <int D>
double FracturingSolid<D>::advance(const TimeWindow& window) {
  load_.begin(window);
  equilibrium_.solve(window.end);
  tips_are_found_ = growth_.find_tips();
  return window.end;
}

template <int D>
double FracturingSolid<D>::conclude(const TimeWindow& window) {
  if (const double end = growth_.first_event(window); end < window.end) return end;
  work_.book();
  try {
    growth_.grow();
  } catch (const PieceCutFree& piece) {
    equilibrium_.solve(window.end);  // of what was cut before
    throw FinalError("displacement", piece.what(), window.end,
                     "cracks cut a piece free that nothing holds, so that there is no balance of "
                     "forces; end the run before, or hold the piece by a face or solid.pins;");
  } catch (const NotPositiveDefinite& error) {
    equilibrium_.solve(window.end);
    throw FinalError("displacement", place_of(error.row()), window.end,
                     "cracks leave a piece too thin to bear anything; end the run before;");
  }
  cracked_->conclude();
  return window.end;
}

template <int D>
void FracturingSolid<D>::visit_state(StateVisitor& visitor) {
  load_.visit_state(visitor);
  fluid_.visit_state(visitor);
  work_.visit_state(visitor);
  equilibrium_.visit_state(visitor);
  growth_.visit_state(visitor);
  bonds_.visit_state(visitor);
}

template <int D>
void FracturingSolid<D>::on_restored(double t) {
  equilibrium_.on_restored(t, work_.displacement());
  growth_.on_restored();
}

template class FracturingSolid<2>;
template class FracturingSolid<3>;

}  // namespace perifrac
