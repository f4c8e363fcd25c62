#pragma once

#include <span>
#include <vector>

#include "core/base/points.hpp"
#include "core/config/key.hpp"
#include "core/config/section.hpp"
#include "core/geometry/faces.hpp"

namespace perifrac {

/// Rows of points in a bonded layer: it is one horizon thick, rounded up to whole spacings.
int layer_rows(double horizon, double spacing);

/// For every face the points behind it if it is one of `layered`, none otherwise. A point behind
/// two of them belongs to both.
template <int D>
std::vector<std::vector<Index>> points_behind(std::span<const Face> faces, FaceSet layered,
                                              const Points<D>& points);

/// The keys of `boundary` in the section of the body.
KeyTable bonded_layer_keys();

/// The faces that the section puts a layer behind; throws InputError.
FaceSet read_layered_faces(const Section& body, const std::vector<std::string>& faces);

}  // namespace perifrac
