#pragma once

#include <algorithm>
#include <cassert>
#include <concepts>
#include <memory>
#include <numeric>
#include <optional>
#include <span>
#include <stdexcept>
#include <string>
#include <variant>
#include <vector>

#include <Eigen/SparseCore>

#include "core/base/law_by_region.hpp"
#include "core/base/small_vector.hpp"
#include "core/bonds/bond_traversal.hpp"
#include "core/bonds/mirror_condition.hpp"
#include "core/bonds/node_values.hpp"
#include "core/bonds/shape_tensor.hpp"
#include "core/operators/linear_exact_lattice.hpp"
#include "core/operators/nonlocal_gradient.hpp"
#include "core/operators/point_stiffness.hpp"

namespace perifrac {

/// The operator of the energy (or half the dissipation)
///   E(u) = sum_i V_i [ 1/2 F_i : C : F_i + 1/2 s_i sum_j w_ij |u_j - u_i - F_i xi|^2 ],
///   F_i = sum_j w_ij (u_j - u_i) (x) K_i^-1 xi,   s_i = stabilisation / m_i,
/// which is exact for linear fields on any cloud, surfaces included, and whose second term leaves
/// no mode but the rigid ones without energy. Its derivative A u = dE/du is a sum of bond forces
/// that are equal and opposite, so that momentum or mass is kept to rounding. Elasticity (R = D)
/// and Darcy flow (R = 1) are two laws of it.
///
/// Law: `static constexpr int components` (R), `Tensor<R, D> stress(const Tensor<R, D>& gradient)`
/// (linear, symmetric), `double stabilisation()`; where bonds may break, `double bonds_alone()`, in
/// place of `stabilisation` at a point whose bonds do not span space any more (none: 0). Where the
/// law differs from point to point, a class with `components` and `at(i)`, the law of point i
/// (law_by_region.hpp).
///
/// An unknown vector holds R blocks of point values and then the face values of the
/// MirrorCondition; rows of face values are the reactions of the faces.
///
/// What pulls at a ghost pulls at its source. Images at planes keep distances, so that the bond
/// forces of a ghost are images of its source's. Those at a sphere do not: there A is assembled,
/// for its matrix holds for ghosts of any kind, and applied as such.
template <int D, class Law>
class LinearExactOperator {
 public:
  static constexpr int R = Law::components;

  LinearExactOperator(std::shared_ptr<const Family<D>> family, MirrorCondition<D, R> mirror,
                      Law law)
      : family_(std::move(family)),
        moments_(family_moments(*family_)),
        mirror_(std::move(mirror)),
        law_(std::move(law)),
        field_(static_cast<std::size_t>(R) * family_->node_count()),
        state_(static_cast<std::size_t>(R) * D * family_->node_count()),
        bond_stiffness_(family_->node_count()) {
    find_bond_stiffness();
    for (Index i = 0; i < family_->point_count; ++i) {
      if (touches_odd_face(i)) face_points_.push_back(i);
    }
    if (family_->curved) matrix_.emplace(assemble());
    if constexpr (PacketLaw<Law, D>) {
      lattice_ = LinearExactLattice<D, R>::find(*family_, face_points_, why_no_packets_);
      take_in_lattice();
    } else {
      why_no_packets_ = "the law knows no packets";
    }
    if (!lattice_ && !matrix_) values_.read_by_rows();
  }

