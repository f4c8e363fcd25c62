#include "app/run/setup_picture.hpp"

#include <algorithm>
#include <filesystem>

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include "app/installation/data_folder.hpp"
#include "app/report/drawing.hpp"
#include "app/run/summary.hpp"
#include "app/run/written_keys.hpp"
#include "core/base/errors.hpp"
#include "core/body/crack_list.hpp"

namespace perifrac {

namespace {

constexpr Index most_points = 4000;  ///< more are no longer told apart

/// Of points that are no lattice: evenly taken.
template <int D>
nlohmann::json points_of(const Body<D>& body) {
  nlohmann::json points = nlohmann::json::array();
  const Index step = 1 + body.points().size() / most_points;
  for (Index i = 0; body.irregular() && i < body.points().size(); i += step) {
    points.push_back(body.points().at(i));
  }
  return points;
}

template <int D>
nlohmann::json body_json(const Body<D>& body) {
  nlohmann::json faces = nlohmann::json::array();
  for (const Face& face : body.faces()) {
    faces.push_back({{"name", face.name},
                     {"axis", face.axis},
                     {"direction", face.direction},
                     {"coordinate", face.coordinate},
                     {"centre", face.centre},
                     {"along", face.along}});
  }
  return {{"spacing", body.spacing()}, {"faces", faces}, {"points", points_of(body)}};
}

template <int D>
nlohmann::json cracks_json(const Section& scene, const Body<D>& body) {
  nlohmann::json cracks = nlohmann::json::array();
  const auto facets = read_cracks<D>(scene, body);
  for (std::size_t k = 0; k < facets.size(); ++k) {
    cracks.push_back(
        {{"name", scene.text(fmt::format("cracks[{}].name", k))}, {"facets", facets[k]}});
  }
  return cracks;
}

}  // namespace

void check_picture_name(const std::string& file) {
  const std::string ending = std::filesystem::path(file).extension();
  if (ending == ".png" || ending == ".svg") return;
  throw InputError(
      fmt::format("--picture: '{}' has no ending that says how to draw; expected "
                  "a name with .png or .svg",
                  file));
}

void draw_setup(const Section& scene, const Simulation& simulation, const std::string& file) {
  nlohmann::json setup = {{"dimension", scene.integer("dimension")},
                          {"scene", written_in_si(scene)}};
  std::visit(
      [&](const auto& body) {
        if (!body) return;
        setup["body"] = body_json(*body);
        setup["cracks"] = cracks_json(scene, *body);
      },
      simulation.body);
  if (draw(data_folder() / "app/report/setup_picture.py", {file}, true, json_text(setup)) != 0) {
    throw OutputError(file, "the picture could not be drawn");
  }
}

}  // namespace perifrac
