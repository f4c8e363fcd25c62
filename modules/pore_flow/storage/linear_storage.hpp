#pragma once

#include <vector>

#include "modules/pore_flow/storage/pore_storage.hpp"

namespace perifrac {

/// Storage of a linear fluid: zeta = alpha theta + S p.
class LinearStorage : public PoreStorage {
 public:
  explicit LinearStorage(PoreMaterials materials);

  bool set_dilatation(const DilatationInput& input) override;
  void pressure(double t, std::span<const double> zeta, std::span<double> p) const override;
  std::span<const double> effective_storage(double t, std::span<const double> zeta) override;
  double content(Index i, double p) const override;
  double content(double t, Index i, double p) const override;
  double undrained_slope(Index i, double zeta, double p) const override;
  double energy(Index i, double zeta, double p) const override;

 protected:
  const DilatationInput& dilatation() const { return dilatation_; }

 private:
  DilatationInput dilatation_;
  std::vector<double> effective_storage_;  ///< S + alpha^2 slope
};

}  // namespace perifrac
