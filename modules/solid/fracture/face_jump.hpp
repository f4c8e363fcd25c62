#pragma once

#include <array>
#include <vector>

#include "core/bonds/bond_state.hpp"
#include "core/bonds/family.hpp"

namespace perifrac {

/// The mean jump of displacement across a facet of a crack, from one face to the other, as a sum of
/// point displacements: jump = sum of coefficient * u(point). The coefficients add up to 0, and are
/// 1 in sum on the side of the normal, so that rigid halves give their distance exactly.
///
/// Only the shortest bonds that cross it count, up to 1.5 spacings, at weight omega (n . xi)^2:
/// what the rock between their ends strains is then least. A bond through an end of the facet
/// counts half there, through a corner of one in 3D a quarter.
template <int D>
struct FaceJump {
  struct Term {
    Index point;
    double coefficient;
  };
  std::vector<Term> terms;
  Vector<D> normal;
  std::array<Vector<D>, D - 1> tangents;
  double area;   ///< of the facet [m^2], in 2D its length
  double reach;  ///< along the normal between the points, in the mean: the rock in the jump [m]
};

/// `family`: all bonds of the intact body, none longer than `longest` [m].
template <int D>
FaceJump<D> face_jump(const CrackFacet<D>& facet, const Family<D>& family, double spacing,
                      double longest);

}  // namespace perifrac
