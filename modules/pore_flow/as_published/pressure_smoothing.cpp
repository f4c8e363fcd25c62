#include "modules/pore_flow/as_published/pressure_smoothing.hpp"

#include <algorithm>

#include "core/bonds/bond_traversal.hpp"

namespace perifrac {

template <int D>
PressureSmoothing<D>::PressureSmoothing(std::shared_ptr<const Family<D>> family,
                                        MirrorCondition<D, 1> mirror, std::vector<Index> points)
    : family_(std::move(family)),
      mirror_(std::move(mirror)),
      points_(std::move(points)),
      pressure_(family_->node_count()),
      smoothed_(points_.size()) {}

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
std::vector<Index> points_near_faces(const Body<D>& body) {
  std::vector<Index> near;
  for (Index i = 0; i < body.points().size(); ++i) {
    if (std::ranges::any_of(body.faces(), [&](const Face& face) {
          const double x = body.points().position[face.axis][i];
          return face.direction * (face.coordinate - x) <= body.horizon();
        })) {
      near.push_back(i);
    }
  }
  return near;
}

template class PressureSmoothing<2>;
template class PressureSmoothing<3>;
template std::vector<Index> points_near_faces<2>(const Body<2>&);
template std::vector<Index> points_near_faces<3>(const Body<3>&);

}  // namespace perifrac