  const Family<D>& family() const { return *family_; }
  const MirrorCondition<D, R>& mirror() const { return mirror_; }
  const Law& law() const { return law_; }
  const FamilyMoments<D>& moments() const { return moments_; }
  /// Takes another law on the same bonds, as change(law) makes it of the present one.
  template <class Change>
  void change_law(Change&& change) {
    change(law_);
    find_bond_stiffness();
    take_in_lattice();
    if (matrix_) matrix_.emplace(assemble());
  }
  /// Bonds of these points broke: their weights are 0 in the family now. A thin family (is_thin())
  /// has no gradient, and of stiffness what the law leaves to bonds alone.
  void update(std::span<const Index> points) {
    for (const Index i : points) {
      const bool thin = set_moments(*family_, i, moments_);
      const auto place = std::ranges::lower_bound(thin_points_, i);
      const bool was_thin = place != thin_points_.end() && *place == i;
      if (was_thin && !thin) thin_points_.erase(place);
      if (thin && !was_thin) thin_points_.insert(place, i);
      bond_stiffness_[i] = thin ? thin_stiffness(i) : stiffness(i);
    }
    copy_stiffness_to_ghosts();
    if constexpr (PacketLaw<Law, D>) {
      if (lattice_) lattice_->update(*family_, moments_, bond_stiffness_, points);
    }
    if (matrix_) matrix_.emplace(assemble());
  }
  /// The same on a family of the same bonds with other weights, which differ at these points.
  void update(std::shared_ptr<const Family<D>> family, std::span<const Index> points) {
    family_ = std::move(family);
    mirror_.use(*family_);
    update(points);
  }

  /// The second derivative of the energy of point i alone.
  PointStiffness point_stiffness(Index i) const {
    const PointBonds own_bonds = family_->bonds(i);
    const Index bonds = own_bonds.count();
    const Index nodes = bonds + 1;  // the point itself is last
    using Gradient = Eigen::Matrix<double, Eigen::Dynamic, D>;
    Gradient gradient = Gradient::Zero(nodes, D);
    for (Index b = 0; b < bonds; ++b) {
      const double w = own_bonds.weight(b);
      for (int a = 0; a < D; ++a) {
        for (int c = 0; c < D; ++c) {
          gradient(b, a) += w * moments_.inverse_shape[a * D + c][i] *
                            (family_->position[c][own_bonds.other(b)] - family_->position[c][i]);
        }
      }
      gradient.row(bonds) -= gradient.row(b);
    }
    // K_i enters because the second term of the energy is s (sum_j w |u_j - u_i|^2 - F : F K).
    const double volume = family_->volume[i];
    const auto shape = shape_tensor_at(*family_, i);
    Eigen::Matrix<double, R * D, R * D> stiffness;
    for (int column = 0; column < R * D; ++column) {
      Tensor<R, D> unit{};
      unit[column] = 1.0;
      Tensor<R, D> stress = law_at(law_, i).stress(unit);
      for (int b = 0; b < D; ++b) {
        stress[column / D * D + b] -= bond_stiffness_[i] * shape[(column % D) * D + b];
      }
      for (int row = 0; row < R * D; ++row) stiffness(row, column) = volume * stress[row];
    }
    Eigen::MatrixXd matrix(R * nodes, R * nodes);
    for (int row = 0; row < R; ++row) {
      for (int column = 0; column < R; ++column) {
        const Eigen::Matrix<double, D, Eigen::Dynamic> stress =
            stiffness.template block<D, D>(row * D, column * D).lazyProduct(gradient.transpose());
        matrix.block(row * nodes, column * nodes, nodes, nodes) = gradient.lazyProduct(stress);
      }
    }
    for (int r = 0; r < R; ++r) {
      const Index own = r * nodes + bonds;
      for (Index b = 0; b < bonds; ++b) {
        const double pull = volume * bond_stiffness_[i] * own_bonds.weight(b);
        const Index other = r * nodes + b;
        matrix(other, other) += pull;
        matrix(own, own) += pull;
        matrix(other, own) -= pull;
        matrix(own, other) -= pull;
      }
    }
    return on_unknowns(*family_, mirror_, i, matrix);
  }

  /// Adds the unknowns that the gradient and the energy of point i depend on.
  void append_unknowns(Index i, std::vector<Index>& unknowns) const {
    append_family_unknowns(*family_, mirror_, i, unknowns);
  }

  /// The energy of point i alone in the field that is looked at.
  double energy(Index i) const {
    const Tensor<R, D> f = gradient_at(i);
    const Tensor<R, D> stress = law_at(law_, i).stress(f);
    double density = 0.0;
    for (int k = 0; k < R * D; ++k) density += f[k] * stress[k];
    return 0.5 * family_->volume[i] * density + rest_energy(i, f);
  }

