#pragma once

#include <array>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <utility>
#include <vector>

#include "core/solvers/condensed_inverse.hpp"
#include "core/solvers/sparse_cholesky.hpp"
#include "modules/solid/fracture/cracked_body.hpp"

namespace perifrac {

/// A cracked body whose stiffness with its first cracks is factored once; every later facet is a
/// low-rank change of it. Slopes are exact. Memory and time are those of the factor.
template <int D>
class CondensedBody final : public CrackedBody<D> {
 public:
  /// As CrackedBody.
  CondensedBody(std::shared_ptr<Family<D>> family, double spacing,
                std::shared_ptr<BreakableElasticity<D>> elastic,
                Eigen::SparseMatrix<double> free_unknowns, BondState<D>& bonds,
                std::optional<InitialStress<D>> initial_stress, std::vector<CrackFacet<D>> seeds,
                std::string why = {});

  void start() override;
  std::string path() const override { return "a factor of the stiffness" + why_; }
  bool cut(const CrackFacet<D>& facet) override;
  void set_load(const Eigen::VectorXd& load) override;

  bool may_be_partly_cut() const override { return true; }
  void set_partial(std::span<const PartialCut> cuts) override;
  const PartialCuts& partial() const override { return partial_; }
  std::vector<CutLoad> cut_loads(const Eigen::VectorXd& pressure,
                                 std::span<const double> shear) override;
  using Held = typename CrackedBody<D>::Held;
  Held held(std::span<const double> unknowns, const Eigen::VectorXd& pressure,
            std::span<const double> shear) override;
  std::vector<Vector<D>> jumps_by(std::span<const Vector<D>> tractions) override;

  using Faces = typename CrackedBody<D>::Faces;
  using Energies = typename CrackedBody<D>::Energies;
  Faces faces(const Eigen::VectorXd& pressure) override;
  /// Exact, whatever the face pressure.
  Eigen::VectorXd free_opening(const Eigen::VectorXd& pressure,
                               const Eigen::VectorXd& = {}) override;
  const Eigen::MatrixXd& opening_slope() override { return compliance_; }
  /// d(free_opening)/d(pressure) [m/Pa].
  const Eigen::MatrixXd& compliance() const { return compliance_; }
  Eigen::MatrixXd compliance(int jump, int traction) override;
  Eigen::MatrixXd whole_compliance() override;
  LowRankChange compliance_change() override;
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
  /// At no back-substitution.
  Energies energies(const Eigen::VectorXd& pressure, std::span<const double> shear = {}) override;

  /// Of what is solved for, with all bonds that are broken now; kept for start().
  const Eigen::SparseMatrix<double>& free_stiffness();
  Eigen::VectorXd stiffness_times(const Eigen::VectorXd& x) override {
    return free_stiffness() * x;
  }

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
  using CrackedBody<D>::partial_version_;

  /// A facet's jump along its normal and tangents, of the condensed unknowns and sums.
  using Mode = std::array<std::vector<std::pair<int, double>>, D>;

  /// A symmetric matrix of all unknowns on those solved for.
  PointStiffness on_free(const PointStiffness& all) const;
  /// What a change of stiffness takes and what it gives.
  struct Parts {
    std::vector<PointStiffness> less, more;
  };
  void change_stiffness(const Parts& parts);
  UnknownSum sum_of(const FaceJump<D>& jump, int axis) const;
  void add_seeds();
  void add_mode(const FaceJump<D>& jump);
  Mode mode_of(const FaceJump<D>& jump) const;
  void find_opening();
  void find_cut_loaded();
  void find_free_opening();
  void find_compliance();
  const Eigen::MatrixXd& whole_compliance(int jump, int traction);
  void take_partial(std::span<const PartialCut> cuts);
  void hold_partial();
  PartialCuts::Cut partial_cut(const PartialCut& cut) const;
  Eigen::VectorXd moved_by(const Eigen::VectorXd& force) const;
  std::vector<Vector<D>> face_loads(const Eigen::VectorXd& pressure,
                                    std::span<const double> shear) const;
  std::vector<Vector<D>> jumps_at(const Eigen::VectorXd& block,
                                  std::span<const Vector<D>> loads) const;
  Eigen::VectorXd own_jump(std::size_t k, const Vector<D>& load) const;
  Eigen::VectorXd force_of(std::span<const Vector<D>> loads) const;
  Eigen::VectorXd block_force(const Eigen::VectorXd& pressure,
                              std::span<const double> shear = {}) const;
  Eigen::MatrixXd solve_named(const Eigen::MatrixXd& force, std::span<const Index> named) const;
  Eigen::VectorXd block_force_on_first_body(const Eigen::VectorXd& force,
                                            const Eigen::VectorXd& block) const;
  const Eigen::VectorXd& intact_move();

  std::string why_;
  std::vector<std::pair<int, double>> free_of_;  ///< by unknown: what moves it (-1: nothing)

  Eigen::SparseMatrix<double> stiffness_;  ///< until start() has factored it
  SparseCholesky factor_;
  std::unique_ptr<CondensedInverse> inverse_;
  std::vector<Mode> modes_;
  std::vector<int> change_of_;  ///< by facet after the first cracks': place in inverse_->changes()
  Eigen::MatrixXd compliance_;

  PartialCuts partial_;
  /// Were partial cuts whole; by jump and traction, empty until it is asked for.
  std::array<Eigen::MatrixXd, D * D> whole_compliance_;

  Eigen::VectorXd load_;         ///< of those solved for
  Eigen::VectorXd begun_;        ///< half of the way to what it does
  Eigen::VectorXd intact_move_;  ///< that, to the body with its first cracks; empty: not asked for
  Eigen::VectorXd cut_loaded_;   ///< what it does to the cut body, on the condensed unknowns
  Eigen::VectorXd loaded_;       ///< what it does now, likewise
  Eigen::VectorXd opening_;      ///< by load and relief, without pressure
};

}  // namespace perifrac
