#include "modules/solid/boundary/solid_boundary_keys.hpp"

#include <algorithm>

#include <fmt/format.h>

#include "core/body/outside.hpp"
#include "core/body/read_point.hpp"
#include "core/config/mistakes.hpp"
#include "core/geometry/face_conditions.hpp"
#include "core/time/schedule.hpp"

namespace perifrac {

// NOLINTNEXTLINE(readability-function-size): a table
KeyTable solid_boundary_keys() {
  KeyTable keys = {
      {.path = "boundary.*.type",
       .type = KeyType::word,
       .required = true,
       .words = {"free", "traction", "pressure", "roller", "fixed", "rigid_plate"},
       .meaning = "Condition of a face, on the points of its layer where the body has one; a face "
                  "that is not named is free. The wall of a round hole takes free and pressure."},
      {.path = "boundary.*.traction",
       .type = KeyType::vector,
       .unit = "Pa",
       .required = true,
       .when = "type=traction",
       .meaning = "Force per area on the face."},
      {.path = "boundary.*.pressure",
       .unit = "Pa",
       .required = true,
       .when = "type=pressure",
       .meaning = "Pressure that presses on the face, plane, sphere or wall of a round hole."},
      {.path = "boundary.*.normal_displacement",
       .unit = "m",
       .fallback = "0 m",
       .when = "type=roller",
       .meaning = "Displacement of the face along its outward normal."},
      {.path = "boundary.*.normal_velocity",
       .unit = "m/s",
       .fallback = "0 m/s",
       .when = "type=roller",
       .meaning = "Times t, it adds to normal_displacement; no schedule multiplies it."},
      {.path = "boundary.*.displacement",
       .type = KeyType::vector,
       .unit = "m",
       .when = "type=fixed",
       .meaning = "Displacement of the face; 0 where left out."},
      {.path = "boundary.*.velocity",
       .type = KeyType::vector,
       .unit = "m/s",
       .when = "type=fixed",
       .meaning = "Times t, it adds to displacement; no schedule multiplies it."},
      {.path = "boundary.*.region",
       .type = KeyType::text,
       .when = "type=roller|fixed",
       .meaning = "Region of the body; the face is held only where its layer lies in it, and free "
                  "elsewhere."},
      {.path = "boundary.*.force",
       .unit = "N/m|N",
       .required = true,
       .when = "type=rigid_plate",
       .meaning = "Force that presses the plate on the body."},
      {.path = "pins[].at",
       .type = KeyType::vector,
       .unit = "m",
       .required = true,
       .meaning = "Place of a point, the nearest, that keeps one displacement at 0, where loads "
                  "balance and nothing else would hold the body."},
      {.path = "pins[].axis",
       .type = KeyType::word,
       .required = true,
       .words = {"x", "y", "z"},
       .meaning = "Which one."},
      {.path = "body_force",
       .type = KeyType::vector,
       .unit = "N/m^3",
       .meaning = "Force per volume, beside gravity; 0 where left out."},
      {.path = "density",
       .unit = "kg/m^3",
       .range = "(0, inf)",
       .meaning = "Bulk density of the saturated rock; gravity needs it."},
  };
  for (const KeyTable& part : {schedule_keys("boundary.*."), schedule_keys("body_force_")}) {
    keys.insert(keys.end(), part.begin(), part.end());
  }
  return keys;
}

namespace {

template <int D>
Vector<D> read_vector(const Section& section, const std::string& path) {
  Vector<D> result{};
  if (section.has(path)) std::ranges::copy(section.numbers(path), result.begin());
  return result;
}

/// The schedule at a path, which must have something to multiply.
Schedule read_schedule_of(const Section& section, const std::string& at, bool zero) {
  Schedule schedule = read_schedule_at(section, at);
  if (zero && !schedule.is_constant()) {
    section.fail(at, "nothing that it could multiply", "a schedule beside a value other than 0");
  }
  return schedule;
}

template <int D>
void read_face(const Section& section, const FaceCondition& condition, SolidBoundary<D>& boundary) {
  const auto& face = condition.face;
  const std::string& type = condition.type;
  const std::string& path = condition.path;
  const auto number = [&](const char* key) { return section.number(path + key); };
  const auto vector = [&](const char* key) { return read_vector<D>(section, path + key); };
  const auto schedule = [&](const auto& value) {
    return read_schedule_of(section, path + ".schedule", value == std::decay_t<decltype(value)>{});
  };
  if (type == "roller") {
    const double displacement = number(".normal_displacement");
    boundary.roller(face, displacement, number(".normal_velocity"), schedule(displacement));
  } else if (type == "fixed") {
    const Vector<D> displacement = vector(".displacement");
    boundary.fixed(face, displacement, vector(".velocity"), schedule(displacement));
  } else if (type == "rigid_plate") {
    const double force = number(".force");
    boundary.rigid_plate(face, force, schedule(force));
  } else if (type == "traction") {
    const Vector<D> traction = vector(".traction");
    boundary.traction(face, traction, schedule(traction));
  } else if (type == "pressure") {
    const double pressure = number(".pressure");
    boundary.pressure(face, pressure, schedule(pressure));
  } else {
    schedule(0.0);
  }
}

/// A part of a face can be held where a layer stands for its ghosts.
template <int D>
void read_held_region(const Section& section, const Body<D>& body, const FaceCondition& condition,
                      SolidBoundary<D>& boundary) {
  const std::string path = condition.path + ".region";
  if (condition.type != "roller" && condition.type != "fixed") return;
  if (!section.has(path)) return;
  const std::span<const Index> layer = body.layer(condition.face);
  if (layer.empty()) section.fail(path, "on a face without a layer", "body.boundary: layer there");
  const std::string name = section.text(path);
  const auto region = std::ranges::find(body.regions(), name, &Region<D>::name);
  if (region == body.regions().end()) {
    std::vector<std::string> known;
    for (const Region<D>& each : body.regions()) known.push_back(each.name);
    section.fail_unknown(path, name, known);
  }
  if (std::ranges::none_of(layer, [&](Index i) { return region->contains(body.points().at(i)); })) {
    section.fail(path, "'" + name + "' holds no point of the layer", "a region that does");
  }
  boundary.hold_only_in(condition.face, *region);
}

/// What pressure does on a sphere is known only where the plane faces beside it are mirrored.
void check_sphere_pressure(const Section& section, const FaceCondition& condition,
                           const std::vector<Face>& faces, FaceSet mirrored) {
  const Face& sphere = faces[condition.face];
  if (!sphere.curved() || sphere.is_hole() || condition.type != "pressure") return;
  for (int f = 0; f < std::ssize(faces); ++f) {
    if (faces[f].curved() || contains(mirrored, f)) continue;
    section.fail(condition.path, "pressure beside the free face '" + faces[f].name + "'",
                 "roller, fixed or rigid_plate on all plane faces of the ball");
  }
}

/// A pin is to hold what would float: beside a roller at rest that holds the same displacement of a
/// whole face it strains the rock in between. One that moves, or holds a part, may press on pins.
void refuse_what_rollers_hold(const Section& section, const std::string& pin, int axis,
                              const std::vector<FaceCondition>& conditions,
                              const std::vector<Face>& faces) {
  for (const FaceCondition& condition : conditions) {
    const Face& face = faces[condition.face];
    const std::string& path = condition.path;
    if (condition.type != "roller" || face.axis != axis || section.has(path + ".region") ||
        section.number(path + ".normal_displacement") != 0.0 ||
        section.number(path + ".normal_velocity") != 0.0) {
      continue;
    }
    section.fail(pin,
                 fmt::format("holds the displacement along {}, which the roller at face '{}' holds",
                             "xyz"[axis], face.name),
                 "pins only along axes that no roller holds");
  }
}

/// The nearest point of the body proper, which a place in a bonded layer may be said by too.
template <int D>
Index read_pinned_point(const Section& section, const std::string& path, const Body<D>& body) {
  const auto x = read_vector<D>(section, path);
  const bool is_beyond_a_face = std::ranges::any_of(body.faces(), [&](const Face& face) {
    return !face.curved() && face.direction * (x[face.axis] - face.coordinate) > 0.0;
  });
  const bool in_layer = is_beyond_a_face && face_before<D>(body, x) < 0;
  return in_layer ? body.nearest_point(x) : read_point(section, path, body);
}

template <int D>
void read_pins(const Section& section, const Body<D>& body,
               const std::vector<FaceCondition>& conditions, SolidBoundary<D>& boundary,
               Mistakes& mistakes) {
  for (std::size_t k = 0; k < section.count("pins"); ++k) {
    const std::string path = fmt::format("pins[{}]", k);
    mistakes.note([&] {
      const int axis = section.word(path + ".axis")[0] - 'x';
      if (axis >= D) section.fail(path + ".axis", "'z' in 2D", "x or y");
      refuse_what_rollers_hold(section, path, axis, conditions, body.faces());
      boundary.pin(read_pinned_point(section, path + ".at", body), axis);
    });
  }
}

template <int D>
void read_body_force(const Section& section, SolidBoundary<D>& boundary) {
  const auto force = read_vector<D>(section, "body_force");
  const Schedule schedule = read_schedule_of(section, "body_force_schedule", force == Vector<D>{});
  if (force != Vector<D>{}) boundary.body_force(force, schedule);
}

template <int D>
void read_gravity(const Section& section, SolidBoundary<D>& boundary) {
  if (!section.scene().has("gravity") || !section.has("density")) return;
  if (section.has("stress_gradient")) return;  // which bears it (stress_at_rest.hpp)
  boundary.gravity(section.number("density"), read_vector<D>(section.scene(), "gravity"));
}

}  // namespace

template <int D>
SolidBoundary<D> read_solid_boundary(const Section& section, const Body<D>& body) {
  SolidBoundary<D> boundary(body);
  Mistakes mistakes;
  std::vector<FaceCondition> conditions;
  mistakes.note([&] {
    conditions = read_face_conditions(section, body.faces(), {"free", "pressure"});
  });
  for (const FaceCondition& condition : conditions) {
    mistakes.note([&] {
      read_face(section, condition, boundary);
      read_held_region(section, body, condition, boundary);
    });
  }
  for (const FaceCondition& condition : conditions) {
    mistakes.note(
        [&] { check_sphere_pressure(section, condition, body.faces(), boundary.mirrored()); });
  }
  read_pins(section, body, conditions, boundary, mistakes);
  mistakes.note([&] { read_body_force(section, boundary); });
  mistakes.note([&] { read_gravity(section, boundary); });
  mistakes.throw_if_any();
  for (const char* stress : {"confining_stress", "total_stress"}) {
    if (!body.has_cutouts() || !section.has(stress)) continue;
    boundary.relieve_cutouts(read_vector<D>(section, stress));
  }
  return boundary;
}

template SolidBoundary<2> read_solid_boundary<2>(const Section&, const Body<2>&);
template SolidBoundary<3> read_solid_boundary<3>(const Section&, const Body<3>&);

}  // namespace perifrac
