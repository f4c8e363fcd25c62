#pragma once

#include <cmath>

#include "core/base/small_vector.hpp"
#include "modules/solid/material/stress_at_rest.hpp"

namespace perifrac {

/// The total stress at rest on a straight line in 2D, at its middle, compression positive [Pa].
struct StressOnLine {
  double lengthwise, across;
  double shear;  ///< of either sign
};

inline StressOnLine stress_on_line(const StatedStress& stated, const Vector<2>& first,
                                   const Vector<2>& last) {
  const Vector<2> along = (last - first) / norm(last - first);
  const double height = 0.5 * (first[1] + last[1]);
  const Vector<2> stress = {stated.total_at(0, height), stated.total_at(1, height)};
  return {.lengthwise = along[0] * along[0] * stress[0] + along[1] * along[1] * stress[1],
          .across = along[1] * along[1] * stress[0] + along[0] * along[0] * stress[1],
          .shear = std::abs(along[0] * along[1] * (stress[0] - stress[1]))};
}

}  // namespace perifrac
