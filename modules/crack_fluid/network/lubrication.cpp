#include "modules/crack_fluid/network/lubrication.hpp"

#include <algorithm>
#include <limits>

namespace perifrac {

namespace {

/// Of the fluid's bulk modulus: below this a pressure that an inlet holds is as good as none.
constexpr double smallest_pressure = 5e-7;

}  // namespace

Lubrication::Lubrication(const CrackLiquid& liquid, CrackGraph graph, Eigen::VectorXd height)
    : CrackFlow(liquid) {
  if (height.size() == 0) height.setZero(graph.facet_count());
  follow(std::move(graph), std::move(height));
}

void Lubrication::evaluate(const CrackStep& step, const Eigen::VectorXd& v) {
  find_pressures(v);
  rest(step, v, step.opening.slope * pressure_);
  find_opening_slope(step.opening.slope);
  flow_by_aperture_.clear();
  flow_by_fill_.clear();
  if (step.time.length() > 0.0) flow(step.time.length());
  residual_ += outflow_;
  let_in(step, v);
}

/// Of facets that are full alone: under the pressure of others nothing changes.
void Lubrication::find_opening_slope(const Eigen::MatrixXd& slope) {
  std::vector<Index> full;
  for (Index f = 0; f < graph_.facet_count(); ++f) {
    if (is_full(f)) full.push_back(f);
  }
  Eigen::MatrixXd of_full = slope(Eigen::all, full);
  if (!closed_.empty()) of_full = contact_.response(slope, std::move(of_full));
  opening_slope_.setZero(slope.rows(), slope.cols());
  opening_slope_(Eigen::all, full) = of_full;
}

/// Per metre.
std::vector<double> Lubrication::rates(std::span<const double> pressure,
                                       std::span<const double> fill,
                                       std::span<const double> aperture) {
  std::vector<double> rate(pressure.size(), 0.0);
  const auto leaves = [&](const CrackGraph::Branch& at, double flux) {
    rate[at.facet] += (at.side == 1 ? 0.5 : -0.5) * flux / liquid_.density;
  };
  for_each_flux(pressure, fill, aperture,
                [&](const CrackGraph::Branch& a, const CrackGraph::Branch& b, double flux) {
                  leaves(a, flux);
                  leaves(b, -flux);
                });
  return rate;
}

void Lubrication::flow(double dt) {
  const std::span<const double> pressure = pressures();
  const std::span fill(fill_.data(), fill_.size());
  const std::span aperture(aperture_.data(), aperture_.size());
  for_each_flux(pressure, fill, aperture,
                [&](const CrackGraph::Branch& a, const CrackGraph::Branch& b, double flux) {
                  // One number on both sides: the product in each sum anew, a fused multiply-add
                  // would round it for one and not for the other, and mass would get lost.
                  const double passed = dt * flux;
                  outflow_[a.facet] += passed;
                  outflow_[b.facet] -= passed;
                  rounding_[a.facet] += std::abs(passed);
                  rounding_[b.facet] += std::abs(passed);
                });
  for (std::size_t k = 0; k < graph_.joint_count(); ++k) {
    at_joint_.find(graph_.joint(k), aperture, graph_, liquid_.viscosity);
    differentiate_joint(graph_.joint(k), dt);
  }
}

/// Of the fall of pressure between two facets that meet, and of the aperture there in terms of it,
/// which is far below the terms that it is the difference of.
double Lubrication::rounding_of_fall(Index from, Index to) const {
  double wide = 0.0;
  for (const Index f : {from, to}) {
    if (is_open(f)) wide = std::max(wide, terms_[f] / aperture_[f]);
  }
  const double from_pressure = pressure_[from], to_pressure = pressure_[to];
  return std::abs(from_pressure) + std::abs(to_pressure) + std::abs(height_[from]) +
         std::abs(height_[to]) + 3.0 * wide * std::abs(fall_between(pressures(), from, to));
}

void Lubrication::differentiate_joint(std::span<const CrackGraph::Branch> joint, double dt) {
  const auto& [conductance, growth, partner, sum] = at_joint_;
  for (std::size_t a = 0; a < joint.size(); ++a) {
    for (std::size_t b = 0; b < joint.size(); ++b) {
      if (a == b) continue;
      // What leaves a for b; the other way round is the other term of the two loops.
      const Index from = joint[a].facet;
      const Index to = joint[b].facet;
      const double fall = fall_between(pressures(), from, to);
      const Index upstream = fall >= 0.0 ? from : to;
      const double density = liquid_.density_at(pressure_[upstream]) * fill_[upstream];
      const double g = conductance[a] * conductance[b] / sum;
      rounding_[from] += dt * density * g * rounding_of_fall(from, to);
      by_pressure_.emplace_back(from, from, dt * density * g);
      by_pressure_.emplace_back(from, to, -dt * density * g);
      by_pressure_.emplace_back(from, upstream,
                                dt * liquid_.density / liquid_.bulk_modulus * g * fall);
      if (!is_full(upstream)) {
        flow_by_fill_.emplace_back(from, upstream,
                                   dt * liquid_.density_at(pressure_[upstream]) * g * fall);
      }
      for (std::size_t m = 0; m < joint.size(); ++m) {
        double by_conductance = -g / sum;
        if (m == a) by_conductance += conductance[b] / sum;
        if (m == b) by_conductance += conductance[a] / sum;
        const double slope = dt * density * fall * by_conductance * growth[m];
        flow_by_aperture_.emplace_back(from, joint[m].facet, slope);
        flow_by_aperture_.emplace_back(from, partner[m], slope);
      }
    }
  }
}

void Lubrication::let_in(const CrackStep& step, const Eigen::VectorXd& v) {
  held_.clear();
  for (const auto& [f, least, most, target, stiffness] : step.inflows) {
    const double without = residual_[f];
    inflow_[f] = std::clamp(without, least, most);
    const double weight = liquid_.density * graph_.area(f) * graph_.area(f) /
                          std::max(std::abs(target), smallest_pressure * liquid_.bulk_modulus);
    const double held = weight * (v[f] - target + stiffness * without);
    residual_[f] = std::clamp(held, without - most, without - least);
    rounding_[f] += std::abs(inflow_[f]);
    // What is held is weighed to be a mass: only where it is what counts does rounding in it.
    if (residual_[f] != held) continue;
    held_.push_back({f, weight, stiffness});
    rounding_[f] += weight * (std::abs(v[f]) + stiffness * rounding_[f]);
  }
}

Eigen::MatrixXd Lubrication::jacobian(const Eigen::VectorXd& v, Conductances conductances) const {
  const Index count = graph_.facet_count();
  Eigen::SparseMatrix<double, Eigen::RowMajor> by_pressure(count, count);
  Eigen::SparseMatrix<double, Eigen::RowMajor> by_aperture(count, count);
  std::vector<Eigen::Triplet<double>> of_apertures = by_aperture_;
  if (conductances == Conductances::follow) {
    of_apertures.insert(of_apertures.end(), flow_by_aperture_.begin(), flow_by_aperture_.end());
  }
  by_pressure.setFromTriplets(by_pressure_.begin(), by_pressure_.end());
  by_aperture.setFromTriplets(of_apertures.begin(), of_apertures.end());
  Eigen::VectorXd follows(count);
  for (Index f = 0; f < count; ++f) follows[f] = is_open(f) ? 1.0 : 0.0;
  Eigen::MatrixXd jacobian = (by_aperture * follows.asDiagonal()) * opening_slope_;
  jacobian += by_pressure;
  for (Index f = 0; f < count; ++f) {
    if (liquid_.is_full(v[f])) continue;
    jacobian.col(f).setZero();
    jacobian(f, f) = by_fill_[f] / liquid_.bulk_modulus;
  }
  for (const auto& slope : flow_by_fill_)
    jacobian(slope.row(), slope.col()) += slope.value() / liquid_.bulk_modulus;
  for (const auto& [f, weight, stiffness] : held_) {
    jacobian.row(f) *= weight * stiffness;
    jacobian(f, f) += weight;
  }
  return jacobian;
}

}  // namespace perifrac
