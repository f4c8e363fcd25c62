#include "modules/pore_flow/storage/linear_storage.hpp"

namespace perifrac {

LinearStorage::LinearStorage(PoreMaterials materials) : PoreStorage(std::move(materials)) {
  const Index points = this->materials().points();
  for (Index i = 0; i < points; ++i) effective_storage_.push_back(this->materials().at(i).storage);
}

bool LinearStorage::set_dilatation(const DilatationInput& input) {
  dilatation_ = input;
  bool changed = false;
  for (Index i = 0; i < std::ssize(input.slope); ++i) {
    const PoreMaterial& rock = materials().at(i);
    const double alpha = rock.biot_coefficient;
    const double storage = rock.storage + alpha * alpha * input.slope[i];
    changed = changed || storage != effective_storage_[i];
    effective_storage_[i] = storage;
  }
  return changed;
}

void LinearStorage::pressure(double t, std::span<const double> zeta, std::span<double> p) const {
  const Index points = materials().points();
  if (dilatation_.value.empty()) {
    for (Index i = 0; i < points; ++i) p[i] = zeta[i] / effective_storage_[i];
    return;
  }
  for (Index i = 0; i < points; ++i) {
    const double alpha = materials().at(i).biot_coefficient;
    p[i] = (zeta[i] - alpha * dilatation_.at(i, t)) / effective_storage_[i];
  }
}

std::span<const double> LinearStorage::effective_storage(double, std::span<const double>) {
  return effective_storage_;
}

double LinearStorage::content(Index i, double p) const { return materials().at(i).storage * p; }

double LinearStorage::content(double t, Index i, double p) const {
  return materials().at(i).biot_coefficient * dilatation_.at(i, t) + effective_storage_[i] * p;
}

double LinearStorage::undrained_slope(Index i, double, double) const {
  const PoreMaterial& rock = materials().at(i);
  return -rock.biot_coefficient * rock.biot_coefficient / rock.storage;
}

double LinearStorage::energy(Index i, double, double p) const {
  return 0.5 * materials().at(i).storage * p * p;
}

}  // namespace perifrac
