#include "core/bonds/mirror_condition.hpp"

#include <algorithm>
#include <bit>

namespace perifrac {

template <int D, int R>
MirrorCondition<D, R>::MirrorCondition(const Family<D>& family) : family_(&family) {
  FaceSet all = 0;
  for (const FaceSet faces : family.ghost_faces) all |= faces;
  images_.resize(std::size_t{all} + 1);
  for (auto& face : face_value_) face.fill(-1);
}

template <int D, int R>
void MirrorCondition<D, R>::set_odd(int face, int component) {
  if (face_value_[face][component] >= 0) return;
  face_value_[face][component] = count_++;
  for (FaceSet faces = 0; faces < images_.size(); ++faces) {
    if (std::popcount(faces) > D + 1) continue;  // no ghost is mirrored at so many
    images_[faces][component] = find_image(faces, component);
  }
}

template <int D, int R>
auto MirrorCondition<D, R>::find_image(FaceSet faces, int component) const -> Image {
  Image image;
  for (int face = 0; face < most_faces; ++face) {
    const int value = face_value_[face][component];
    if (!contains(faces, face) || value < 0) continue;
    image.sign = -image.sign;
    image.terms[image.term_count++].face_value = value;
  }
  // Mirrored twice, a point must come back to its own value: at a corner of two odd faces that
  // leaves the source itself, at one of three faces their mean takes the place of U.
  if (image.sign > 0.0) image.term_count = 0;
  for (int k = 0; k < image.term_count; ++k) image.terms[k].coefficient = 2.0 / image.term_count;
  return image;
}

template <int D, int R>
void MirrorCondition<D, R>::spread(std::span<const double> unknowns,
                                   std::vector<double>& nodes) const {
  const Index points = family_->point_count;
  const Index count = family_->node_count();
  for (int r = 0; r < R; ++r) {
    const double* const from = unknowns.data() + static_cast<std::size_t>(r) * points;
    std::copy(from, from + points, nodes.data() + static_cast<std::size_t>(r) * count);
  }
  fill(nodes, unknowns.data() + static_cast<std::size_t>(R) * points);
}

template <int D, int R>
void MirrorCondition<D, R>::fill(std::vector<double>& nodes, const double* face_values) const {
  const Index count = family_->node_count();
  for (Index g = 0; g < family_->ghost_count(); ++g) {
    for (int r = 0; r < R; ++r) {
      const Image& of = image(family_->ghost_faces[g], r);
      double* const block = nodes.data() + static_cast<std::size_t>(r) * count;
      double value = of.sign * block[family_->ghost_source[g]];
      for (int k = 0; k < of.term_count; ++k) {
        value += of.terms[k].coefficient * face_values[of.terms[k].face_value];
      }
      block[family_->point_count + g] = value;
    }
  }
}

template <int D, int R>
void MirrorCondition<D, R>::collect(std::span<const double> nodes,
                                    std::span<double> unknowns) const {
  const Index points = family_->point_count;
  const Index count = family_->node_count();
  const std::span<double> faces = unknowns.subspan(static_cast<std::size_t>(R) * points);
  std::ranges::fill(faces, 0.0);
  for (int r = 0; r < R; ++r) {
    const double* const from = nodes.data() + static_cast<std::size_t>(r) * count;
    double* const to = unknowns.data() + static_cast<std::size_t>(r) * points;
    std::copy(from, from + points, to);
    for (Index g = 0; g < family_->ghost_count(); ++g) {
      const Image& of = image(family_->ghost_faces[g], r);
      to[family_->ghost_source[g]] += of.sign * from[points + g];
      for (int k = 0; k < of.term_count; ++k) {
        faces[of.terms[k].face_value] += of.terms[k].coefficient * from[points + g];
      }
    }
  }
}

template <int D, int R>
void MirrorCondition<D, R>::fill_conjugate(std::vector<double>& nodes) const {
  const Index count = family_->node_count();
  for (Index g = 0; g < family_->ghost_count(); ++g) {
    for (int r = 0; r < R; ++r) {
      const double sign = image(family_->ghost_faces[g], r).sign;
      for (int b = 0; b < D; ++b) {
        const bool reflected = (family_->ghost_axes[g] >> b) & 1;
        double* const block = nodes.data() + static_cast<std::size_t>(r * D + b) * count;
        block[family_->point_count + g] =
            (reflected ? -sign : sign) * block[family_->ghost_source[g]];
      }
    }
  }
}

template class MirrorCondition<2, 1>;
template class MirrorCondition<2, 2>;
template class MirrorCondition<3, 1>;
template class MirrorCondition<3, 3>;

}  // namespace perifrac
