#pragma once

#include <array>
#include <memory>
#include <optional>
#include <span>
#include <vector>

#include <Eigen/Core>
#include <Eigen/SparseCore>

#include "core/solvers/condensed_inverse.hpp"
#include "core/solvers/sparse_cholesky.hpp"
#include "modules/solid/fracture/cut_body.hpp"

namespace perifrac {

/// A linear elastic body in equilibrium, in 2D in plane strain, while cracks cut its bonds facet by
/// facet. The stiffness of the body with its first cracks is factored once; every later facet is a
/// low-rank change of it. The faces of a crack carry the pressure of what is in it and, where they
/// close, the pressure of contact, which keeps them from passing through one another; in 2D also
/// the shear of friction, where the scene has it (crack_friction.hpp).
template <int D>
class CrackedBody final : public CutBody<D> {
 public:
  /// As CutBody; `free_unknowns` takes what is solved for to all unknowns, and has at most one
  /// entry a row.
  CrackedBody(std::shared_ptr<Family<D>> family, double spacing,
              std::shared_ptr<BreakableElasticity<D>> elastic,
              Eigen::SparseMatrix<double> free_unknowns, BondState<D>& bonds,
              std::optional<InitialStress<D>> initial_stress, std::vector<CrackFacet<D>> seeds);

  /// Factors the body with its first cracks.
  void start();
  /// Throws PieceCutFree where that leaves a piece that nothing holds, NotPositiveDefinite where
  /// one too thin to bear anything; then nothing has changed.
  bool cut(const CrackFacet<D>& facet) override;
  /// The bond state was replaced: builds the same body anew.
  void follow_bonds();

  /// Pieces of the body that nothing holds.
  std::vector<std::vector<Index>> loose_pieces();

  /// Takes the load on what is solved for [N], cracks' faces apart.
  void set_load(const Eigen::VectorXd& load);

  /// What the cracks' faces do at a pressure in them, one value a facet.
  struct Faces {
    Eigen::VectorXd opening;   ///< [m], >= 0
    Eigen::VectorXd pressure;  ///< on the faces, that of contact included [Pa]
    std::vector<bool> closed;
    std::vector<double> shear{};  ///< on the faces, along their tangent; empty: no friction [Pa]
    std::vector<double> slip{};   ///< with friction, by CrackFriction [m]
  };
  /// Without friction.
  Faces faces(const Eigen::VectorXd& pressure) const;
  /// The openings of faces that may pass through one another [m].
  Eigen::VectorXd free_opening(const Eigen::VectorXd& pressure) const;
  /// d(free_opening)/d(pressure) [m/Pa].
  const Eigen::MatrixXd& compliance() const { return compliance_; }
  /// What faces do along one axis of the facets' frames (0: normal) by tractions along another
  /// [m/Pa]. Openings are mean normal jumps and what pressed_by() puts back.
  Eigen::MatrixXd compliance(int jump, int traction) const;
  double intensity_at_fixed_volume(Index facet) const override;
  std::optional<double> find_answer(std::span<const Index> faces, const Vector<D>& traction,
                                    std::span<const Index> named,
                                    std::span<double> all) const override;

  // Of a pressure on the faces and, unless it is empty, a shear along their (first) tangent:

  /// Openings of all facets, and how far they slide along their tangents [m].
  std::vector<Vector<D>> jumps_under(const Eigen::VectorXd& pressure,
                                     std::span<const double> shear = {}) const;

  /// All unknowns without what is prescribed, under the load too [m].
  Eigen::VectorXd unknowns(const Eigen::VectorXd& pressure,
                           std::span<const double> shear = {}) const;
  /// The same, those named only, which alone are written: cheap where they lie close together.
  void find_unknowns(const Eigen::VectorXd& pressure, std::span<const Index> named,
                     std::span<double> all, std::span<const double> shear = {}) const;
  /// What the body holds and what its loads would have done, had they been there from the start
  /// [J], in 2D per metre; at no back-substitution.
  struct Energies {
    double elastic;
    double load;    ///< load times displacement
    double relief;  ///< the stress that faces are relieved of, times their jumps
  };
  Energies energies(const Eigen::VectorXd& pressure, std::span<const double> shear = {}) const;
  /// Of that, what is in the rock that openings put back, and the work of relief there.
  Energies pressed_energies(const Eigen::VectorXd& pressure) const;
  /// Force of the faces, and of the stress they are relieved of, on all unknowns [N].
  Eigen::VectorXd face_force(const Eigen::VectorXd& pressure, bool relief = true,
                             std::span<const double> shear = {}) const;

  /// Takes what is solved for to all unknowns.
  const Eigen::SparseMatrix<double>& free_unknowns() const { return free_unknowns_; }
  /// Of what is solved for, with all bonds that are broken now; kept for start().
  const Eigen::SparseMatrix<double>& free_stiffness();

 private:
  using CutBody<D>::family_;
  using CutBody<D>::intact_;
  using CutBody<D>::spacing_;
  using CutBody<D>::elastic_;
  using CutBody<D>::bonds_;
  using CutBody<D>::followed_;
  using CutBody<D>::seeds_;
  using CutBody<D>::jumps_;

  /// A facet's jump along its normal and tangents, of the condensed unknowns.
  using Mode = std::array<std::vector<std::pair<int, double>>, D>;

  /// A symmetric matrix of all unknowns on those solved for.
  PointStiffness on_free(const PointStiffness& all) const;
  /// What a change of stiffness takes and what it gives.
  struct Parts {
    std::vector<PointStiffness> less, more;
  };
  void check_pieces(std::span<const std::pair<Index, Index>> cut);
  void change_stiffness(const Parts& parts);
  void add_mode(const FaceJump<D>& jump);
  void find_opening();
  Vector<D> face_load(std::size_t f, double pressure, std::span<const double> shear,
                      bool relief = true) const;
  Eigen::VectorXd block_force(const Eigen::VectorXd& pressure,
                              std::span<const double> shear = {}) const;
  Eigen::VectorXd solve_named(const Eigen::VectorXd& force, const Eigen::VectorXd& block,
                              std::span<const Index> named) const;
  Eigen::VectorXd block_force_on_first_body(const Eigen::VectorXd& force,
                                            const Eigen::VectorXd& block) const;
  Eigen::VectorXd force_on_first_body(const Eigen::VectorXd& force,
                                      const Eigen::VectorXd& block) const;

  Eigen::SparseMatrix<double> free_unknowns_;
  std::vector<std::pair<int, double>> free_of_;  ///< by unknown: what moves it (-1: nothing)

  Eigen::SparseMatrix<double> stiffness_;  ///< until start() has factored it
  SparseCholesky factor_;
  std::unique_ptr<CondensedInverse> inverse_;
  std::vector<Mode> modes_;
  std::vector<double> pressed_;  ///< pressed_by(), by facet
  Eigen::MatrixXd compliance_;

  Eigen::VectorXd load_;         ///< of those solved for
  Eigen::VectorXd intact_move_;  ///< what it does to the body with its first cracks
  Eigen::VectorXd loaded_;       ///< what it does now, on the condensed unknowns
  Eigen::VectorXd opening_;      ///< by load and relief, without pressure
};

}  // namespace perifrac
