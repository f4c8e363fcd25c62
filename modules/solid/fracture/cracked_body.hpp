#pragma once

#include <optional>
#include <span>
#include <string>
#include <utility>
#include <vector>

#include <Eigen/Core>
#include <Eigen/SparseCore>

#include "modules/solid/fracture/cut_body.hpp"
#include "modules/solid/fracture/partial_cuts.hpp"

namespace perifrac {

/// A linear elastic body in equilibrium, in 2D in plane strain, while cracks cut its bonds facet by
/// facet. The faces of a crack carry the pressure of what is in it and, where they close, the
/// pressure of contact, which keeps them from passing through one another; in 2D also the shear of
/// friction, where the scene has it (crack_friction.hpp). How the equilibrium is found is told by
/// what derives from it: by a factor (condensed_body.hpp) or without one (iterated_body.hpp).
template <int D>
class CrackedBody : public CutBody<D> {
 public:
  /// As CutBody; `free_unknowns` takes what is solved for to all unknowns, and has at most one
  /// entry a row.
  CrackedBody(std::shared_ptr<Family<D>> family, double spacing,
              std::shared_ptr<BreakableElasticity<D>> elastic,
              Eigen::SparseMatrix<double> free_unknowns, BondState<D>& bonds,
              std::optional<InitialStress<D>> initial_stress, std::vector<CrackFacet<D>> seeds);

  /// Readies the body with its first cracks. Throws NotPositiveDefinite.
  virtual void start() = 0;
  /// How it is solved for, and why.
  virtual std::string path() const = 0;
  /// Throws PieceCutFree where that leaves a piece that nothing holds, NotPositiveDefinite where
  /// one too thin to bear anything; then nothing has changed.
  bool cut(const CrackFacet<D>& facet) override = 0;
  /// The bond state was replaced: builds the same body anew.
  void follow_bonds();

  /// It knows its answers without the last cuts as well as with them.
  virtual bool may_be_partly_cut() const { return false; }
  /// These facets, which are cut, are so in part from now on, all others whole.
  virtual void set_partial(std::span<const PartialCut>) {}
  /// Those, and how they answer.
  virtual const PartialCuts& partial() const;
  /// Changes with every set_partial().
  std::uint64_t partial_version() const { return partial_version_; }
  /// What loads do at each partial cut, under these on all faces.
  virtual std::vector<CutLoad> cut_loads(const Eigen::VectorXd& /*pressure*/,
                                         std::span<const double> /*shear*/) {
    return {};
  }
  /// What partial cuts add to what the cut body does with moves and faces' loads like these.
  struct Held {
    double elastic = 0.0;     ///< [J]
    double relief = 0.0;      ///< Energies::relief [J]
    Eigen::VectorXd force{};  ///< what holds them, less what faces do there; empty: none [N]
  };
  virtual Held held(std::span<const double> /*unknowns*/, const Eigen::VectorXd& /*pressure*/,
                    std::span<const double> /*shear*/) {
    return {};
  }

  /// Pieces of the body that nothing holds.
  std::vector<std::vector<Index>> loose_pieces();

  /// Takes the load on what is solved for [N], cracks' faces apart.
  virtual void set_load(const Eigen::VectorXd& load) = 0;

  /// What the cracks' faces do at a pressure in them, one value a facet.
  struct Faces {
    Eigen::VectorXd opening;   ///< [m], >= 0
    Eigen::VectorXd pressure;  ///< on the faces, that of contact included [Pa]
    std::vector<bool> closed;
    std::vector<double> shear{};  ///< on the faces, along their tangent; empty: no friction [Pa]
    std::vector<double> slip{};   ///< with friction, by CrackFriction [m]
  };
  /// Without friction. Throws NoContact, NotConverged.
  virtual Faces faces(const Eigen::VectorXd& pressure) = 0;
  /// The openings of faces that may pass through one another [m]: what they are under
  /// `face_pressure`, with contact, less opening_slope() times what that adds to `pressure`.
  virtual Eigen::VectorXd free_opening(const Eigen::VectorXd& pressure,
                                       const Eigen::VectorXd& face_pressure) = 0;
  /// About d(free_opening)/d(pressure) [m/Pa].
  virtual const Eigen::MatrixXd& opening_slope() = 0;
  /// Finds what that takes of the present cracks, so that who looks at it later need not.
  virtual void ready_slope() {}
  /// A window begins: what answers have shown goes into opening_slope(), which is then the same
  /// from pass to pass.
  virtual void renew_slope() {}
  /// A window has ended.
  virtual void conclude() {}
  /// What faces do along one axis of the facets' frames (0: normal) by tractions along another
  /// [m/Pa]. Openings are mean normal jumps and what pressed_by() puts back.
  virtual Eigen::MatrixXd compliance(int jump, int traction) = 0;
  /// The same of all axes, one beside and below the other, were partial cuts whole,
  virtual Eigen::MatrixXd whole_compliance();
  /// and what comes to it as they are.
  virtual LowRankChange compliance_change() { return {}; }

