#include "core/body/bonded_layer.hpp"

#include <algorithm>
#include <cmath>

namespace perifrac {

int layer_rows(double horizon, double spacing) {
  return static_cast<int>(std::ceil(horizon / spacing * (1.0 - 1e-9)));
}

template <int D>
std::vector<std::vector<Index>> points_behind(std::span<const Face> faces, FaceSet layered,
                                              const Points<D>& points) {
  std::vector<std::vector<Index>> layers(faces.size());
  for (int f = 0; f < std::ssize(faces); ++f) {
    if (!contains(layered, f)) continue;
    const Face& face = faces[f];
    for (Index i = 0; i < points.size(); ++i) {
      const double beyond = points.position[face.axis][i] - face.coordinate;
      if (face.direction * beyond > 0.0) layers[f].push_back(i);
    }
  }
  return layers;
}

KeyTable bonded_layer_keys() {
  return {
      {.path = "boundary.*",
       .type = KeyType::word,
       .words = {"mirror", "layer"},
       .meaning = "What carries the conditions of a box's face: mirror images of the points near "
                  "it, the default, or real points in a layer one horizon thick bonded behind it, "
                  "the paper's way."},
  };
}

FaceSet read_layered_faces(const Section& body, const std::vector<std::string>& faces) {
  FaceSet layered = 0;
  for (const std::string& name : body.names("boundary")) {
    const std::string path = "boundary." + name;
    const auto found = std::ranges::find(faces, name);
    if (found == faces.end()) body.fail_unknown(path, name, faces);
    if (body.word(path) == "layer") layered |= face_bit(static_cast<int>(found - faces.begin()));
  }
  return layered;
}

template std::vector<std::vector<Index>> points_behind<2>(std::span<const Face>, FaceSet,
                                                          const Points<2>&);
template std::vector<std::vector<Index>> points_behind<3>(std::span<const Face>, FaceSet,
                                                          const Points<3>&);

}  // namespace perifrac