  /// The part of it that a field has beyond its gradient f at the point.
  double rest_energy(Index i, const Tensor<R, D>& f) const {
    const auto rest = sum_over_bonds<1>(*family_, i, [&](Index j, const Vector<D>& xi, double w) {
      std::array<double, 1> square{};
      for (int r = 0; r < R; ++r) {
        double difference = field(r)[j] - field(r)[i];
        for (int b = 0; b < D; ++b) difference -= f[r * D + b] * xi[b];
        square[0] += w * difference * difference;
      }
      return square;
    });
    return 0.5 * family_->volume[i] * bond_stiffness_[i] * rest[0];
  }

  double weighted_volume(Index i) const { return moments_.weighted_volume[i]; }
  Index point_unknowns() const { return R * family_->point_count; }
  Index size() const { return point_unknowns() + mirror_.face_value_count(); }

  /// result = A u = dE/du without forming A; both of size().
  void apply(std::span<const double> u, std::span<double> result) {
    if (matrix_) {
      for_each_point(size(), [&](Index row) {
        double sum = 0.0;
        for (typename Matrix::InnerIterator entry(*matrix_, row); entry; ++entry) {
          sum += entry.value() * u[entry.col()];
        }
        result[row] = sum;
      });
    } else {
      apply(u, result, [](auto, const auto&, auto&) {});
    }
  }

  /// The same with the stress that add(i, gradient, stress) makes of the law's at every point; not
  /// for curved ghosts. Where bonds lie on a lattice i is a PointPacket and the others are packets,
  /// unless add takes none. `written`: what add writes at its points, blocks of point_count.
  template <class AddStress>
  void apply(std::span<const double> u, std::span<double> result, AddStress&& add,
             std::span<double> written = {}) {
    assert(static_cast<Index>(u.size()) == size() && u.size() == result.size());
    if (matrix_) throw std::logic_error("an added stress beside curved ghosts");
    look_at(u);
    if constexpr (PacketLaw<Law, D> &&
                  std::invocable<AddStress, PointPacket, const Packets&, Packets&>) {
      if (lattice_) {
        lattice_->apply(law_, add, mirror_, field_, state_, result.first(point_unknowns()),
                        written);
        add_face_reactions(result.subspan(point_unknowns()));
        return;
      }
    }
    const Index points = family_->point_count;
    for_each_shared_point(points, [&](Index i) { store_state(i, add); });
    for (int k = 0; k < R * D; ++k) ranks::gather_shares({state(k), state(k) + points}, points);
    ranks::gather_shares(written, points);
    mirror_.fill_conjugate(state_);
    put_state();
    for_each_shared_point(points, [&](Index i) {
      const std::array<double, R> force = bond_forces(i);
      for (int r = 0; r < R; ++r) result[static_cast<std::size_t>(r) * points + i] = -force[r];
    });
    ranks::gather_shares(result.first(point_unknowns()), points);
    add_face_reactions(result.subspan(point_unknowns()));
  }

  /// How apply() goes over the bonds, and why.
  std::string path() const {
    if (matrix_) return "a sparse matrix: " + why_no_packets_;
    if (values_.reads_rows()) return packets_of_bonds() + why_no_packets_;
    if (!lattice_) return "bond by bond: " + why_no_packets_;
    if constexpr (PacketLaw<Law, D>) return lattice_->bonds().path();
    return {};
  }

  /// Takes the field that gradient_at() and energy() are of; apply() and gradient() do so too.
  void look_at(std::span<const double> u) {
    mirror_.spread(u, field_);
    std::array<std::span<const double>, D + R> columns;
    for (int a = 0; a < D; ++a) columns[a] = family_->position[a];
    for (int r = 0; r < R; ++r) columns[D + r] = {field(r), bond_stiffness_.size()};
    values_.template put<0>(columns);
  }

