#pragma once

#include "modules/pore_flow/flux/gradient_flow.hpp"
#include "modules/pore_flow/material/darcy_law.hpp"

namespace perifrac {

/// `operator: conservative`: the linear-exact operator with a law of Darcy flow. Bond fluxes are
/// equal and opposite, so mass is exact; H is symmetric, positive semidefinite, one null mode.
template <int D, class Law>
class ConservativeFlow final : public GradientFlow<D, Law> {
 public:
  using GradientFlow<D, Law>::GradientFlow;

  void apply(std::span<const double> p, std::span<double> outflow) override {
    this->operator_.apply(p, outflow);
  }

  std::string path() const override { return this->operator_.path(); }

  Eigen::SparseMatrix<double> assemble() const override { return this->operator_.assemble(); }
};

}  // namespace perifrac
