#pragma once

#include <optional>
#include <span>
#include <vector>

#include <Eigen/Core>
#include <Eigen/LU>

#include "core/base/points.hpp"
#include "core/solvers/low_rank_change.hpp"

namespace perifrac {

/// A facet that a tip is within.
struct PartialCut {
  Index facet;
  /// How far the body's answers are from those without the cut to those with it: 0 to 1, and a
  /// little beyond, where a tip is looked for that has gone further.
  double opened;

  bool operator==(const PartialCut&) const = default;
};

/// What loads do at a partial cut, its own faces' apart, and at its faces; linear in the loads.
struct CutLoad {
  Eigen::VectorXd borne;     ///< moves of what its cut changes, were it cut [m]
  Eigen::VectorXd apart;     ///< jump of its faces, were it cut, all loads acting [m]
  Eigen::VectorXd traction;  ///< of its faces, what they are relieved of included [Pa]
};

/// How a linear elastic body answers whose facets are cut in part: between without the cut and with
/// it, for all loads alike,
///   answer = answer(uncut) + opened (answer(cut) - answer(uncut)),
/// where the faces of the facet are loaded in the cut one alone. That is a stiffness of its own
/// across the cut: with K and A = 1 / K of the cut body and `less` = K(uncut) - K = V d V^T,
///   K(opened) = K + V H V^T,  H = (1 - opened) d G / (opened + (1 - opened) G),  G = 1 / (1 + d),
/// all diagonal where V^T A V = 1,
/// so that energies follow, and that several cuts act together. H of each is as if the others were
/// cut. A traction q of the facet's faces, with mean jumps m^T u, becomes a force f q and an
/// opening of the facet's own E q,
///   f = opened (m + V H V^T A m),  E = opened m^T A m - f^T A(opened) f.
class PartialCuts {
 public:
  /// Of one cut, on places of the body's condensed block.
  struct Cut {
    PartialCut at;
    double area;     ///< [m^2]
    double pressed;  ///< CutBody::pressed_by() [m/Pa]
    std::vector<int> places;
    Eigen::MatrixXd less;   ///< stiffness that the cut took, on `places`
    Eigen::MatrixXd modes;  ///< mean jumps by moves of `places`, a column an axis
  };

  bool empty() const { return parts_.empty(); }
  std::size_t count() const { return parts_.size(); }
  const PartialCut& at(std::size_t k) const { return parts_[k].at; }
  /// `block`: of A, of the body with all its facets cut.
  void take(std::vector<Cut> cuts, const Eigen::MatrixXd& block);
  /// `rows[axis]`: mean jumps of all facets times columns(); `area`: theirs.
  void tell(std::vector<Eigen::MatrixXd> rows, Eigen::VectorXd area);
  /// Of each, in their order.
  void open(std::span<const double> opened);

  /// Of the held body, from that of the cut one: moves by forces, each on the block.
  Eigen::VectorXd held(const Eigen::VectorXd& moved) const;
  /// What holds the cuts together, as a force on the block [N].
  Eigen::VectorXd force(const Eigen::VectorXd& block) const;
  /// Force of unit tractions along one axis [N/Pa], on the block of that size.
  Eigen::VectorXd traction_force(std::size_t k, int axis, Eigen::Index size) const;
  /// An opening of the facet's own, by tractions on its faces [m/Pa], an axis a row.
  Eigen::MatrixXd own_compliance(std::size_t k) const;
  /// Jumps of its faces by tractions on them, were it cut [m/Pa], an axis a row.
  Eigen::MatrixXd whole_compliance(std::size_t k) const;

  /// Takes a compliance of the cut body, jumps along one axis by tractions along another, to that
  /// of the held one.
  void hold(Eigen::MatrixXd& compliance, int jump, int traction);
  /// Places of the cuts' own faces where all axes are beside and below one another.
  std::vector<Eigen::Index> own_places() const;
  /// What comes to such a compliance, what openings put back in it. `by_own`, `at_own`: those of
  /// the cut body by loads on own faces, and of them by all loads, without what openings put back;
  /// a column an own place.
  LowRankChange change(const Eigen::MatrixXd& by_own, const Eigen::MatrixXd& at_own);
  /// What moves of the block a force on each cut's unknowns does, in the order of an inner basis.
  const Eigen::MatrixXd& columns() const { return columns_; }

  /// Where the held body has moved so, and its faces carry this [Pa].
  CutLoad load(std::size_t k, const Eigen::VectorXd& block, const Eigen::VectorXd& traction) const;
  /// What cutting it whole would set free, twice, bilinear in two loads [J], in 2D per metre.
  double release(std::size_t k, const CutLoad& one, const CutLoad& other) const;
  /// In what holds them, where the held body has moved so [J].
  double energy(const Eigen::VectorXd& block) const;

 private:
  struct Part {
    PartialCut at;
    double area, pressed;
    std::vector<int> places;
    Eigen::MatrixXd basis;  ///< V, then the mean jumps; on the places
    Eigen::VectorXd less;   ///< d
    Eigen::Index first = 0, rank = 0;
    Eigen::VectorXd softened;  ///< G
    Eigen::VectorXd held;      ///< H
    Eigen::MatrixXd acting;    ///< f of unit tractions, in the basis
    Eigen::MatrixXd own;       ///< E
  };

  Eigen::VectorXd in_basis(const Part& part, const Eigen::VectorXd& block) const;
  Eigen::MatrixXd by_own_faces(const Part& part) const;
  Eigen::MatrixXd own_jumps(const Part& part) const;
  void set(Part& part, double opened);
  void factor();
  /// What tractions along one axis do, in the basis; columns of facets, or of cuts.
  struct Answer {
    Eigen::MatrixXd of_facets;  ///< taken() of the jumps of all facets
    Eigen::MatrixXd acting;     ///< f of each cut
    Eigen::MatrixXd of_cuts;    ///< that less what is taken of its moves
  };
  const Answer& answer(int axis);
  Eigen::MatrixXd taken(const Eigen::MatrixXd& moved) const;

  std::vector<Part> parts_;
  Eigen::MatrixXd columns_;                        ///< A times all bases
  Eigen::MatrixXd gram_;                           ///< all bases^T A times all bases
  Eigen::MatrixXd between_;                        ///< of that, one V with another
  Eigen::VectorXd alone_;                          ///< 1 / (1 / H + 1); 0 at mean jumps
  Eigen::PartialPivLU<Eigen::MatrixXd> together_;  ///< 1 + alone between; not of a single cut
  std::vector<Eigen::MatrixXd> rows_;
  Eigen::VectorXd area_;
  std::vector<std::optional<Answer>> answers_;  ///< by axis, where it was asked for
};

}  // namespace perifrac