  /// Gradient of the field at a point.
  Tensor<R, D> gradient_at(Index i) const {
    std::array<double, R> own;
    for (int r = 0; r < R; ++r) own[r] = field(r)[i];
    return values_.with([&](const auto& values) {
      return perifrac::gradient_at<R, D>(*family_, moments_.inverse_shape_at(i), values, own, i);
    });
  }

  /// Gradient of the field at every point: R * D blocks of point_count, block r * D + b.
  void gradient(std::span<const double> u, std::span<double> result) {
    look_at(u);
    if constexpr (PacketLaw<Law, D>) {
      if (lattice_) return lattice_->gradient(field_, result);
    }
    const Index points = family_->point_count;
    for_each_shared_point(points, [&](Index i) {
      const Tensor<R, D> f = gradient_at(i);
      for (int k = 0; k < R * D; ++k) result[static_cast<std::size_t>(k) * points + i] = f[k];
    });
    ranks::gather_shares(result, points);
  }

  /// A as a sparse matrix, both halves.
  Eigen::SparseMatrix<double> assemble() const {
    return sum_of_points(*this, family_->point_count);
  }

  /// ForceOfStress on its bonds.
  Eigen::VectorXd force_of_stress(const Eigen::VectorXd& stress) const {
    return perifrac::force_of_stress<D, R>(
        *family_, [this](Index i) { return moments_.inverse_shape_at(i); }, mirror_, stress);
  }

  /// The matrix that takes an unknown vector to its gradient, rows as in gradient().
  Eigen::SparseMatrix<double> gradient_matrix() const {
    return perifrac::gradient_matrix(*family_, moments_, mirror_);
  }

 private:
  using Matrix = Eigen::SparseMatrix<double, Eigen::RowMajor>;
  using Packets = std::array<Packet, static_cast<std::size_t>(R* D)>;

  /// Position, field, bond stiffness, state.
  static constexpr int value_count = D + R + 1 + R * D;

  void put_state() {
    std::array<std::span<const double>, 1 + R * D> columns;
    columns[0] = bond_stiffness_;
    for (int k = 0; k < R * D; ++k) columns[1 + k] = {state(k), bond_stiffness_.size()};
    values_.template put<D + R>(columns);
  }

  void take_in_lattice() {
    if constexpr (PacketLaw<Law, D>) {
      if (!lattice_) return;
      std::vector<Index> all(family_->point_count);
      std::iota(all.begin(), all.end(), 0);
      lattice_->take(*family_, moments_, bond_stiffness_, all);
    }
  }

  void find_bond_stiffness() {
    for_each_point(family_->point_count, [&](Index i) { bond_stiffness_[i] = stiffness(i); });
    for (const Index i : thin_points_) bond_stiffness_[i] = thin_stiffness(i);
    copy_stiffness_to_ghosts();
  }
  void copy_stiffness_to_ghosts() {
    for (Index g = 0; g < family_->ghost_count(); ++g) {
      bond_stiffness_[family_->point_count + g] = bond_stiffness_[family_->ghost_source[g]];
    }
  }

  double stiffness(Index i) const {
    return law_at(law_, i).stabilisation() / moments_.weighted_volume[i];
  }
  double thin_stiffness(Index i) const {
    const auto& law = law_at(law_, i);
    if constexpr (requires { law.bonds_alone(); }) {
      return law.bonds_alone() / moments_.weighted_volume[i];
    }
    return 0.0;
  }

  const double* field(int r) const {
    return field_.data() + static_cast<std::size_t>(r) * family_->node_count();
  }
  double* state(int k) {
    return state_.data() + static_cast<std::size_t>(k) * family_->node_count();
  }
  const double* state(int k) const {
    return state_.data() + static_cast<std::size_t>(k) * family_->node_count();
  }

