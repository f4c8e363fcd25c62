#pragma once

#include <vector>

#include "core/geometry/bond_state.hpp"
#include "core/geometry/family.hpp"

namespace perifrac {

/// The mean jump of displacement across a facet of a crack, from one face to the other, as a sum of
/// point displacements: jump = sum of coefficient * u(point). The coefficients add up to 0, and are
/// 1 in sum on the side of the normal, so that rigid halves give their distance exactly.
///
/// Only the shortest bonds that cross it count, up to 1.5 spacings, at weight omega (n . xi)^2:
/// what the rock between their ends strains is then least. A bond through an end of the facet
/// counts half there.
struct FaceJump {
  struct Term {
    Index point;
    double coefficient;
  };
  std::vector<Term> terms;
  Vector<2> normal;
  Vector<2> tangent;
  double length;  ///< of the facet [m]
};

/// `family`: all bonds of the intact body.
FaceJump face_jump(const CrackFacet<2>& facet, const Family<2>& family, double spacing);

}  // namespace perifrac
