#pragma once

#include <memory>
#include <optional>
#include <span>
#include <vector>

#include <Eigen/Core>
#include <Eigen/SparseCore>

#include "core/geometry/bond_state.hpp"
#include "core/solvers/condensed_inverse.hpp"
#include "core/solvers/sparse_cholesky.hpp"
#include "modules/solid/breakable_elasticity.hpp"
#include "modules/solid/face_jump.hpp"

namespace perifrac {

/// A linear elastic body in equilibrium, in plane strain, while cracks cut its bonds facet by
/// facet. The stiffness of the body with its first cracks is factored once; every later facet is a
/// low-rank change of it. The faces of a crack carry the pressure of what is in it and, where they
/// close, the pressure of contact, which keeps them from passing through one another (without
/// friction).
class CrackedBody {
 public:
  /// `family` is the one of `elastic`, with nothing broken; `free_unknowns` takes what is solved
  /// for to all unknowns, and has at most one entry a row. `initial_stress`: normal stresses of the
  /// body at rest, tension positive [Pa], which new faces are relieved of. Writes `bonds`.
  CrackedBody(std::shared_ptr<Family<2>> family, double spacing,
              std::shared_ptr<BreakableElasticity<2>> elastic,
              Eigen::SparseMatrix<double> free_unknowns, BondState<2>& bonds,
              std::optional<Vector<2>> initial_stress, std::vector<CrackFacet<2>> seeds);

  /// Factors the body with its first cracks.
  void start();
  /// Cuts one more facet; false, and nothing done, where it meets no bond.
  bool cut(const CrackFacet<2>& facet);
  /// Would cut() meet a bond?
  bool is_intact_along(const CrackFacet<2>& facet) const;
  /// The bond state was replaced: builds the same body anew.
  void follow_bonds();

  /// Takes the load on what is solved for [N], cracks' faces apart.
  void set_load(const Eigen::VectorXd& load);

  /// What the cracks' faces do at a pressure in them, one value a facet.
  struct Faces {
    Eigen::VectorXd free;      ///< mean normal jump, could they pass through one another [m]
    Eigen::VectorXd opening;   ///< as it is [m], >= 0
    Eigen::VectorXd pressure;  ///< on the faces, that of contact included [Pa]
    std::vector<bool> closed;
  };
  Faces faces(const Eigen::VectorXd& pressure) const;
  /// d(free)/d(pressure) [m/Pa].
  const Eigen::MatrixXd& compliance() const { return compliance_; }

  /// Mean jumps across all facets along their normal and tangent under a pressure on the faces [m].
  std::vector<Vector<2>> jumps_under(const Eigen::VectorXd& pressure) const;

  /// All unknowns without what is prescribed, under the load and a pressure on the faces [m].
  Eigen::VectorXd unknowns(const Eigen::VectorXd& pressure) const;
  /// What the body holds and what its loads would have done, had they been there from the start
  /// [J/m]; at no back-substitution.
  struct Energies {
    double elastic;
    double load;    ///< load times displacement
    double relief;  ///< the stress that faces are relieved of, times their jumps
  };
  Energies energies(const Eigen::VectorXd& pressure) const;
  /// Force of a pressure on the faces, and of the stress they are relieved of, on all unknowns [N].
  Eigen::VectorXd face_force(const Eigen::VectorXd& pressure, bool relief = true) const;

  std::span<const FaceJump> jumps() const { return jumps_; }
  /// Normal and tangential stress that facet f is relieved of [Pa].
  Vector<2> relief(Index f) const;
  /// Mean jump across facet f in a field of all unknowns, along normal and tangent [m].
  Vector<2> jump(Index f, std::span<const double> unknowns) const;

  std::span<const CrackFacet<2>> facets() const { return bonds_.facets(); }
  /// Gradient of a displacement at all points, D * D blocks; good until the next call.
  std::span<const double> gradient(std::span<const double> unknowns);
  /// The body's bounding box goes on beyond `distance` [m] from x on all sides.
  bool reaches(const Vector<2>& x, double distance) const;

  /// Of what is solved for, with all bonds that are broken now.
  Eigen::SparseMatrix<double> free_stiffness() const;
  const Family<2>& family() const { return *family_; }
  BreakableElasticity<2>& elastic() { return *elastic_; }

 private:
  /// On the condensed unknowns.
  struct Mode {
    std::vector<std::pair<int, double>> normal;
    std::vector<std::pair<int, double>> tangent;
  };

  void cut_seeds();
  void break_bonds(std::span<const std::pair<Index, Index>> bonds);
  /// A symmetric matrix of all unknowns on those solved for.
  PointStiffness on_free(const PointStiffness& all) const;
  void add_mode(const FaceJump& jump);
  void find_compliance();
  void find_opening();
  Eigen::VectorXd block_force(const Eigen::VectorXd& pressure) const;
  Eigen::VectorXd force_on_first_body(const Eigen::VectorXd& force,
                                      const Eigen::VectorXd& block) const;

  std::shared_ptr<Family<2>> family_;
  Family<2> intact_;
  double spacing_;
  std::shared_ptr<BreakableElasticity<2>> elastic_;
  Eigen::SparseMatrix<double> free_unknowns_;
  std::vector<std::pair<int, double>> free_of_;  ///< by unknown: what moves it (-1: nothing)
  BondState<2>& bonds_;
  std::uint64_t followed_ = 0;  ///< version of the bonds that this body has
  std::vector<CrackFacet<2>> seeds_;
  std::optional<Vector<2>> initial_stress_;

  SparseCholesky factor_;
  std::unique_ptr<CondensedInverse> inverse_;
  std::vector<FaceJump> jumps_;
  std::vector<Mode> modes_;
  Eigen::MatrixXd compliance_;  ///< all faces open

  Eigen::VectorXd load_;          ///< of those solved for
  Eigen::VectorXd intact_move_;   ///< what it does to the body with its first cracks
  std::vector<double> gradient_;  // workspace
  Eigen::VectorXd loaded_;        ///< what it does now, on the condensed unknowns
  Eigen::VectorXd opening_;       ///< by load and relief, without pressure
};

}  // namespace perifrac