  /// What a point contributes to the force of its bonds: (C : F K^-1 - s F) xi + s (u_j - u_i).
  template <class AddStress>
  void store_state(Index i, AddStress&& add) {
    const Tensor<R, D> f = gradient_at(i);
    Tensor<R, D> stress = law_at(law_, i).stress(f);
    add(i, f, stress);
    stress = times_inverse_shape<R, D>(stress, moments_.inverse_shape_at(i));
    for (int k = 0; k < R * D; ++k) state(k)[i] = stress[k] - bond_stiffness_[i] * f[k];
  }

  std::array<double, R> bond_forces(Index i) const {
    const double own_stiffness = bond_stiffness_[i];
    Tensor<R, D> own_state;
    std::array<double, R> own;
    for (int k = 0; k < R * D; ++k) own_state[k] = state(k)[i];
    for (int r = 0; r < R; ++r) own[r] = field(r)[i];
    std::array<double, R> force = values_.with([&](const auto& values) {
      return sum_over_bonds<R, value_count>(
          *family_, i, values, [&](auto, const auto& other, const auto& xi, const auto& w) {
            std::array<std::decay_t<decltype(w)>, R> t;
            const auto stiffness = own_stiffness + other[D + R];
            for (int r = 0; r < R; ++r) {
              t[r] = stiffness * (other[D + r] - own[r]);
              for (int b = 0; b < D; ++b) {
                const int k = r * D + b;
                t[r] += (own_state[k] + other[D + R + 1 + k]) * xi[b];
              }
              t[r] *= w;
            }
            return t;
          });
    });
    for (double& component : force) component *= family_->volume[i];
    return force;
  }

  bool touches_odd_face(Index i) const {
    const PointBonds bonds = family_->bonds(i);
    for (Index b = family_->first_ghost_bond(i); b < bonds.count(); ++b) {
      const Index ghost = bonds.other(b) - family_->point_count;
      for (int r = 0; r < R; ++r) {
        if (mirror_.image(family_->ghost_faces[ghost], r).term_count > 0) return true;
      }
    }
    return false;
  }

  /// dE/dU of the face values: their part in the ghosts at the end of real points' bonds. Serial,
  /// so that the order of the sum is fixed; few points touch a face.
  void add_face_reactions(std::span<double> reaction) {
    std::ranges::fill(reaction, 0.0);
    const Index points = family_->point_count;
    for (const Index i : face_points_) {
      const PointBonds bonds = family_->bonds(i);
      for (Index bond = family_->first_ghost_bond(i); bond < bonds.count(); ++bond) {
        const Index j = bonds.other(bond);
        for (int r = 0; r < R; ++r) {
          const auto& image = mirror_.image(family_->ghost_faces[j - points], r);
          if (image.term_count == 0) continue;
          double force = bond_stiffness_[i] * (field(r)[j] - field(r)[i]);
          for (int b = 0; b < D; ++b) {
            force += state(r * D + b)[i] * (family_->position[b][j] - family_->position[b][i]);
          }
          force *= family_->volume[i] * bonds.weight(bond);
          for (int k = 0; k < image.term_count; ++k) {
            reaction[image.terms[k].face_value] += image.terms[k].coefficient * force;
          }
        }
      }
    }
  }

  std::shared_ptr<const Family<D>> family_;
  FamilyMoments<D> moments_;
  MirrorCondition<D, R> mirror_;
  Law law_;
  std::vector<double> field_;           ///< u on real points and ghosts
  std::vector<double> state_;           ///< store_state() on real points and ghosts
  NodeValues<D, value_count> values_;   ///< all that
  std::vector<double> bond_stiffness_;  ///< s_i on real points and ghosts
  using Lattice = std::conditional_t<PacketLaw<Law, D>, LinearExactLattice<D, R>, std::monostate>;
  std::optional<Lattice> lattice_;  ///< where bonds lie on one
  std::string why_no_packets_;
  std::vector<Index> face_points_;  ///< points with a bond to an odd ghost
  std::vector<Index> thin_points_;  ///< ascending; none where nothing breaks
  std::optional<Matrix> matrix_;    ///< A, where ghosts are curved
};

}  // namespace perifrac
