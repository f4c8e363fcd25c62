#include "app/warnings/thin_body_warning.hpp"

#include <vector>

#include <fmt/format.h>

#include "app/references/comparison.hpp"
#include "app/references/rock.hpp"
#include "app/warnings/body_box.hpp"
#include "core/geometry/faces.hpp"

namespace perifrac {

namespace {

/// Of its own bending energy a long body as thin as this part of a horizon keeps 0.91 at 0.8, 0.73
/// at 0.67 and 0.54 at 0.57; from 1.1 on it has some hundredths too much.
constexpr double thin = 0.95;

}  // namespace

std::optional<std::string> thin_body_warning(const Section& scene) {
  if (!writes(scene, "solid") || !has_elastic_rock(scene)) return {};
  if (!scene.has("body.spacing") || scene.text("body.shape") != "box") return {};
  const auto [low, high] = body_box(scene);
  const double horizon = scene.number("body.horizon_ratio") * scene.number("body.spacing");
  const auto names = low.size() == 2 ? face_names<2>() : face_names<3>();
  for (std::size_t axis = 0; axis < low.size(); ++axis) {
    const double thickness = high[axis] - low[axis];
    if (!(thickness < thin * horizon)) continue;
    const std::string first(names[2 * axis]), second(names[2 * axis + 1]);
    if (is_layer(scene, first) || is_layer(scene, second)) continue;
    return fmt::format(
        "the body is {:g} m thick between faces '{}' and '{}', and the horizon is {:g} m: points "
        "without a whole neighbourhood bend too stiffly, at half a horizon with half the energy; a "
        "body.spacing of {:.2g} m or less, or a smaller body.horizon_ratio",
        thickness, first, second, horizon, thickness / scene.number("body.horizon_ratio"));
  }
  return {};
}

}  // namespace perifrac