  // Of a pressure on the faces and, unless it is empty, a shear along their (first) tangent:

  /// Openings of all facets, and how far they slide along their tangents [m].
  virtual std::vector<Vector<D>> jumps_under(const Eigen::VectorXd& pressure,
                                             std::span<const double> shear = {}) = 0;
  /// All unknowns without what is prescribed, under the load too [m].
  virtual Eigen::VectorXd unknowns(const Eigen::VectorXd& pressure,
                                   std::span<const double> shear = {}) = 0;
  /// The same, those named only, which alone are written: cheap where they lie close together.
  virtual void find_unknowns(const Eigen::VectorXd& pressure, std::span<const Index> named,
                             std::span<double> all, std::span<const double> shear = {}) = 0;
  /// What the body holds and what its loads would have done, had they been there from the start
  /// [J], in 2D per metre.
  struct Energies {
    double elastic;
    double load;    ///< load times displacement
    double relief;  ///< the stress that faces are relieved of, times their jumps
  };
  virtual Energies energies(const Eigen::VectorXd& pressure,
                            std::span<const double> shear = {}) = 0;
  /// Of that, what is in the rock that openings put back, and the work of relief there.
  Energies pressed_energies(const Eigen::VectorXd& pressure) const;
  /// Force of the faces, and of the stress they are relieved of, on all unknowns [N].
  Eigen::VectorXd face_force(const Eigen::VectorXd& pressure, bool relief = true,
                             std::span<const double> shear = {}) const;

  /// Takes what is solved for to all unknowns.
  const Eigen::SparseMatrix<double>& free_unknowns() const { return free_unknowns_; }
  /// The stiffness on what is solved for, with all bonds that are broken now, times x.
  virtual Eigen::VectorXd stiffness_times(const Eigen::VectorXd& x) = 0;

  /// What it goes on from beside cuts and load. `load_is_steady`: set_load() brings one and the
  /// same.
  virtual void visit_state(StateVisitor&, bool /*load_is_steady*/) {}
  /// Such a state was restored.
  virtual void on_restored() {}

 protected:
  /// As start(), of a state that goes on.
  virtual void rebuild() { start(); }

  using CutBody<D>::family_;
  using CutBody<D>::intact_;
  using CutBody<D>::longest_;
  using CutBody<D>::spacing_;
  using CutBody<D>::elastic_;
  using CutBody<D>::bonds_;
  using CutBody<D>::followed_;
  using CutBody<D>::seeds_;
  using CutBody<D>::jumps_;

  void check_pieces(std::span<const std::pair<Index, Index>> cut);
  void add_jump(const FaceJump<D>& jump);
  /// Of the facets; per metre in 2D.
  Eigen::VectorXd areas() const;
  /// Of the same traction on the faces named, along normal and tangents [Pa], on all unknowns [N].
  Eigen::VectorXd traction_force(std::span<const Index> faces, const Vector<D>& traction) const;
  Vector<D> face_load(std::size_t f, double pressure, std::span<const double> shear,
                      bool relief = true) const;

  Eigen::SparseMatrix<double> free_unknowns_;
  std::vector<double> pressed_;  ///< pressed_by(), by facet, of a partial cut in part
  std::uint64_t partial_version_ = 0;

 private:
  void add_force(std::size_t f, const Vector<D>& load, Eigen::VectorXd& force) const;
};

}  // namespace perifrac
