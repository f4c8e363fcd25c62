#pragma once

#include <memory>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "core/solvers/complementarity.hpp"
#include "modules/solid/equilibrium/learned_slope.hpp"
#include "modules/solid/equilibrium/stiffness_multigrid.hpp"
#include "modules/solid/fracture/cracked_body.hpp"
#include "modules/solid/fracture/opening_kernel.hpp"

namespace perifrac {

/// A cracked body on a lattice that is solved for by multigrid, each time from the last answer: no
/// factor, no inverse. Time and memory go with the points. What it knows of how openings answer to
/// pressure begins as that of a body without end (opening_kernel.hpp), put right for an even
/// pressure by one solve a cut, and learns from every solve (learned_slope.hpp).
template <int D>
class IteratedBody final : public CrackedBody<D> {
 public:
  /// As CrackedBody; the body and its conditions must stay. `tolerance`: force that is left over,
  /// to the forces on the body.
  IteratedBody(const Body<D>& body, const SolidBoundary<D>& boundary,
               std::shared_ptr<Family<D>> family, std::shared_ptr<BreakableElasticity<D>> elastic,
               Eigen::SparseMatrix<double> free_unknowns, BondState<D>& bonds,
               std::optional<InitialStress<D>> initial_stress, std::vector<CrackFacet<D>> seeds,
               double tolerance, std::string why = {});

  void start() override;
  std::string path() const override;
  bool cut(const CrackFacet<D>& facet) override;
  void set_load(const Eigen::VectorXd& load) override;

  using Faces = typename CrackedBody<D>::Faces;
  using Energies = typename CrackedBody<D>::Energies;
  Faces faces(const Eigen::VectorXd& pressure) override;
  Eigen::VectorXd free_opening(const Eigen::VectorXd& pressure,
                               const Eigen::VectorXd& face_pressure) override;
  const Eigen::MatrixXd& opening_slope() override;
  void ready_slope() override;
  void renew_slope() override;
  void conclude() override;
  /// By a solve a facet.
  Eigen::MatrixXd compliance(int jump, int traction) override;
  double intensity_at_fixed_volume(Index facet) override;
  std::optional<double> find_even_answers(std::span<const Index> faces,
                                          std::span<const Index> named,
                                          std::span<double> by_pressure,
                                          std::span<double> by_shear) override;
  std::vector<Vector<D>> jumps_under(const Eigen::VectorXd& pressure,
                                     std::span<const double> shear = {}) override;
  Eigen::VectorXd unknowns(const Eigen::VectorXd& pressure,
                           std::span<const double> shear = {}) override;
  void find_unknowns(const Eigen::VectorXd& pressure, std::span<const Index> named,
                     std::span<double> all, std::span<const double> shear = {}) override;
  Energies energies(const Eigen::VectorXd& pressure, std::span<const double> shear = {}) override;
  Eigen::VectorXd stiffness_times(const Eigen::VectorXd& x) override;

  void visit_state(StateVisitor& visitor, bool load_is_steady) override;
  void on_restored() override;

  /// Conjugate gradients' so far.
  long iterations() const { return iterations_; }

 protected:
  void rebuild() override;

 private:
  using CutBody<D>::family_;
  using CutBody<D>::intact_;
  using CutBody<D>::longest_;
  using CutBody<D>::spacing_;
  using CutBody<D>::elastic_;
  using CutBody<D>::bonds_;
  using CutBody<D>::followed_;
  using CutBody<D>::seeds_;
  using CutBody<D>::jumps_;
  using CrackedBody<D>::free_unknowns_;
  using CrackedBody<D>::pressed_;

  /// An equilibrium that was found, from which the next one is.
  struct Answer {
    Eigen::VectorXd move;       ///< of all unknowns, what is prescribed left out [m]
    Eigen::VectorXd pressure;   ///< on the faces, contact's included [Pa]
    Eigen::VectorXd contact{};  ///< of that [Pa]
    std::int64_t facets = -1;   ///< that the body had; -1: it is none
    std::int64_t load = 0;      ///< digest of the load
  };
  /// What facets did at the end of a window.
  struct Concluded {
    Eigen::VectorXd opening;
    Eigen::VectorXd pressure;  ///< as Answer::pressure
    std::int64_t facets = -1;
    std::int64_t load = 0;
  };
  /// What one traction on the faces of one crack does, and nothing else.
  struct EvenAnswer {
    std::int64_t first;   ///< of the crack's facets; -1: those of all cracks
    std::int64_t axis;    ///< of the facets' frames that the traction is along
    std::int64_t facets;  ///< that the body had
    Eigen::VectorXd move;
  };

  std::int64_t facet_count() const { return static_cast<std::int64_t>(jumps_.size()); }
  Eigen::VectorXd first_contact(const Eigen::VectorXd& pressure) const;
  void learn(const Eigen::VectorXd& pressure, const Eigen::VectorXd& opening);
  /// Contact at a pressure in the cracks, and how far that is from the last answer: the largest
  /// change of an opening, of the largest opening of faces that may pass through one another.
  struct Foreseen {
    Complementarity contact;
    double change;
  };
  Foreseen foresee(const Eigen::VectorXd& pressure) const;
  void move_evenly(const Eigen::VectorXd& pressure);
  void solve_and_learn(const Eigen::VectorXd& pressure);
  Eigen::MatrixXd known_slope() const;
  bool is_of_this_body(const auto& answer) const;
  bool is_of(const auto& answer, const Eigen::VectorXd& pressure) const;
  void solve(const Eigen::VectorXd& force, double tolerance, Eigen::VectorXd& move);
  void solve(Answer& answer, const Eigen::VectorXd& pressure);
  const Answer& at(const Eigen::VectorXd& pressure, std::span<const double> shear);
  const EvenAnswer* find_even(std::int64_t first, std::int64_t axis) const;
  void solve(EvenAnswer& answer, std::span<const Index> faces);
  const EvenAnswer& even(std::span<const Index> faces, std::int64_t axis);
  const EvenAnswer& evenly_pressed();  ///< the faces of all cracks, by a pressure of 1
  Vector<D> jump_of(std::size_t f, const Answer& answer) const;
  Eigen::VectorXd openings(const Answer& answer) const;
  Eigen::VectorXd openings(const EvenAnswer& answer) const;
  std::vector<double> moduli() const;
  std::vector<Index> all_faces() const;

  const Body<D>& body_;
  SolidBoundary<D> boundary_;
  double tolerance_;
  std::string why_;
  std::vector<SymmetryPlane> planes_;
  std::optional<StiffnessMultigrid<D>> multigrid_;
  long iterations_ = 0;

  Eigen::VectorXd load_;  ///< on all unknowns [N]
  std::int64_t load_digest_ = 0;
  Eigen::MatrixXd slope_;  ///< opening_slope(), where it has as many facets as the body
  Answer aside_;           ///< of who looks on

  Answer answer_;
  Concluded concluded_;
  LearnedSlope learned_;  ///< of mean jumps
  std::vector<EvenAnswer> even_;
};

}  // namespace perifrac
