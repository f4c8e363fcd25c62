#include "modules/pore_flow/as_published/pressure_smoothing.hpp"

#include <algorithm>

#include "core/bonds/bond_traversal.hpp"

namespace perifrac {

template <int D>
PressureSmoothing<D>::PressureSmoothing(std::shared_ptr<const Family<D>> family,
                                        MirrorCondition<D, 1> mirror, std::vector<Index> points,
                                        std::span<const Index> held, bool compensated)
    : family_(std::move(family)),
      mirror_(std::move(mirror)),
      intact_(std::move(points)),
      gives_(family_->node_count(), 1.0),
      is_compensated_(compensated),
      pressure_(family_->node_count()),
      share_(family_->node_count()),
      given_(family_->point_count) {
  for (const Index i : held) gives_[i] = 0.0;
  for (Index g = 0; g < family_->ghost_count(); ++g) {
    gives_[family_->point_count + g] = gives_[family_->ghost_source[g]];
  }
  smooth(intact_);
}

template <int D>
void PressureSmoothing<D>::smooth(std::vector<Index> points) {
  std::erase_if(points, [&](Index i) { return gives_[i] == 0.0; });
  points_ = std::move(points);
  smoothed_.resize(points_.size());
  gained_.resize(points_.size());
}

template <int D>
void PressureSmoothing<D>::follow(const BondState<D>& bonds) {
  if (!bonds_.follow(bonds, *family_)) return;
  family_ = bonds_.family();
  mirror_.use(*family_);
  std::vector<Index> points = intact_;
  for (const BrokenBond& bond : bonds.broken()) {
    points.push_back(bond.i);
    points.push_back(bond.j);
  }
  keep_each_once(points);
  smooth(std::move(points));
}

template <int D>
std::span<const double> PressureSmoothing<D>::apply(std::span<const double> p) {
  const Index count = family_->point_count;
  std::copy_n(p.begin(), count, pressure_.begin());
  mirror_.fill(pressure_, p.data() + count);
  const double* const pressure = pressure_.data();
  for_each_point(static_cast<Index>(points_.size()), [&](Index k) {
    const Index i = points_[k];
    const auto [weights, sum] =
        sum_over_bonds<2>(*family_, i, [=](Index j, const Vector<D>&, double w) {
          return std::array{w, w * pressure[j]};
        });
    const double own = family_->volume[i];
    smoothed_[k] = (own * pressure[i] + sum) / (own + weights);
  });
  return smoothed_;
}

template <int D>
std::span<const double> PressureSmoothing<D>::given() {
  std::ranges::fill(share_, 0.0);
  const double* const gives = gives_.data();
  for_each_point(static_cast<Index>(points_.size()), [&](Index k) {
    const Index i = points_[k];
    const auto [weights] = sum_over_bonds<1>(
        *family_, i, [=](Index j, const Vector<D>&, double w) { return std::array{w * gives[j]}; });
    share_[i] = weights > 0.0 ? gained_[k] / (weights * family_->volume[i]) : 0.0;
  });
  for (Index g = 0; g < family_->ghost_count(); ++g) {
    share_[family_->point_count + g] = share_[family_->ghost_source[g]];
  }
  const double* const share = share_.data();
  for_each_point(family_->point_count, [&](Index j) {
    const auto [sum] = sum_over_bonds<1>(
        *family_, j, [=](Index i, const Vector<D>&, double w) { return std::array{w * share[i]}; });
    given_[j] = gives[j] * family_->volume[j] * sum;
  });
  return given_;
}

template <int D>
std::vector<Index> points_near_surfaces(const Body<D>& body) {
  const auto is_near_face = [&](const Vector<D>& x) {
    return std::ranges::any_of(body.faces(),
                               [&](const Face& face) { return face.depth(x) <= body.horizon(); });
  };
  const auto is_near_cutout = [&](const Vector<D>& x) {
    return std::ranges::any_of(body.cutouts(), [&](const Region<D>& box) {
      double square = 0.0;
      for (int a = 0; a < D; ++a) {
        const double beside = std::max({box.from[a] - x[a], x[a] - box.to[a], 0.0});
        square += beside * beside;
      }
      return square <= body.horizon() * body.horizon();
    });
  };
  std::vector<Index> near;
  for (Index i = 0; i < body.points().size(); ++i) {
    const Vector<D> x = body.points().at(i);
    if (is_near_face(x) || is_near_cutout(x)) near.push_back(i);
  }
  return near;
}

template class PressureSmoothing<2>;
template class PressureSmoothing<3>;
template std::vector<Index> points_near_surfaces<2>(const Body<2>&);
template std::vector<Index> points_near_surfaces<3>(const Body<3>&);

}  // namespace perifrac
