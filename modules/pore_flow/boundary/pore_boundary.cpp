#include "modules/pore_flow/boundary/pore_boundary.hpp"

#include <algorithm>
#include <bit>

#include <fmt/format.h>

#include "core/body/read_point.hpp"
#include "core/geometry/face_conditions.hpp"
#include "core/operators/face_load.hpp"
#include "modules/pore_flow/boundary/pore_gravity.hpp"

namespace perifrac {

template <int D>
PoreBoundary<D>::PoreBoundary(const Body<D>& body) : body_(&body), faces_(body.faces().size()) {}

template <int D>
void PoreBoundary<D>::pressure(int face, double pressure, Schedule schedule) {
  faces_[face] = {Condition::pressure, pressure, std::move(schedule)};
}

template <int D>
void PoreBoundary<D>::flux(int face, double inflow, Schedule schedule) {
  faces_[face] = {Condition::flux, inflow, std::move(schedule)};
}

template <int D>
void PoreBoundary<D>::source(Index point, double rate, Schedule schedule) {
  sources_.push_back({point, rate, std::move(schedule)});
}

template <int D>
FaceSet PoreBoundary<D>::faces_with(Condition condition, bool layered) const {
  FaceSet set = 0;
  for (int f = 0; f < std::ssize(faces_); ++f) {
    if (faces_[f].condition == condition && body_->layer(f).empty() != layered) set |= face_bit(f);
  }
  return set;
}

template <int D>
FaceSet PoreBoundary<D>::mirrored() const {
  return sealed() | faces_with(Condition::pressure, false);
}

template <int D>
FaceSet PoreBoundary<D>::sealed() const {
  return faces_with(Condition::sealed, false);
}

template <int D>
FaceSet PoreBoundary<D>::sealed_layers() const {
  return faces_with(Condition::sealed, true);
}

template <int D>
FaceSet PoreBoundary<D>::pressure_layers() const {
  return faces_with(Condition::pressure, true);
}

template <int D>
MirrorCondition<D, 1> PoreBoundary<D>::mirror_condition(const Family<D>& family) const {
  MirrorCondition<D, 1> mirror(family);
  for (int f = 0; f < std::ssize(faces_); ++f) {
    if (contains(faces_with(Condition::pressure, false), f)) mirror.set_odd(f, 0);
  }
  return mirror;
}

template <int D>
std::vector<HeldPoint> PoreBoundary<D>::held_points(const MirrorCondition<D, 1>& mirror) const {
  constexpr int dry = -1, free = -2;
  std::vector<int> held(body_->points().size(), free);
  int face_value = mirror.face_value_count();
  for (int f = 0; f < std::ssize(faces_); ++f) {
    for (const Index i : body_->layer(f)) {
      if (contains(sealed_layers(), f)) held[i] = dry;
      if (contains(pressure_layers(), f) && held[i] == free) held[i] = face_value;
    }
    if (contains(pressure_layers(), f)) ++face_value;
  }
  std::vector<HeldPoint> points;
  for (std::size_t i = 0; i < held.size(); ++i) {
    if (held[i] != free) points.push_back({static_cast<Index>(i), held[i]});
  }
  return points;
}

template <int D>
ScheduledVector PoreBoundary<D>::face_pressures(const MirrorCondition<D, 1>& mirror) const {
  const int count = mirror.face_value_count() + std::popcount(pressure_layers());
  int layer_value = mirror.face_value_count();
  ScheduledVector pressures(count);
  for (int f = 0; f < std::ssize(faces_); ++f) {
    const int value = contains(pressure_layers(), f) ? layer_value++ : mirror.face_value(f, 0);
    if (value < 0) continue;
    pressures.add(faces_[f].schedule, faces_[f].value * Eigen::VectorXd::Unit(count, value));
  }
  return pressures;
}

template <int D>
Eigen::VectorXd PoreBoundary<D>::area_in_layer(int face) const {
  Eigen::VectorXd share = Eigen::VectorXd::Zero(body_->points().size());
  for (const Index i : body_->layer(face)) share[i] = body_->points().volume[i];
  for (int f = 0; f < 2 * D; ++f) {
    if (!contains(sealed_layers(), f)) continue;
    for (const Index i : body_->layer(f)) share[i] = 0.0;
  }
  return body_->area(face) / share.sum() * share;
}

template <int D>
bool PoreBoundary<D>::has_sources() const {
  return !sources_.empty() ||
         std::ranges::any_of(faces_, [](auto& f) { return f.condition == Condition::flux; });
}

template <int D>
ScheduledVector PoreBoundary<D>::sources(const ForceOfStress& force_of) const {
  return sources_by(
      [&](int face) { return face_load<D, 1>(*body_, force_of, mirrored(), face, 0); });
}

template <int D>
ScheduledVector PoreBoundary<D>::sources_by(const FaceArea& area_by_point) const {
  const Index points = body_->points().size();
  ScheduledVector rate(points);
  for (int f = 0; f < std::ssize(faces_); ++f) {
    if (faces_[f].condition != Condition::flux) continue;
    const bool layered = !body_->layer(f).empty();
    rate.add(faces_[f].schedule, faces_[f].value * (layered ? area_in_layer(f) : area_by_point(f)));
  }
  for (const auto& [point, value, schedule] : sources_) {
    rate.add(schedule, value * Eigen::VectorXd::Unit(points, point));
  }
  return rate;
}

KeyTable pore_boundary_keys() {
  KeyTable keys = {
      {.path = "boundary.*.type",
       .type = KeyType::word,
       .required = true,
       .words = {"sealed", "pressure", "flux"},
       .meaning = "Condition of a face; a face that is not named is sealed. The wall of a round "
                  "hole takes sealed and pressure."},
      {.path = "boundary.*.pressure",
       .unit = "Pa",
       .required = true,
       .when = "type=pressure",
       .meaning = "Pore pressure on the face."},
      {.path = "boundary.*.hydrostatic",
       .type = KeyType::boolean,
       .fallback = "false",
       .when = "type=pressure",
       .meaning =
           "The pressure is that of the highest place of the face and grows downwards by the "
           "fluid's weight. Needed where gravity runs along the face."},
      {.path = "boundary.*.flux",
       .unit = "m/s",
       .required = true,
       .when = "type=flux",
       .meaning = "Volume that enters per area and time, at zero pressure; negative leaves."},
      {.path = "sources[].at",
       .type = KeyType::vector,
       .unit = "m",
       .required = true,
       .meaning = "Place of a source; the nearest point takes it."},
      {.path = "sources[].rate",
       .unit = "m^2/s|m^3/s",
       .required = true,
       .meaning = "Volume that the source adds per time, at zero pressure; negative takes out."},
  };
  for (const KeyTable& part : {schedule_keys("boundary.*."), schedule_keys("sources[].")}) {
    keys.insert(keys.end(), part.begin(), part.end());
  }
  return keys;
}

template <int D>
PoreBoundary<D> read_pore_boundary(const Section& section, const Body<D>& body) {
  PoreBoundary<D> boundary(body);
  const PoreGravity<D> gravity(body, read_gravity<D>(section), 1.0);
  for (const auto& [face, type, path] :
       read_face_conditions(section, body.faces(), {"sealed", "pressure"})) {
    const Schedule schedule = read_schedule(section, path);
    if (type == "sealed" && !schedule.is_constant()) {
      section.fail(path + ".schedule", "nothing to multiply on a sealed face",
                   "type: pressure or flux");
    }
    if (type == "flux") boundary.flux(face, section.number(path + ".flux"), schedule);
    if (type != "pressure") continue;
    if (body.faces()[face].curved() && section.scene().has("gravity")) {
      section.fail(path, "a prescribed pressure on a curved face under gravity",
                   "a body with plane faces");
    }
    boundary.pressure(face, section.number(path + ".pressure"), schedule);
    if (!section.boolean(path + ".hydrostatic") && !gravity.crosses(face)) {
      section.fail(path, "a uniform pressure on a face along which gravity runs",
                   "hydrostatic: true");
    }
  }
  for (std::size_t n = 0; n < section.count("sources"); ++n) {
    const std::string item = fmt::format("sources[{}]", n);
    boundary.source(read_point<D>(section, item + ".at", body), section.number(item + ".rate"),
                    read_schedule(section, item));
  }
  return boundary;
}

template class PoreBoundary<2>;
template class PoreBoundary<3>;
template PoreBoundary<2> read_pore_boundary<2>(const Section&, const Body<2>&);
template PoreBoundary<3> read_pore_boundary<3>(const Section&, const Body<3>&);

}  // namespace perifrac
