#pragma once

#include <algorithm>

#include "modules/pore_flow/flux/gradient_flow.hpp"

namespace perifrac {

/// `operator: bond`: half the dissipation is sum_i V_i (D kappa_i / m_i) sum_j w_ij (p_j - p_i)^2 /
/// 2, one flux a bond. H is symmetric, positive semidefinite, one null mode, and mass is exact; but
/// a linear pressure is not balanced where families are cut: first order at no-flux surfaces.
///
/// Law: isotropic, `double mean_mobility()`; bonds of a lattice cannot carry a general tensor.
template <int D, class Law>
class BondFlow final : public GradientFlow<D, Law> {
 public:
  explicit BondFlow(LinearExactOperator<D, Law> op)
      : GradientFlow<D, Law>(std::move(op)),
        stiffness_(this->family().node_count()),
        pressure_(this->family().node_count()) {
    find_stiffness();
  }

  void scale_mobility(std::span<const double> factor) override {
    GradientFlow<D, Law>::scale_mobility(factor);
    find_stiffness();
  }

  void take_bonds(std::shared_ptr<const Family<D>> family, std::span<const Index> points) override {
    GradientFlow<D, Law>::take_bonds(std::move(family), points);
    find_stiffness();
  }

  void apply(std::span<const double> p, std::span<double> outflow) override {
    const Family<D>& family = this->family();
    const Index points = family.point_count;
    std::copy_n(p.begin(), points, pressure_.begin());
    this->operator_.mirror().fill(pressure_, p.data() + points);
    const double* const value = pressure_.data();
    const double* const stiffness = stiffness_.data();
    for_each_shared_point(points, [&](Index i) {
      const auto sum = sum_over_bonds<1>(family, i, [=](Index j, const Vector<D>&, double w) {
        return std::array{w * (stiffness[i] + stiffness[j]) * (value[i] - value[j])};
      });
      outflow[i] = family.volume[i] * sum[0];
    });
    ranks::gather_shares(outflow.first(points), points);
    add_face_inflow(outflow.subspan(points));
  }

  Eigen::SparseMatrix<double> assemble() const override { return this->preconditioner(); }

 private:
  void find_stiffness() {
    const Family<D>& family = this->family();
    this->find_bond_stiffness(stiffness_);
    for (Index g = 0; g < family.ghost_count(); ++g) {
      stiffness_[family.point_count + g] = stiffness_[family.ghost_source[g]];
    }
  }

  /// dE/dU of the face values by way of the ghosts; serial, so that the order of the sum is fixed.
  void add_face_inflow(std::span<double> inflow) const {
    if (inflow.empty()) return;
    std::ranges::fill(inflow, 0.0);
    const Family<D>& family = this->family();
    for (Index i = 0; i < family.point_count; ++i) {
      const PointBonds bonds = family.bonds(i);
      for (Index bond = family.first_ghost_bond(i); bond < bonds.count(); ++bond) {
        const Index j = bonds.other(bond);
        const auto& image =
            this->operator_.mirror().image(family.ghost_faces[j - family.point_count], 0);
        const double flux =
            family.volume[i] * stiffness_[i] * bonds.weight(bond) * (pressure_[j] - pressure_[i]);
        for (int k = 0; k < image.term_count; ++k) {
          inflow[image.terms[k].face_value] += image.terms[k].coefficient * flux;
        }
      }
    }
  }

  std::vector<double> stiffness_;  ///< s_i on points and ghosts
  std::vector<double> pressure_;   ///< workspace: on points and ghosts
};

}  // namespace perifrac
