#pragma once

#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "core/base/law_by_region.hpp"
#include "core/bonds/mirror_condition.hpp"
#include "core/bonds/node_values.hpp"
#include "core/bonds/shape_tensor.hpp"
#include "modules/solid/material/breakable_elasticity.hpp"
#include "modules/solid/material/lps_lattice.hpp"

namespace perifrac {

/// `material.type: lps`: the linear peridynamic solid (paper Eqs 3 to 5 and 13, corrected), small
/// strain. A point stores the energy per volume
///   W = 1/2 (lambda - mu) theta^2 + 1/2 (c / m) sum_j w_ij (xi.(u_j - u_i))^2 / |xi|^2,
///   theta = (d / m) sum_j w_ij xi.(u_j - u_i),   c = 8 mu in plane strain, 15 mu in 3D,
/// and the pore stress works on theta. Exact for isotropic deformation only: on a lattice its
/// moduli are off by an amount that does not fall with the spacing (docs/materials.md). Where bonds
/// break, m is that of the bonds that are left, so that families of any shape keep theta and the
/// stiffness of an isotropic extension.
template <int D>
class LpsElasticity final : public BreakableElasticity<D> {
 public:
  /// `initial_stress`: normal stresses of the body at rest, tension positive [Pa]; `pore_sign`: -1
  /// turns the pore stress, as Eq 13 is printed.
  LpsElasticity(std::shared_ptr<const Family<D>> family, MirrorCondition<D, D> mirror,
                LawByRegion<IsotropicElasticity<D>> law,
                std::optional<Vector<D>> initial_stress = {}, double pore_sign = 1.0);

  Index size() const override;
  void apply(std::span<const double> u, const PoreStress& pore, std::span<double> force,
             std::span<double> dilatation) override;
  void apply_stiffness(std::span<const double> u, std::span<double> force,
                       std::span<double> dilatation = {}) override;
  void add_pore_force(std::span<const double> pore_stress, std::span<double> force) override;
  void stress(std::span<const double> u, std::span<double> stress) override;
  Eigen::SparseMatrix<double> assemble() const override;
  Eigen::VectorXd force_of_stress(const Eigen::VectorXd& stress) const override;
  std::string path() const override;
  double drained_bulk_modulus(Index i) const override { return law_.at(i).drained_bulk_modulus(); }
  double pore_sign() const override { return pore_sign_; }

  void append_unknowns(Index i, std::vector<Index>& unknowns) const override;
  PointStiffness point_stiffness(Index i) const override;
  void update(std::span<const Index> points) override;
  const IsotropicElasticity<D>& law(Index i) const override { return law_.at(i); }

 private:
  /// Position, displacement, volume state, bond stiffness.
  static constexpr int value_count = 2 * D + 2;

  void take(std::span<const double> u) override;
  Tensor<D, D> gradient_at(Index i) const override;
  Tensor<D, D> stress_at(Index i, const Tensor<D, D>& gradient) const override;
  double point_energy(Index i, std::span<const double> u) const override;
  Tensor<D, D> inverse_shape_at(Index i) const;
  void take_moments(Index i, double weighted_volume);
  template <class Take>
  void give_to_lattice(Take&& take);
  /// lambda - mu: the stiffness against dilatation that the bonds do not have.
  double dilatation_stiffness(Index i) const {
    return law_.at(i).lame_lambda - law_.at(i).shear_modulus;
  }
  double dilatation_at(Index i) const;
  template <class PoreStressAt>
  void store_state(std::span<double> dilatation, PoreStressAt&& pore_stress);
  template <bool initially_stressed, class PoreStressAt>
  void find_forces(std::span<double> force, std::span<double> dilatation,
                   PoreStressAt&& pore_stress);
  template <bool initially_stressed>
  Vector<D> bond_forces(Index i) const;
  Vector<D> image_forces(Index i) const;
  template <bool initially_stressed>
  void add_face_reactions(std::span<double> reaction) const;
  Vector<D> bond_vector(Index i, Index j) const;
  Vector<D> difference(Index i, Index j) const;

  std::shared_ptr<const Family<D>> family_;
  MirrorCondition<D, D> mirror_;
  LawByRegion<IsotropicElasticity<D>> law_;
  std::optional<Vector<D>> initial_stress_;
  double pore_sign_;
  std::vector<bool> is_thin_;             ///< see is_thin(); of points whose bonds broke
  std::vector<double> field_;             ///< u on real points and ghosts
  std::vector<double> dilatation_scale_;  ///< d / m_i
  std::vector<double> bond_stiffness_;    ///< c / m_i on real points; 0 on ghosts
  std::vector<double> volume_state_;      ///< d s_i / m_i, s = dW/dtheta; 0 on ghosts
  NodeValues<D, value_count> values_;     ///< of all nodes
  std::vector<double> initial_state_;     ///< initial stress K_i^-1 on real points and ghosts
  std::vector<Vector<D>> image_sign_;     ///< of ghosts: see image_forces()
  std::vector<Index> face_points_;        ///< points with a bond to a ghost
  std::optional<LpsLattice<D>> lattice_;  ///< where bonds lie on one
  std::string why_no_packets_;
};

}  // namespace perifrac
