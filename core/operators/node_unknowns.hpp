#pragma once

#include <array>

#include "core/bonds/mirror_condition.hpp"

namespace perifrac {

/// A sum of coefficient * unknown.
struct Combination {
  struct Term {
    Index unknown;
    double coefficient;
  };
  std::array<Term, 5> terms;  // source, a face an axis, and what a user adds
  int count = 0;
  void add(Index unknown, double coefficient) { terms[count++] = {unknown, coefficient}; }
};

/// One component of a node, a point or a ghost, as a combination of the unknowns of a field.
template <int D, int R>
Combination node_unknowns(const Family<D>& family, const MirrorCondition<D, R>& mirror, Index node,
                          int component) {
  const Index points = family.point_count;
  Combination result;
  if (node < points) {
    result.add(component * points + node, 1.0);
    return result;
  }
  const auto& image = mirror.image(family.ghost_faces[node - points], component);
  result.add(component * points + family.ghost_source[node - points], image.sign);
  for (int k = 0; k < image.term_count; ++k) {
    result.add(R * points + image.terms[k].face_value, image.terms[k].coefficient);
  }
  return result;
}

}  // namespace perifrac
