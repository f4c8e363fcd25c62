#include "modules/pore_flow/storage/stabilised_storage.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

#include "core/bonds/bond_state.hpp"
#include "core/operators/linear_exact.hpp"
#include "core/profile/profile.hpp"

namespace perifrac {

namespace {

/// Of the linear-exact operator's energy, what linear fields do not have, and that alone; of Darcy
/// flow's size for a mobility of 1.
template <int D>
struct RoughnessLaw {
  double weight;

  Tensor<1, D> stress(const Tensor<1, D>&) const { return {}; }
  double stabilisation() const { return 4.0 * D / 3.0 * weight; }
};

template <int D>
struct RoughnessLaws {
  static constexpr int components = 1;

  std::vector<RoughnessLaw<D>> laws;

  const RoughnessLaw<D>& at(Index i) const { return laws[i]; }
};

/// From here on the roughest pressures hold 0.5 alpha^2 times the slope and more (decision 17).
constexpr double enough_to_split = 0.1;

/// The cube of what a point's bonds weigh inside the body over what they weigh.
template <int D>
std::vector<double> raise_near_faces(const Family<D>& family) {
  std::vector<double> weight(family.point_count, 0.0);
  for (Index i = 0; i < family.point_count; ++i) {
    for (Index bond = family.offset[i]; bond < family.offset[i + 1]; ++bond) {
      weight[i] += family.weight[bond];
    }
  }
  std::vector<double> sorted = weight;
  std::ranges::sort(sorted);
  const double inside = sorted[sorted.size() * 3 / 4];
  for (double& w : weight) w = std::clamp(std::pow(inside / w, 3), 1.0, 20.0);
  return weight;
}

Eigen::Map<Eigen::VectorXd> view(std::span<double> values) {
  return {values.data(), static_cast<Eigen::Index>(values.size())};
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
      right_side_(intact_->point_count) {
  assemble();
  factor();
}

template <int D>
bool StabilisedStorage<D>::set_dilatation(const DilatationInput& input) {
  if (!LinearStorage::set_dilatation(input)) return false;
  for (Index i = 0; i < std::ssize(input.slope); ++i) {
    const double alpha = materials().at(i).biot_coefficient;
    answer_[i] = alpha * alpha * input.slope[i];
  }
  assemble();
  factor();
  return true;
}

template <int D>
void StabilisedStorage<D>::take_bonds(std::span<const BrokenBond> broken) {
  if (broken.empty() && broken_.empty()) return;
  broken_.assign(broken.begin(), broken.end());
  assemble();
  factor();
}

template <int D>
void StabilisedStorage<D>::assemble() {
  const ProfileScope profiled("assembly");
  RoughnessLaws<D> laws;
  for (std::size_t i = 0; i < answer_.size(); ++i) {
    laws.laws.push_back({scale_ * answer_[i] * (raise_.empty() ? 1.0 : raise_[i])});
  }
  LinearExactOperator<D, RoughnessLaws<D>> op(intact_, MirrorCondition<D, 1>(*intact_),
                                              std::move(laws));
  if (!broken_.empty()) {
    const auto cut = std::make_shared<Family<D>>(*intact_);
    std::vector<Index> points;
    for (const BrokenBond& bond : broken_) {
      silence(*cut, bond.i, bond.j);
      points.insert(points.end(), {bond.i, bond.j});
    }
    keep_each_once(points);
    op.update(cut, points);
  }
  between_ = op.assemble();
}

template <int D>
void StabilisedStorage<D>::factor() {
  Eigen::SparseMatrix<double> whole(between_.rows(), between_.cols());
  whole.setIdentity();
  whole = 0.0 * whole + 0.0 * between_;
  add_to(whole, 0.0, {}, intact_->volume);
  factor_.factor(whole);
}

template <int D>
void StabilisedStorage<D>::pressure(double t, std::span<const double> zeta,
                                    std::span<double> p) const {
  const Index points = intact_->point_count;
  for (Index i = 0; i < points; ++i) {
    right_side_[i] =
        intact_->volume[i] * (zeta[i] - materials().at(i).biot_coefficient * dilatation().at(i, t));
  }
  factor_.solve(right_side_, view(p.first(points)));
}

template <int D>
void StabilisedStorage<D>::pressure_change(double, std::span<const double>,
                                           std::span<const double> change, std::span<double> dp) {
  const Index points = intact_->point_count;
  for (Index i = 0; i < points; ++i) right_side_[i] = intact_->volume[i] * change[i];
  factor_.solve(right_side_, view(dp.first(points)));
}

template <int D>
void StabilisedStorage<D>::add_pattern_to(Eigen::SparseMatrix<double>& matrix) const {
  matrix = Eigen::SparseMatrix<double>(matrix + 0.0 * between_);
}

template <int D>
void StabilisedStorage<D>::add_to(Eigen::SparseMatrix<double>& matrix, double t,
                                  std::span<const double> zeta, std::span<const double> volume) {
  LinearStorage::add_to(matrix, t, zeta, volume);
  for (Index column = 0; column < between_.outerSize(); ++column) {
    for (Eigen::SparseMatrix<double>::InnerIterator entry(between_, column); entry; ++entry) {
      matrix.coeffRef(entry.row(), column) += entry.value();
    }
  }
}

template <int D>
double StabilisedStorage<D>::energy_between_points(std::span<const double> p) const {
  double sum = 0.0;
  for (Index column = 0; column < between_.outerSize(); ++column) {
    for (Eigen::SparseMatrix<double>::InnerIterator entry(between_, column); entry; ++entry) {
      sum += p[entry.row()] * entry.value() * p[column];
    }
  }
  return 0.5 * sum;
}

template class StabilisedStorage<2>;
template class StabilisedStorage<3>;

}  // namespace perifrac
