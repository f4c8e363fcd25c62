#include "modules/pore_flow/pore_boundary.hpp"

#include <algorithm>

#include <fmt/format.h>

#include "core/geometry/face_conditions.hpp"
#include "core/geometry/read_point.hpp"
#include "core/operators/face_load.hpp"

namespace perifrac {

template <int D>
PoreBoundary<D>::PoreBoundary(const Body<D>& body) : body_(&body), faces_(body.faces().size()) {}

template <int D>
void PoreBoundary<D>::pressure(int face, double pressure) {
  faces_[face] = {Condition::pressure, pressure};
}

template <int D>
void PoreBoundary<D>::flux(int face, double inflow) {
  faces_[face] = {Condition::flux, inflow};
}

template <int D>
void PoreBoundary<D>::source(Index point, double rate) {
  sources_.emplace_back(point, rate);
}

template <int D>
FaceSet PoreBoundary<D>::mirrored() const {
  FaceSet set = 0;
  for (std::size_t f = 0; f < faces_.size(); ++f) {
    if (faces_[f].condition != Condition::flux) set |= face_bit(f);
  }
  return set;
}

template <int D>
MirrorCondition<D, 1> PoreBoundary<D>::mirror_condition(const Family<D>& family) const {
  MirrorCondition<D, 1> mirror(family);
  for (std::size_t f = 0; f < faces_.size(); ++f) {
    if (faces_[f].condition == Condition::pressure) mirror.set_odd(f, 0);
  }
  return mirror;
}

template <int D>
Eigen::VectorXd PoreBoundary<D>::face_pressures(const MirrorCondition<D, 1>& mirror) const {
  Eigen::VectorXd pressures(mirror.face_value_count());
  for (std::size_t f = 0; f < faces_.size(); ++f) {
    const int value = mirror.face_value(f, 0);
    if (value >= 0) pressures[value] = faces_[f].value;
  }
  return pressures;
}

template <int D>
bool PoreBoundary<D>::has_sources() const {
  return !sources_.empty() ||
         std::ranges::any_of(faces_, [](auto& f) { return f.condition == Condition::flux; });
}

template <int D>
Eigen::VectorXd PoreBoundary<D>::sources(const Eigen::SparseMatrix<double>& gradient) const {
  Eigen::VectorXd rate = Eigen::VectorXd::Zero(body_->points().size());
  for (std::size_t f = 0; f < faces_.size(); ++f) {
    if (faces_[f].condition != Condition::flux) continue;
    rate += faces_[f].value * face_load<D, 1>(*body_, gradient, mirrored(), f, 0);
  }
  for (const auto& [point, value] : sources_) rate[point] += value;
  return rate;
}

KeyTable pore_boundary_keys() {
  return {
      {.path = "boundary.*.type",
       .type = KeyType::word,
       .required = true,
       .words = {"sealed", "pressure", "flux"},
       .meaning = "Condition of a face; a face that is not named is sealed."},
      {.path = "boundary.*.pressure",
       .unit = "Pa",
       .required = true,
       .when = "type=pressure",
       .meaning = "Pore pressure on the face."},
      {.path = "boundary.*.flux",
       .unit = "m/s",
       .required = true,
       .when = "type=flux",
       .meaning = "Volume that enters per area and time; negative leaves."},
      {.path = "sources[].at",
       .type = KeyType::vector,
       .unit = "m",
       .required = true,
       .meaning = "Place of a source; the nearest point takes it."},
      {.path = "sources[].rate",
       .unit = "m^2/s|m^3/s",
       .required = true,
       .meaning = "Volume that the source adds per time; negative takes out."},
  };
}

template <int D>
PoreBoundary<D> read_pore_boundary(const Section& section, const Body<D>& body) {
  PoreBoundary<D> boundary(body);
  for (const auto& [face, type, path] :
       read_face_conditions(section, body.faces(), {"sealed", "pressure"})) {
    if (type == "pressure") boundary.pressure(face, section.number(path + ".pressure"));
    if (type == "flux") boundary.flux(face, section.number(path + ".flux"));
  }
  for (std::size_t n = 0; n < section.count("sources"); ++n) {
    const std::string item = fmt::format("sources[{}]", n);
    boundary.source(read_point<D>(section, item + ".at", body), section.number(item + ".rate"));
  }
  return boundary;
}

template class PoreBoundary<2>;
template class PoreBoundary<3>;
template PoreBoundary<2> read_pore_boundary<2>(const Section&, const Body<2>&);
template PoreBoundary<3> read_pore_boundary<3>(const Section&, const Body<3>&);

}  // namespace perifrac
