#pragma once

#include <array>
#include <span>
#include <vector>

#include "core/bonds/family.hpp"

namespace perifrac {

/// What a field does across the mirrored faces. A component is even (its image is equal: sealed
/// for pressure, tangential displacement on a roller) or odd about the face's own value U (its
/// image is 2 U - source: drained, or the normal displacement on a roller).
///
/// Face values are unknowns of the field after its points: each odd pair of face and component has
/// one, so that a rigid plate can solve for it and the reaction to it is its row of the operator.
template <int D, int R>
class MirrorCondition {
 public:
  explicit MirrorCondition(const Family<D>& family);

  /// Goes over to a family of the same points and ghosts; the former may go.
  void use(const Family<D>& family) { family_ = &family; }

  /// Makes a component odd at a face; call before the first use of the condition.
  void set_odd(int face, int component);

  /// Number of an odd pair among the face values, -1 where the component is even.
  int face_value(int face, int component) const { return face_value_[face][component]; }
  int face_value_count() const { return count_; }

  /// Component `component` of a ghost: sign * source + sum of coefficient * face value.
  struct Image {
    double sign = 1.0;
    struct Term {
      int face_value;
      double coefficient;
    };
    std::array<Term, D + 1> terms{};  // a face an axis, and a curved one
    int term_count = 0;
  };
  const Image& image(FaceSet faces, int component) const { return images_[faces][component]; }

  /// Writes an unknown vector on the nodes: R blocks of node_count, real points and then ghosts.
  void spread(std::span<const double> unknowns, std::vector<double>& nodes) const;

  /// Writes the ghosts' values after the real points' in `nodes` (R blocks of node_count).
  void fill(std::vector<double>& nodes, const double* face_values) const;

  /// The transpose of spread(): of forces on the nodes, what pulls at each unknown.
  void collect(std::span<const double> nodes, std::span<double> unknowns) const;

  /// Writes ghosts of a flux state A (R * D blocks of node_count) conjugate to the field, which
  /// there is where no ghost is curved.
  void fill_conjugate(std::vector<double>& nodes) const;

 private:
  Image find_image(FaceSet faces, int component) const;

  const Family<D>* family_;
  static constexpr int most_faces = 2 * D + 8;  ///< of a box with round holes

  std::array<std::array<int, R>, most_faces> face_value_;
  int count_ = 0;
  std::vector<std::array<Image, R>> images_;  ///< by the faces that a ghost was mirrored at
};

}  // namespace perifrac
