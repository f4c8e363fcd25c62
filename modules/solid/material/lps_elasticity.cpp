#include "modules/solid/material/lps_elasticity.hpp"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <numeric>

#include "core/base/small_vector.hpp"
#include "core/bonds/bond_traversal.hpp"
#include "core/operators/node_unknowns.hpp"
#include "core/operators/nonlocal_gradient.hpp"
#include "modules/solid/material/bond_energy.hpp"

namespace perifrac {

namespace {

template <int D>
constexpr double bonds_per_shear_modulus = D == 2 ? 8.0 : 15.0;  // c / mu

/// Of one node, or of a packet.
double number_of(const double* values, Index j) { return values[j]; }
Packet number_of(const double* values, const Index* j) { return gather(values, j); }

}  // namespace

template <int D>
LpsElasticity<D>::LpsElasticity(std::shared_ptr<const Family<D>> family,
                                MirrorCondition<D, D> mirror,
                                LawByRegion<IsotropicElasticity<D>> law,
                                std::optional<Vector<D>> initial_stress, double pore_sign)
    : family_(std::move(family)),
      mirror_(std::move(mirror)),
      law_(std::move(law)),
      initial_stress_(initial_stress),
      pore_sign_(pore_sign),
      is_thin_(family_->point_count, false),
      field_(static_cast<std::size_t>(D) * family_->node_count()),
      dilatation_scale_(family_->point_count),
      bond_stiffness_(family_->node_count(), 0.0),
      volume_state_(family_->node_count(), 0.0) {
  const Index points = family_->point_count;
  if (initial_stress_) {
    initial_state_.resize(static_cast<std::size_t>(D) * D * family_->node_count());
  }
  const FamilyMoments<D> moments = family_moments(*family_);
  for (Index i = 0; i < points; ++i) {
    take_moments(i, moments.weighted_volume[i]);
    if (family_->first_ghost_bond(i) < family_->bond_count(i)) face_points_.push_back(i);
  }
  for (const FaceSet faces : family_->ghost_faces) {
    Vector<D> sign;
    for (int r = 0; r < D; ++r) {
      const bool reflected = contains(faces, 2 * r) != contains(faces, 2 * r + 1);
      sign[r] = (reflected ? -1.0 : 1.0) * mirror_.image(faces, r).sign;
    }
    image_sign_.push_back(sign);
  }
  if (initial_stress_) mirror_.fill_conjugate(initial_state_);
  lattice_ = LpsLattice<D>::find(*family_, why_no_packets_);
  if (!lattice_) values_.read_by_rows();
  std::vector<Index> all(points);
  std::iota(all.begin(), all.end(), 0);
  give_to_lattice([&](const auto& rock) { lattice_->take(rock, all); });
}

/// Found where it is asked for: few points' gradients are.
template <int D>
Tensor<D, D> LpsElasticity<D>::inverse_shape_at(Index i) const {
  if (is_thin_[i] || family_->bond_count(i) == 0) return {};
  return perifrac::inverse_shape_at(*family_, i);
}

/// What follows from the moments of a point's family.
template <int D>
void LpsElasticity<D>::take_moments(Index i, double weighted_volume) {
  dilatation_scale_[i] = D / weighted_volume;
  bond_stiffness_[i] = bonds_per_shear_modulus<D> * law_.at(i).shear_modulus / weighted_volume;
  if (!initial_stress_) return;
  const Tensor<D, D> inverse = inverse_shape_at(i);
  for (int k = 0; k < D * D; ++k) {
    initial_state_[static_cast<std::size_t>(k) * family_->node_count() + i] =
        (*initial_stress_)[k / D] * inverse[k];
  }
}

template <int D>
void LpsElasticity<D>::update(std::span<const Index> points) {
  for (const Index i : points) {
    is_thin_[i] = is_thin(*family_, i);
    take_moments(i, weighted_volume(*family_, i));
  }
  if (initial_stress_) mirror_.fill_conjugate(initial_state_);
  give_to_lattice([&](const auto& rock) { lattice_->update(*family_, rock, points); });
}

template <int D>
template <class Take>
void LpsElasticity<D>::give_to_lattice(Take&& take) {
  if (!lattice_) return;
  std::vector<double> stiffness(family_->point_count);
  for_each_point(family_->point_count, [&](Index i) { stiffness[i] = dilatation_stiffness(i); });
  take(typename LpsLattice<D>::Rock{dilatation_scale_, bond_stiffness_, stiffness, initial_state_});
}

template <int D>
Index LpsElasticity<D>::size() const {
  return D * family_->point_count + mirror_.face_value_count();
}

template <int D>
void LpsElasticity<D>::apply(std::span<const double> u, const PoreStress& pore,
                             std::span<double> force, std::span<double> dilatation) {
  assert(static_cast<Index>(u.size()) == size() && u.size() == force.size());
  take(u);
  with_pore_stress(pore, [&](auto pore_stress) {
    if (initial_stress_) {
      find_forces<true>(force, dilatation, pore_stress);
    } else {
      find_forces<false>(force, dilatation, pore_stress);
    }
  });
}

template <int D>
void LpsElasticity<D>::apply_stiffness(std::span<const double> u, std::span<double> force,
                                       std::span<double> dilatation) {
  take(u);
  with_pore_stress({}, [&](auto none) { find_forces<false>(force, dilatation, none); });
}

template <int D>
void LpsElasticity<D>::add_pore_force(std::span<const double> pore_stress,
                                      std::span<double> force) {
  const std::vector<double> rest(size(), 0.0);
  std::vector<double> inner(size());
  take(rest);
  with_pore_stress({.value = pore_stress},
                   [&](auto pore_stress_at) { find_forces<false>(inner, {}, pore_stress_at); });
  for (std::size_t k = 0; k < inner.size(); ++k) force[k] -= inner[k];
}

template <int D>
void LpsElasticity<D>::take(std::span<const double> u) {
  mirror_.spread(u, field_);
  const auto nodes = static_cast<std::size_t>(family_->node_count());
  std::array<std::span<const double>, 2 * D> columns;
  for (int a = 0; a < D; ++a) {
    columns[a] = family_->position[a];
    columns[D + a] = std::span(field_).subspan(a * nodes, nodes);
  }
  values_.template put<0>(columns);
}

/// Of the displacement in `field_`.
template <int D>
template <bool initially_stressed, class PoreStressAt>
void LpsElasticity<D>::find_forces(std::span<double> force, std::span<double> dilatation,
                                   PoreStressAt&& pore_stress) {
  const Index points = family_->point_count;
  if (lattice_ && initially_stressed == initial_stress_.has_value()) {
    lattice_->apply(
        field_, [&](auto i, const auto& theta) { return pore_sign_ * pore_stress(i, theta); },
        dilatation, volume_state_, force.first(static_cast<std::size_t>(D) * points));
  } else {
    store_state(dilatation, pore_stress);
    values_.template put<2 * D>(
        std::array<std::span<const double>, 2>{volume_state_, bond_stiffness_});
    for_each_shared_point(points, [&](Index i) {
      const Vector<D> f = bond_forces<initially_stressed>(i);
      set_at(force, points, i, -f);
    });
    ranks::gather_shares(force.first(static_cast<std::size_t>(D) * points), points);
  }
  for_each_point(static_cast<Index>(face_points_.size()), [&](Index k) {
    const Index i = face_points_[k];
    add_at(force, points, i, -image_forces(i));
  });
  add_face_reactions<initially_stressed>(force.subspan(static_cast<std::size_t>(D) * points));
}

template <int D>
template <class PoreStressAt>
void LpsElasticity<D>::store_state(std::span<double> dilatation, PoreStressAt&& pore_stress) {
  const Index points = family_->point_count;
  for_each_shared_point(points, [&](Index i) {
    const double theta = dilatation_at(i);
    if (!dilatation.empty()) dilatation[i] = theta;
    volume_state_[i] = dilatation_scale_[i] *
                       (dilatation_stiffness(i) * theta - pore_sign_ * pore_stress(i, theta));
  });
  ranks::gather_shares(dilatation, points);
  ranks::gather_shares(std::span(volume_state_).first(points), points);
}

template <int D>
double LpsElasticity<D>::dilatation_at(Index i) const {
  const Vector<D> own = vector_at<D>(field_, family_->node_count(), i);
  const auto sum = values_.with([&](const auto& values) {
    return sum_over_bonds<1, 2 * D>(*family_, i, values,
                                    [&](auto, const auto& other, const auto& xi, const auto& w) {
                                      std::decay_t<decltype(w)> along{};
                                      for (int r = 0; r < D; ++r)
                                        along += xi[r] * (other[D + r] - own[r]);
                                      return std::array{w * along};
                                    });
  });
  return dilatation_scale_[i] * sum[0];
}

/// The forces of a point's bonds without the ghosts' halves, which image_forces() adds.
template <int D>
template <bool initially_stressed>
Vector<D> LpsElasticity<D>::bond_forces(Index i) const {
  const std::size_t nodes = family_->node_count();
  const double* const initial = initial_state_.data();
  const double own_state = volume_state_[i], own_stiffness = bond_stiffness_[i];
  const Vector<D> own = vector_at<D>(field_, nodes, i);
  std::array<double, initially_stressed ? D * D : 0> own_initial;
  for (std::size_t k = 0; k < own_initial.size(); ++k) own_initial[k] = initial[k * nodes + i];
  Vector<D> force = values_.with([&](const auto& values) {
    return sum_over_bonds<D, value_count>(
        *family_, i, values, [&](auto j, const auto& other, const auto& xi, const auto& w) {
          using Number = std::decay_t<decltype(w)>;
          Number along{}, square{};
          for (int r = 0; r < D; ++r) {
            along += xi[r] * (other[D + r] - own[r]);
            square += xi[r] * xi[r];
          }
          const Number pull =
              own_state + other[2 * D] + (own_stiffness + other[2 * D + 1]) * along / square;
          std::array<Number, D> t;
          for (int r = 0; r < D; ++r) {
            t[r] = pull * xi[r];
            if constexpr (initially_stressed) {
              for (int b = 0; b < D; ++b) {
                const int k = r * D + b;
                t[r] += (own_initial[k] + number_of(initial + k * nodes, j)) * xi[b];
              }
            }
            t[r] *= w;
          }
          return t;
        });
  });
  for (double& component : force) component *= family_->volume[i];
  return force;
}

/// What the sources of a point's ghosts put into its bonds to them. A ghost's displacement need not
/// be the reflection of its source's: with sigma_r = 1 where the image of component r is as a
/// reflection's and -1 where it is not, the reflected bond has xi' = -R xi and du' = -S du
/// (R, S: signs of the reflection and of the image), so that its force, brought back by S, is
/// [d s/m + (c/m) (sigma xi).du / |xi|^2] sigma xi, with s and m of the source.
template <int D>
Vector<D> LpsElasticity<D>::image_forces(Index i) const {
  const Index points = family_->point_count;
  Vector<D> force{};
  for (const auto& [j, weight] : family_->bonds(i)) {
    const Index ghost = j - points;
    if (ghost < 0) continue;
    const Index source = family_->ghost_source[ghost];
    const Vector<D> xi = bond_vector(i, points + ghost);
    const Vector<D> image = componentwise(xi, image_sign_[ghost]);
    const double pull = volume_state_[source] + bond_stiffness_[source] *
                                                    dot(image, difference(i, points + ghost)) /
                                                    squared_norm(xi);
    force += weight * pull * image;
  }
  return family_->volume[i] * force;
}

/// dE/dU of the face values: the part of real points' bonds in the ghosts at their ends. Serial, so
/// that the order of the sum is fixed.
template <int D>
template <bool initially_stressed>
void LpsElasticity<D>::add_face_reactions(std::span<double> reaction) const {
  std::ranges::fill(reaction, 0.0);
  if (reaction.empty()) return;
  const Index points = family_->point_count;
  const std::size_t nodes = family_->node_count();
  for (const Index i : face_points_) {
    const PointBonds bonds = family_->bonds(i);
    for (Index bond = family_->first_ghost_bond(i); bond < bonds.count(); ++bond) {
      const Index j = bonds.other(bond);
      const Vector<D> xi = bond_vector(i, j);
      const double pull =
          volume_state_[i] + bond_stiffness_[i] * dot(xi, difference(i, j)) / squared_norm(xi);
      for (int r = 0; r < D; ++r) {
        const auto& image = mirror_.image(family_->ghost_faces[j - points], r);
        if (image.term_count == 0) continue;
        double force = pull * xi[r];
        for (int b = 0; b < D && initially_stressed; ++b) {
          force += initial_state_[(r * D + b) * nodes + i] * xi[b];
        }
        force *= family_->volume[i] * bonds.weight(bond);
        for (int k = 0; k < image.term_count; ++k) {
          reaction[image.terms[k].face_value] += image.terms[k].coefficient * force;
        }
      }
    }
  }
}

template <int D>
Vector<D> LpsElasticity<D>::bond_vector(Index i, Index j) const {
  return vector_at(family_->position, j) - vector_at(family_->position, i);
}

template <int D>
Vector<D> LpsElasticity<D>::difference(Index i, Index j) const {
  const std::size_t nodes = family_->node_count();
  return vector_at<D>(field_, nodes, j) - vector_at<D>(field_, nodes, i);
}

/// sum_j T(xi) (x) xi of the point's own force states T: dW/dF for a uniform gradient F.
template <int D>
Tensor<D, D> LpsElasticity<D>::stress_at(Index i, const Tensor<D, D>&) const {
  const std::size_t nodes = family_->node_count();
  const double pull = dilatation_scale_[i] * dilatation_stiffness(i) * dilatation_at(i);
  const double stiffness = bond_stiffness_[i];
  return sum_over_bonds<D * D>(*family_, i, [&](Index j, const Vector<D>& xi, double w) {
    double along = 0.0, square = 0.0;
    for (int r = 0; r < D; ++r) {
      along += xi[r] * (field_[r * nodes + j] - field_[r * nodes + i]);
      square += xi[r] * xi[r];
    }
    const double t = w * (pull + stiffness * along / square);
    Tensor<D, D> product;
    for (int k = 0; k < D * D; ++k) product[k] = t * xi[k / D] * xi[k % D];
    return product;
  });
}

template <int D>
void LpsElasticity<D>::stress(std::span<const double> u, std::span<double> stress) {
  take(u);
  const Index points = family_->point_count;
  if (lattice_) {
    lattice_->find_stress(field_, stress);
  } else {
    for_each_shared_point(points, [&](Index i) {
      const Tensor<D, D> result = stress_at(i, {});
      for (int k = 0; k < D * D; ++k) stress[static_cast<std::size_t>(k) * points + i] = result[k];
    });
    ranks::gather_shares(stress, points);
  }
  for (int a = 0; a < D && initial_stress_; ++a) {
    for (double& s : stress.subspan(static_cast<std::size_t>(a) * (D + 1) * points, points)) {
      s += (*initial_stress_)[a];
    }
  }
}

template <int D>
Tensor<D, D> LpsElasticity<D>::gradient_at(Index i) const {
  const Vector<D> own = vector_at<D>(field_, family_->node_count(), i);
  return values_.with([&](const auto& values) {
    return perifrac::gradient_at<D, D>(*family_, inverse_shape_at(i), values, own, i);
  });
}

template <int D>
void LpsElasticity<D>::append_unknowns(Index i, std::vector<Index>& unknowns) const {
  append_family_unknowns(*family_, mirror_, i, unknowns);
}

template <int D>
PointStiffness LpsElasticity<D>::point_stiffness(Index i) const {
  return bond_energy_stiffness(*family_, mirror_, law_.at(i), i);
}

template <int D>
double LpsElasticity<D>::point_energy(Index i, std::span<const double>) const {
  const std::size_t nodes = family_->node_count();
  const auto stretch = sum_over_bonds<1>(*family_, i, [&](Index j, const Vector<D>& xi, double w) {
    double along = 0.0, square = 0.0;
    for (int r = 0; r < D; ++r) {
      along += xi[r] * (field_[r * nodes + j] - field_[r * nodes + i]);
      square += xi[r] * xi[r];
    }
    return std::array<double, 1>{w * along * along / square};
  });
  const double theta = dilatation_at(i);
  return 0.5 * family_->volume[i] *
         (dilatation_stiffness(i) * theta * theta + bond_stiffness_[i] * stretch[0]);
}

template <int D>
Eigen::SparseMatrix<double> LpsElasticity<D>::assemble() const {
  return sum_of_points(*this, family_->point_count);
}

template <int D>
Eigen::VectorXd LpsElasticity<D>::force_of_stress(const Eigen::VectorXd& stress) const {
  return perifrac::force_of_stress<D, D>(
      *family_, [this](Index i) { return inverse_shape_at(i); }, mirror_, stress);
}

template <int D>
std::string LpsElasticity<D>::path() const {
  if (lattice_) return lattice_->bonds().path();
  return (values_.reads_rows() ? packets_of_bonds() : "bond by bond: ") + why_no_packets_;
}

template class LpsElasticity<2>;
template class LpsElasticity<3>;

}  // namespace perifrac
