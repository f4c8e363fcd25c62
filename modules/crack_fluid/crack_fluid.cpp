#include "modules/crack_fluid/crack_fluid.hpp"

#include <algorithm>
#include <limits>

#include <fmt/format.h>

#include "core/base/errors.hpp"
#include "core/base/require.hpp"
#include "core/base/small_vector.hpp"
#include "core/solvers/complementarity.hpp"

namespace perifrac {

namespace {

/// A window that cannot be solved at once is cut in halves, down to this part of it.
constexpr double shortest_part = 1.0 / 1024.0;

Eigen::VectorXd vector_of(const std::vector<double>& values) {
  return Eigen::Map<const Eigen::VectorXd>(values.data(), static_cast<Eigen::Index>(values.size()));
}

}  // namespace

template <int D>
Eigen::VectorXd CrackFluid<D>::heights() const {
  const PointSet& facets = body_->bond_state().facet_points();
  Eigen::VectorXd height(static_cast<Eigen::Index>(facets.count));
  for (std::size_t f = 0; f < facets.count; ++f)
    height[static_cast<Eigen::Index>(f)] = weight_.at(vector_at<D>(facets.position, f));
  return height;
}

/// Facets are only added; what is new is dry.
template <int D>
void CrackFluid<D>::match_facets() {
  const BondState<D>& bonds = body_->bond_state();
  if (version_ != bonds.facet_points().version) {
    version_ = bonds.facet_points().version;
    flow_->follow(CrackGraph(bonds.facets()), heights());
    inlets_.locate(bonds.facet_points(), flow_->graph());
    if (outlets_) outlets_->match(flow_->graph());
  }
  const std::size_t count = bonds.facets().size();
  facets_.match(count, liquid_);
  opening_.match(count);
  part_.resize(count, 1.0);
  if (leak_off_) leak_off_->match(bonds.facet_points(), flow_->graph());
}

template <int D>
void CrackFluid<D>::initialize(double) {
  if (outlets_) outlets_->start();
  match_facets();
  facets_.clear(liquid_);
  face_work_.clear();
  mouths_.clear();
  inlets_.wells().clear();
  has_begun_ = 0;
  books_ = {};
  leak_off_rate_ = 0.0;
}

template <int D>
double CrackFluid<D>::stable_time_step() const {
  return std::numeric_limits<double>::infinity();
}

/// Where nothing flows, as the window begins.
template <int D>
void CrackFluid<D>::rest(const TimeWindow& window) {
  flow_->rest({.time = {window.begin, window.begin},
               .opening = {opening_.value, opening_.rate, opening_.slope, window.end},
               .mass = facets_.mass,
               .aperture = facets_.aperture},
              vector_of(facets_.unknown));
}

/// Cracks of the start, now that their opening is known. Their fluid counts as injected, with what
/// it took to open them.
template <int D>
void CrackFluid<D>::fill_at_start(const TimeWindow& window) {
  has_begun_ = 1;
  const PointSet& facets = body_->bond_state().facet_points();
  for (std::size_t f = 0; f < facets_.count(); ++f) {
    for (const auto& [box, pressure] : fillings_) {
      if (box.contains(vector_at<D>(facets.position, f))) facets_.unknown[f] = pressure;
    }
  }
  rest(window);
  face_work_.start(flow_->graph().facet_count());
  for (std::size_t f = 0; f < facets_.count(); ++f) {
    books_.work.add(face_work_.book(*flow_, static_cast<Index>(f)));
    if (!liquid_.is_full(facets_.unknown[f])) continue;
    facets_.mass[f] = flow_->residual()[f];
    books_.injected.add(facets_.mass[f]);
    books_.work.add(facets_.mass[f] * (liquid_.internal_energy(facets_.unknown[f]) + height_of(f)));
  }
  facets_.settled = facets_.unknown;
}

template <int D>
double CrackFluid<D>::advance(const TimeWindow& window) {
  match_facets();
  if (facets_.count() == 0) return window.end;
  if (has_begun_ == 0) fill_at_start(window);
  if (outlets_) outlets_->tell(window.begin, inlets_.all());
  if (!face_work_.knows_all_of(*flow_)) {
    rest(window);
    face_work_.add_new(*flow_);
  }
  if (mouths_.any()) mouths_.begin_window(window.length(), inlets_);
  if (leak_off_) leak_off_->begin_window(window);
  const double leaked_before = leak_off_volume();
  std::int64_t parts = 1;
  for (std::int64_t done = 0; done < parts;) {
    const auto time_after = [&](std::int64_t n) {
      if (n == parts) return window.end;
      return window.begin + window.length() * static_cast<double>(n) / static_cast<double>(parts);
    };
    if (step({time_after(done), time_after(done + 1)}, window)) {
      ++done;
    } else {
      parts *= 2;
      done *= 2;
    }
  }
  mouths_.end_window();
  if (leak_off_ && window.length() > 0.0) {
    leak_off_rate_ = (leak_off_volume() - leaked_before) / window.length();
  }
  return window.end;
}

/// Tries one step; false where a shorter one is called for. Throws NumericalError where none is.
template <int D>
bool CrackFluid<D>::step(const TimeWindow& time, const TimeWindow& window) {
  require(opening_.fits(facets_.count()), "an opening of other facets than the crack has");
  const auto given = inlets_.inflows(time);
  std::vector<FacetInflow> inflows(given.begin(), given.end());
  if (outlets_) outlets_->append_to(inflows, time, liquid_.vapour_pressure);
  std::erase_if(inflows, [&](const FacetInflow& at) { return inlets_.is_of_well(at.facet); });
  const CrackStep step{.time = time,
                       .opening = {opening_.value, opening_.rate, opening_.slope, window.end},
                       .mass = facets_.mass,
                       .aperture = facets_.aperture,
                       .inflows = inflows,
                       .wells = inlets_.well_flows(time),
                       .leak_off = leak_off_.get()};
  if (leak_off_) leak_off_->take_part(part_);
  if (leak_off_) leak_off_->begin(time, facets_.fill(liquid_));
  Eigen::VectorXd v = vector_of(time.length() > 0.0 ? facets_.unknown : facets_.settled);
  FlowReport report;
  try {
    report = flow_->solve(step, v);
  } catch (const NoContact&) {
  }
  work_.iterations += report.iterations;
  ++work_.steps;
  if (report.converged) {
    book(v);
    inlets_.wells().accept();
    if (time.length() > 0.0) facets_.settled = facets_.unknown;
    return true;
  }
  if (time.length() > shortest_part * window.length()) return false;
  const PointSet& facets = body_->bond_state().facet_points();
  const Index f = report.worst;
  const Vector<D> place = vector_at<D>(facets.position, f);
  throw NumericalError("crack_pressure", fmt::format("facet, {}", describe_point(f, place)),
                       time.begin, "no balance of mass, in however short a step,");
}

/// What has moved is what counts: mass is kept to rounding whatever Newton left over. What comes in
/// has the mean enthalpy of beginning and end; where a facet was not full, what it received by
/// mass. What inlets bring and facets did not receive has gone into the flow.
template <int D>
void CrackFluid<D>::book(const Eigen::VectorXd& v) {
  const bool is_sink = leak_off_ && leak_off_->is_sink();
  const auto energy_of = [&](double mass, double unknown) {
    return mass * liquid_.internal_energy(liquid_.pressure(unknown));
  };
  for (std::size_t f = 0; f < facets_.count(); ++f) {
    const double inflow = flow_->inflow()[f];
    const double outflow = flow_->outflow()[f];
    const double leaked = flow_->leaked()[f];
    const double more = inflow - outflow - leaked;
    const double received = energy_of(facets_.mass[f] + more, v[f]) -
                            energy_of(facets_.mass[f], facets_.unknown[f]) +
                            face_work_.book(*flow_, static_cast<Index>(f));
    const double last = liquid_.enthalpy(liquid_.pressure(v[f]));
    double enthalpy = 0.5 * (liquid_.enthalpy(liquid_.pressure(facets_.unknown[f])) + last);
    if (!liquid_.is_full(facets_.unknown[f])) {
      enthalpy = more > 0.0 ? std::clamp(received / more, 0.0, std::max(last, 0.0)) : 0.0;
    }
    facets_.mass[f] += more;
    if (!mouths_.book(static_cast<Index>(f), inflow, inlets_)) books_.injected.add(inflow);
    books_.leaked.add(-leaked);
    const double brought = enthalpy * (is_sink ? inflow - leaked : inflow);
    books_.work.add(brought + height_of(f) * (inflow - leaked));
    books_.dissipation.add(brought - received + height_of(f) * outflow);
    facets_.unknown[f] = v[f];
    facets_.aperture[f] = flow_->aperture()[f];
  }
  if (!leak_off_) return;
  const double handed_over =
      leak_off_->accept(facets_.fill(liquid_));  // which pore flow counts as gained
  books_.work.add(-handed_over);
  books_.dissipation.add(-handed_over);
}

template <int D>
void CrackFluid<D>::visit_state(StateVisitor& visitor) {
  facets_.visit_state(visitor);
  face_work_.visit_state(visitor);
  mouths_.visit_state(visitor);
  inlets_.wells().visit_state(visitor);
  visitor.visit("crack_has_begun", has_begun_);
  books_.visit_state(visitor);
  if (!leak_off_) return;
  visitor.visit("leak_off_rate", leak_off_rate_);
  leak_off_->visit_state(visitor);
}

template <int D>
void CrackFluid<D>::on_restored(double) {
  match_facets();
}

template class CrackFluid<2>;
template class CrackFluid<3>;

}  // namespace perifrac
