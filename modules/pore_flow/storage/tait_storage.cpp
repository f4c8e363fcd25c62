#include "modules/pore_flow/storage/tait_storage.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "core/bonds/bond_traversal.hpp"

namespace perifrac {

TaitStorage::TaitStorage(PoreMaterials materials, PoreFluid fluid)
    : PoreStorage(std::move(materials)),
      fluid_(fluid),
      effective_storage_(this->materials().points()) {
  for (Index i = 0; i < this->materials().points(); ++i) {
    pore_answer_.push_back(this->materials().at(i).grain_storage);
  }
}

bool TaitStorage::set_dilatation(const DilatationInput& input) {
  dilatation_ = input;
  bool changed = false;
  for (Index i = 0; i < std::ssize(input.slope); ++i) {
    const PoreMaterial& rock = materials().at(i);
    const double alpha = rock.biot_coefficient;
    const double answer = rock.grain_storage + alpha * alpha * input.slope[i];
    changed = changed || answer != pore_answer_[i];
    pore_answer_[i] = answer;
  }
  return changed;
}

double TaitStorage::relative_pressure(double excess, double pores, double softness) const {
  const double fluid = pores + excess;
  if (!(fluid > 0.0 && (pores > 0.0 || softness > 0.0))) {
    return std::numeric_limits<double>::quiet_NaN();
  }
  // Of y = rho/rho_0 - 1, pores y + (1 + y) softness [(1 + y)^gamma - 1] - excess is convex,
  // negative at -1 and not negative at the first y: from there Newton's method falls to the root
  // without a detour, down to rounding.
  const double gamma = fluid_.tait_exponent;
  const auto raised = [gamma](double y) { return std::expm1(gamma * std::log1p(y)); };
  double y = pores > 0.0 ? std::max(0.0, excess / pores)
                         : std::expm1(std::log1p(excess / softness) / gamma);
  while (true) {
    const double power = raised(y);
    const double beyond = pores * y + (1.0 + y) * softness * power - excess;
    const double next = y - beyond / (pores + softness * (gamma + (gamma + 1.0) * power));
    if (!(next < y)) return power;
    y = next;
  }
}

void TaitStorage::pressure(double t, std::span<const double> zeta, std::span<double> p) const {
  const double scale = fluid_.bulk_modulus / fluid_.tait_exponent;
  for_each_point(materials().points(), [&](Index i) {
    const PoreMaterial& rock = materials().at(i);
    const double opened = rock.biot_coefficient * dilatation_.at(i, t);
    p[i] = scale *
           relative_pressure(zeta[i] - opened, rock.porosity + opened, scale * pore_answer_[i]);
  });
}

std::span<const double> TaitStorage::effective_storage(double t, std::span<const double> zeta) {
  const Index points = materials().points();
  if (!zeta.empty()) pressure(t, zeta, effective_storage_);
  for_each_point(points, [&](Index i) {
    const double p = zeta.empty() ? 0.0 : effective_storage_[i];
    const double fluid = materials().at(i).porosity + (zeta.empty() ? 0.0 : zeta[i]);
    const double ratio = fluid_.density_ratio(p);
    effective_storage_[i] = ratio * (fluid / (fluid_.bulk_modulus + fluid_.tait_exponent * p) +
                                     ratio * pore_answer_[i]);
  });
  return effective_storage_;
}

double TaitStorage::content(Index i, double p) const {
  const PoreMaterial& rock = materials().at(i);
  return fluid_.density_ratio(p) * (rock.porosity + rock.grain_storage * p) - rock.porosity;
}

double TaitStorage::content(double t, Index i, double p) const {
  const PoreMaterial& rock = materials().at(i);
  const double pores =
      rock.porosity + rock.biot_coefficient * dilatation_.at(i, t) + pore_answer_[i] * p;
  return fluid_.density_ratio(p) * pores - rock.porosity;
}

double TaitStorage::undrained_slope(Index i, double zeta, double p) const {
  const PoreMaterial& rock = materials().at(i);
  const double ratio = fluid_.density_ratio(p);
  const double storage =  // d(zeta)/dp at constant dilatation
      (rock.porosity + zeta) / (fluid_.bulk_modulus + fluid_.tait_exponent * p) +
      ratio * rock.grain_storage;
  return -rock.biot_coefficient * rock.biot_coefficient * ratio / storage;
}

double TaitStorage::energy(Index i, double zeta, double p) const {
  const PoreMaterial& rock = materials().at(i);
  const double of_fluid = fluid_.potential(p) - p / fluid_.density_ratio(p);
  return (rock.porosity + zeta) * of_fluid + 0.5 * rock.grain_storage * p * p;
}

}  // namespace perifrac
