#include "modules/crack_fluid/crack_network.hpp"

#include <algorithm>
#include <limits>

#include <fmt/format.h>

#include "core/base/errors.hpp"
#include "core/base/require.hpp"
#include "core/solvers/complementarity.hpp"
#include "modules/crack_fluid/lubrication_newton.hpp"

namespace perifrac {

namespace {

/// A window that Newton cannot take at once is cut in halves, down to this part of it.
constexpr double shortest_part = 1.0 / 1024.0;

Eigen::VectorXd vector_of(const std::vector<double>& values) {
  return Eigen::Map<const Eigen::VectorXd>(values.data(), static_cast<Eigen::Index>(values.size()));
}

}  // namespace

/// Facets are only added; what is new is dry.
template <int D>
void CrackNetwork<D>::match_facets() {
  const BondState<D>& bonds = body_->bond_state();
  if (version_ != bonds.facet_points().version) {
    version_ = bonds.facet_points().version;
    lubrication_ = Lubrication(liquid_, CrackGraph(bonds.facets()));
    inlets_.locate(bonds.facet_points(), lubrication_.graph());
    if (outlets_) outlets_->match(lubrication_.graph());
  }
  const std::size_t count = bonds.facets().size();
  mass_.resize(count, 0.0);
  unknown_.resize(count, liquid_.empty());
  settled_.resize(count, liquid_.empty());
  aperture_.resize(count, liquid_.residual_aperture);
  if (leak_off_) leak_off_->match(bonds.facet_points(), lubrication_.graph());
  for (std::vector<double>* input : {&opening_, &opening_rate_}) input->resize(count);
  if (opening_slope_.size() != count * count) opening_slope_.assign(count * count, 0.0);
}

template <int D>
void CrackNetwork<D>::initialize(double) {
  if (outlets_) outlets_->start();
  match_facets();
  std::ranges::fill(mass_, 0.0);
  std::ranges::fill(unknown_, liquid_.empty());
  std::ranges::fill(settled_, liquid_.empty());
  std::ranges::fill(aperture_, liquid_.residual_aperture);
  face_work_.clear();
  mouths_.clear();
  has_begun_ = 0;
  injected_ = leaked_ = work_ = dissipation_ = {};
  leak_off_rate_ = 0.0;
}

template <int D>
double CrackNetwork<D>::stable_time_step() const {
  return std::numeric_limits<double>::infinity();
}

/// Where nothing flows, as the window begins.
template <int D>
LubricationStep CrackNetwork<D>::at_rest(const TimeWindow& window) const {
  return {.time = {window.begin, window.begin},
          .opening = {opening_, opening_rate_, opening_slope_, window.end},
          .mass = mass_};
}

/// Cracks of the start, now that their opening is known. Their fluid counts as injected, with what
/// it took to open them.
template <int D>
void CrackNetwork<D>::fill_at_start(const TimeWindow& window) {
  has_begun_ = 1;
  const PointSet& facets = body_->bond_state().facet_points();
  for (std::size_t f = 0; f < mass_.size(); ++f) {
    for (const auto& [box, pressure] : fillings_) {
      Vector<D> place;
      for (int a = 0; a < D; ++a) place[a] = facets.position[a][f];
      if (box.contains(place)) unknown_[f] = pressure;
    }
  }
  lubrication_.evaluate(at_rest(window), vector_of(unknown_));
  face_work_.start(lubrication_.graph().facet_count());
  for (std::size_t f = 0; f < mass_.size(); ++f) {
    work_.add(face_work_.book(lubrication_, static_cast<Index>(f)));
    if (!liquid_.is_full(unknown_[f])) continue;
    mass_[f] = lubrication_.residual()[f];
    injected_.add(mass_[f]);
    work_.add(mass_[f] * liquid_.internal_energy(unknown_[f]));
  }
  settled_ = unknown_;
}

template <int D>
double CrackNetwork<D>::advance(const TimeWindow& window) {
  match_facets();
  if (mass_.empty()) return window.end;
  if (has_begun_ == 0) fill_at_start(window);
  if (outlets_) outlets_->tell(window.begin);
  if (!face_work_.knows_all_of(lubrication_)) {
    lubrication_.evaluate(at_rest(window), vector_of(unknown_));
    face_work_.add_new(lubrication_);
  }
  if (mouths_.any()) mouths_.begin_window(inlets_);
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
  if (leak_off_ && window.length() > 0.0) {
    leak_off_rate_ = (leak_off_volume() - leaked_before) / window.length();
  }
  return window.end;
}

/// Another place for Newton to begin: facets that are dry are under the largest pressure next to
/// them, as a new one behind a thin fluid is at once.
template <int D>
std::vector<double> CrackNetwork<D>::filled_from_neighbours() const {
  std::vector<double> guess = unknown_;
  const CrackGraph& graph = lubrication_.graph();
  for (std::size_t k = 0; k < graph.joint_count(); ++k) {
    for (const CrackGraph::Branch& a : graph.joint(k)) {
      if (liquid_.is_full(unknown_[a.facet])) continue;
      for (const CrackGraph::Branch& b : graph.joint(k)) {
        guess[a.facet] = std::max(guess[a.facet], unknown_[b.facet]);
      }
    }
  }
  return guess;
}

/// Tries one step; false where a shorter one is called for. Throws NumericalError where none is.
template <int D>
bool CrackNetwork<D>::step(const TimeWindow& time, const TimeWindow& window) {
  require(opening_.size() == mass_.size() && opening_rate_.size() == mass_.size() &&
              opening_slope_.size() == mass_.size() * mass_.size(),
          "an opening of other facets than the crack has");
  const auto given = inlets_.inflows(time);
  std::vector<FacetInflow> inflows(given.begin(), given.end());
  if (outlets_) outlets_->append_to(inflows, time, liquid_.vapour_pressure);
  const LubricationStep step{.time = time,
                             .opening = {opening_, opening_rate_, opening_slope_, window.end},
                             .mass = mass_,
                             .inflows = inflows,
                             .leak_off = leak_off_.get()};
  if (leak_off_) leak_off_->begin(time);
  Eigen::VectorXd v = vector_of(time.length() > 0.0 ? unknown_ : settled_);
  const auto solved = [&] {
    try {
      return solve(lubrication_, liquid_, step, v);
    } catch (const NoContact&) {
      return NewtonReport{};
    }
  };
  NewtonReport report = solved();
  iterations_ += report.iterations;
  if (!report.converged && time.length() > 0.0) {
    v = vector_of(filled_from_neighbours());
    report = solved();
    iterations_ += report.iterations;
  }
  ++steps_;
  if (report.converged) {
    book(v);
    if (time.length() > 0.0) settled_ = unknown_;
    return true;
  }
  if (time.length() > shortest_part * window.length()) return false;
  const PointSet& facets = body_->bond_state().facet_points();
  const Index f = report.worst;
  Vector<D> place;
  for (int a = 0; a < D; ++a) place[a] = facets.position[a][f];
  throw NumericalError("crack_pressure", fmt::format("facet, {}", describe_point(f, place)),
                       time.begin, "no balance of mass, in however short a step,");
}

/// What has moved is what counts: mass is kept to rounding whatever Newton left over. What comes in
/// has the mean enthalpy of beginning and end; where a facet was not full, what it received by
/// mass. What inlets bring and facets did not receive has gone into the flow.
template <int D>
void CrackNetwork<D>::book(const Eigen::VectorXd& v) {
  const bool is_sink = leak_off_ && leak_off_->is_sink();
  const auto energy_of = [&](double mass, double unknown) {
    return mass * liquid_.internal_energy(liquid_.pressure(unknown));
  };
  for (std::size_t f = 0; f < mass_.size(); ++f) {
    const double inflow = lubrication_.inflow()[f];
    const double outflow = lubrication_.outflow()[f];
    const double leaked = lubrication_.leaked()[f];
    const double more = inflow - outflow - leaked;
    const double received = energy_of(mass_[f] + more, v[f]) - energy_of(mass_[f], unknown_[f]) +
                            face_work_.book(lubrication_, static_cast<Index>(f));
    const double last = liquid_.enthalpy(liquid_.pressure(v[f]));
    double enthalpy = 0.5 * (liquid_.enthalpy(liquid_.pressure(unknown_[f])) + last);
    if (!liquid_.is_full(unknown_[f])) {
      enthalpy = more > 0.0 ? std::clamp(received / more, 0.0, std::max(last, 0.0)) : 0.0;
    }
    mass_[f] += more;
    if (!mouths_.book(static_cast<Index>(f), inflow, inlets_)) injected_.add(inflow);
    leaked_.add(-leaked);
    const double brought = enthalpy * (is_sink ? inflow - leaked : inflow);
    work_.add(brought);
    dissipation_.add(brought - received);
    unknown_[f] = v[f];
    aperture_[f] = lubrication_.aperture()[f];
  }
  if (!leak_off_) return;
  const double handed_over = leak_off_->accept(mass_);  // which pore flow counts as gained
  work_.add(-handed_over);
  dissipation_.add(-handed_over);
}

template <int D>
void CrackNetwork<D>::visit_state(StateVisitor& visitor) {
  visitor.visit("crack_fluid_mass", mass_);
  visitor.visit("crack_pressure", unknown_);
  visitor.visit("crack_pressure_settled", settled_);
  visitor.visit("crack_aperture", aperture_);
  face_work_.visit_state(visitor);
  mouths_.visit_state(visitor);
  visitor.visit("crack_has_begun", has_begun_);
  injected_.visit_state(visitor, "injected_crack_fluid_mass");
  leaked_.visit_state(visitor, "leaked_crack_fluid_mass");
  work_.visit_state(visitor, "crack_fluid_work");
  dissipation_.visit_state(visitor, "crack_flow_dissipation");
  if (!leak_off_) return;
  visitor.visit("leak_off_rate", leak_off_rate_);
  leak_off_->visit_state(visitor);
}

template <int D>
void CrackNetwork<D>::on_restored(double) {
  match_facets();
}

template class CrackNetwork<2>;
template class CrackNetwork<3>;

}  // namespace perifrac
