#include "core/body/body.hpp"

#include <algorithm>
#include <cmath>
#include <stdexcept>

#include <fmt/format.h>

#include "core/base/errors.hpp"
#include "core/base/small_vector.hpp"
#include "core/body/cutouts.hpp"
#include "core/bonds/projected_weights.hpp"
#include "core/profile/profile.hpp"

namespace perifrac {

template <int D>
Body<D>::Body(Points<D> points, std::vector<Face> faces, double spacing, double horizon,
              InfluenceFunction influence)
    : points_(std::move(points)),
      faces_(std::move(faces)),
      layers_(faces_.size()),
      spacing_(spacing),
      horizon_(horizon),
      influence_(influence) {
  point_set_.name = "body";
  point_set_.dimension = D;
  point_set_.count = points_.volume.size();
  for (int a = 0; a < D; ++a) point_set_.position[a] = points_.position[a];
}

template <int D>
BondState<D>& Body<D>::claim_bond_state() const {
  if (bond_state_claimed_) throw std::logic_error("two writers of one bond state");
  bond_state_claimed_ = true;
  return *bond_state_;
}

template <int D>
int Body<D>::opposite(int face) const {
  for (int f = 0; f < std::ssize(faces_); ++f) {
    const bool across = faces_[f].axis == faces_[face].axis && static_cast<int>(f) != face;
    if (across || faces_[f].curved()) return static_cast<int>(f);
  }
  throw std::logic_error("a body with one side");
}

template <int D>
std::vector<Face> Body<D>::holes() const {
  std::vector<Face> holes;
  std::ranges::copy_if(faces_, std::back_inserter(holes), &Face::is_hole);
  return holes;
}

template <int D>
bool Body<D>::are_parted_by_cutout(const Vector<D>& x, const Vector<D>& y) const {
  const auto is_between = [&](const auto& cutout) { return passes_through<D>(cutout, x, y); };
  return std::ranges::any_of(cutouts_, is_between) ||
         std::ranges::any_of(faces_, [&](const Face& f) { return f.is_hole() && is_between(f); });
}

template <int D>
double Body<D>::area(int face) const {
  double area = 1.0;
  for (int a = 0; a < D; ++a) {
    if (a != faces_[face].axis) area *= faces_[2 * a + 1].coordinate - faces_[2 * a].coordinate;
  }
  return area;
}

template <int D>
double Body<D>::thickness(int face, FaceSet without_layers) const {
  double sum = 0.0;
  for (const int f : {face, opposite(face)}) {
    const Face& side = faces_[f];
    double reach = side.direction * side.coordinate;
    for (const Index i : contains(without_layers, f) ? std::span<const Index>{} : layer(f)) {
      reach = std::max(reach, side.direction * points_.position[side.axis][i] + 0.5 * spacing_);
    }
    sum += reach;
  }
  return sum;
}

template <int D>
std::vector<bool> Body<D>::in_layers(FaceSet faces) const {
  std::vector<bool> in(points_.size(), false);
  for (int f = 0; f < std::ssize(faces_); ++f) {
    if (!contains(faces, f)) continue;
    for (const Index i : layers_[f]) in[i] = true;
  }
  return in;
}

template <int D>
void Body<D>::set_irregular(bool projected_weights) {
  irregular_ = true;
  projected_weights_ = projected_weights;
}

template <int D>
Index Body<D>::nearest_point(const Vector<D>& x) const {
  const std::vector<bool> in_layer = in_layers(~FaceSet{0});
  Index nearest = 0;
  double least = INFINITY;
  for (Index i = 0; i < points_.size(); ++i) {
    if (in_layer[i]) continue;
    const double r2 = squared_norm(points_.at(i) - x);
    // A tie between lattice points goes to the first of them, whatever the rounding.
    if (r2 < least * (1.0 - 1e-12)) {
      least = r2;
      nearest = i;
    }
  }
  return nearest;
}

template <int D>
std::shared_ptr<const Family<D>> Body<D>::family(FaceSet mirrored, FaceSet without_layers) const {
  for (const SharedFamily& known : families_) {
    if (known.mirrored != mirrored || known.without_layers != without_layers) continue;
    if (auto family = known.family.lock()) return family;
  }
  check_mirrored_faces(mirrored, without_layers);
  auto family = std::make_shared<const Family<D>>(make_family(mirrored, without_layers));
  families_.push_back({mirrored, without_layers, family});
  return family;
}

template <int D>
void Body<D>::check_mirrored_faces(FaceSet mirrored, FaceSet without_layers) const {
  for (int f = 0; f < std::ssize(faces_); ++f) {
    if (!contains(mirrored, f)) continue;
    if (!layers_[f].empty()) throw std::logic_error("a mirrored face has a layer");
    if (faces_[f].is_hole()) continue;  // the body's reader knows how small it may be
    const double across = thickness(static_cast<int>(f), without_layers);
    if (across < horizon_) {
      const auto [low, high] = std::minmax({static_cast<int>(f), opposite(static_cast<int>(f))});
      throw BodyError(fmt::format("{:g} m between faces '{}' and '{}' is less than the horizon",
                                  across, faces_[low].name, faces_[high].name),
                      fmt::format("at least {:g} m where a face is mirrored", horizon_));
    }
  }
}

template <int D>
Family<D> Body<D>::make_family(FaceSet mirrored, FaceSet without_layers) const {
  const ProfilePart profiled("families");
  const FaceSet all = face_bit(static_cast<int>(faces_.size())) - 1;
  if (projected_weights_ && mirrored != all) {
    return without_other_ghosts(*this->family(all), mirrored);
  }
  Family<D> family =
      build_family<D>(points_, faces_, mirrored, horizon_, influence_, in_layers(without_layers));
  remove_bonds_through<D>(cutouts_, faces_, mirrored, family);
  if (projected_weights_) project_weights<D>(family, faces_, mirrored, horizon_);
  family.weight.pack();
  return family;
}

template <int D>
std::vector<std::shared_ptr<const Family<D>>> Body<D>::families() const {
  std::vector<std::shared_ptr<const Family<D>>> used;
  for (const SharedFamily& known : families_) {
    if (auto family = known.family.lock()) used.push_back(std::move(family));
  }
  return used;
}

template class Body<2>;
template class Body<3>;

}  // namespace perifrac
