#include "modules/pore_flow/storage/stabilised_storage.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

#include "core/base/eigen_view.hpp"
#include "core/base/errors.hpp"
#include "core/bonds/bond_state.hpp"
#include "core/profile/profile.hpp"

namespace perifrac {

namespace {

/// From here on the roughest pressures hold 0.5 alpha^2 times the slope and more (decision 17).
constexpr double enough_to_split = 0.1;

/// The cube of what a point's bonds weigh inside the body over what they weigh.
template <int D>
std::vector<double> raise_near_faces(const Family<D>& family) {
  std::vector<double> weight(family.point_count, 0.0);
  for (Index i = 0; i < family.point_count; ++i) {
    for (const auto& bond : family.bonds(i)) weight[i] += bond.weight;
  }
  std::vector<double> sorted = weight;
  std::ranges::sort(sorted);
  const double inside = sorted[sorted.size() * 3 / 4];
  for (double& w : weight) w = std::clamp(std::pow(inside / w, 3), 1.0, 20.0);
  return weight;
}

}  // namespace

template <int D>
StabilisedStorage<D>::StabilisedStorage(PoreMaterials materials,
                                        std::shared_ptr<const Family<D>> family, double strength,
                                        double spacing, bool irregular)
    : LinearStorage(std::move(materials)),
      intact_(std::move(family)),
      scale_(strength * spacing * spacing),
      splits_well_(strength >= enough_to_split),
      answer_(intact_->point_count, 0.0),
      raise_(irregular ? raise_near_faces(*intact_) : std::vector<double>()),
      roughness_(intact_, MirrorCondition<D, 1>(*intact_), laws()),
      own_(intact_->point_count),
      right_side_(intact_->point_count) {
  find_own();
}

template <int D>
bool StabilisedStorage<D>::set_dilatation(const DilatationInput& input) {
  last_p_.resize(0);
  if (!LinearStorage::set_dilatation(input)) return false;
  for (Index i = 0; i < std::ssize(input.slope); ++i) {
    const double alpha = materials().at(i).biot_coefficient;
    answer_[i] = alpha * alpha * input.slope[i];
  }
  roughness_.change_law([this](RoughnessLaws<D>& present) { present = laws(); });
  find_own();
  return true;
}

template <int D>
void StabilisedStorage<D>::take_bonds(std::span<const BrokenBond> broken) {
  if (broken.empty() && broken_.empty()) return;
  std::vector<Index> points;
  const auto add_ends = [&points](const BrokenBond& bond) {
    points.insert(points.end(), {bond.i, bond.j});
  };
  std::ranges::for_each(broken_, add_ends);
  broken_.assign(broken.begin(), broken.end());
  std::ranges::for_each(broken_, add_ends);
  keep_each_once(points);
  const auto cut = std::make_shared<Family<D>>(*intact_);
  for (const BrokenBond& bond : broken_) silence(*cut, bond.i, bond.j);
  roughness_.update(cut, points);
  find_own();
}

template <int D>
RoughnessLaws<D> StabilisedStorage<D>::laws() const {
  RoughnessLaws<D> laws;
  for (std::size_t i = 0; i < answer_.size(); ++i) {
    laws.laws.push_back({scale_ * answer_[i] * (raise_.empty() ? 1.0 : raise_[i])});
  }
  return laws;
}

/// The bonds' part of the diagonal is what they would have without their points' gradients.
template <int D>
void StabilisedStorage<D>::find_own() {
  between_.reset();
  last_p_.resize(0);
  const Family<D>& family = roughness_.family();
  const std::span<const double> storage = effective_storage(0.0, {});
  for (Index i = 0; i < family.point_count; ++i) own_[i] = family.volume[i] * storage[i];
  Eigen::VectorXd diagonal = own_;
  for (Index i = 0; i < family.point_count; ++i) {
    const double stiffness =
        family.volume[i] * roughness_.law().at(i).stabilisation() / roughness_.weighted_volume(i);
    for (const auto& [j, weight] : family.bonds(i)) {
      const double part = stiffness * weight;
      diagonal[i] += part;
      diagonal[j] += part;
    }
  }
  inverse_ = diagonal.cwiseInverse();
}

template <int D>
const Eigen::SparseMatrix<double>& StabilisedStorage<D>::between() const {
  if (!between_) {
    const ProfileScope profiled("assembly");
    between_ = roughness_.assemble();
  }
  return *between_;
}

template <int D>
void StabilisedStorage<D>::solve(double t, double tolerance) const {
  const ProfileScope profiled("solves");
  constexpr int most = 300;
  const auto apply = [this](const Eigen::VectorXd& u, Eigen::VectorXd& image) {
    roughness_.apply(view(u), view(image));
    image += own_.cwiseProduct(u);
  };
  const auto precondition = [this](const Eigen::VectorXd& left, Eigen::VectorXd& correction) {
    correction = inverse_.cwiseProduct(left);
  };
  residual_.resize(x_.size());
  apply(x_, residual_);
  residual_ = right_side_ - residual_;
  const double target = tolerance * right_side_.norm();
  try {  // what is not finite stays where it is, for the checks to find its place
    if (x_.allFinite()) {
      gradients_.correct(residual_, x_, target, most, apply, precondition);
    }
  } catch (const NotConverged& error) {
    throw NumericalError("pore_pressure", "the whole body", t, error.what());
  }
}

/// B takes nothing from linear pressures: what points hold by themselves is a good beginning. A
/// better one is what was found before the fluid content changed, within one window.
template <int D>
void StabilisedStorage<D>::pressure(double t, std::span<const double> zeta,
                                    std::span<double> p) const {
  const Index points = intact_->point_count;
  for (Index i = 0; i < points; ++i) {
    right_side_[i] =
        intact_->volume[i] * (zeta[i] - materials().at(i).biot_coefficient * dilatation().at(i, t));
  }
  if (last_p_.size() > 0) {
    x_ = last_p_ + (right_side_ - last_right_side_).cwiseQuotient(own_);
  } else {
    x_ = right_side_.cwiseQuotient(own_);
  }
  solve(t, this->to_rounding);
  last_right_side_ = right_side_;
  last_p_ = x_;
  std::ranges::copy(x_, p.begin());
}

template <int D>
void StabilisedStorage<D>::pressure_change(double t, std::span<const double>,
                                           std::span<const double> change, std::span<double> dp,
                                           double tolerance) {
  const Index points = intact_->point_count;
  for (Index i = 0; i < points; ++i) right_side_[i] = intact_->volume[i] * change[i];
  x_ = right_side_.cwiseQuotient(own_);
  solve(t, tolerance);
  std::ranges::copy(x_, dp.begin());
}

template <int D>
void StabilisedStorage<D>::add_pattern_to(Eigen::SparseMatrix<double>& matrix) const {
  matrix = Eigen::SparseMatrix<double>(matrix + 0.0 * between());
}

template <int D>
void StabilisedStorage<D>::add_to(Eigen::SparseMatrix<double>& matrix, double t,
                                  std::span<const double> zeta, std::span<const double> volume) {
  LinearStorage::add_to(matrix, t, zeta, volume);
  const Eigen::SparseMatrix<double>& b = between();
  for (Index column = 0; column < b.outerSize(); ++column) {
    for (Eigen::SparseMatrix<double>::InnerIterator entry(b, column); entry; ++entry) {
      matrix.coeffRef(entry.row(), column) += entry.value();
    }
  }
}

template <int D>
double StabilisedStorage<D>::energy_between_points(std::span<const double> p) const {
  residual_.resize(own_.size());
  roughness_.apply(p.first(own_.size()), view(residual_));
  return 0.5 * view(p.first(own_.size())).dot(residual_);
}

template class StabilisedStorage<2>;
template class StabilisedStorage<3>;

}  // namespace perifrac
