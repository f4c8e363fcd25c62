#include "modules/solid/solid_boundary.hpp"

#include <algorithm>

#include "core/geometry/face_conditions.hpp"
#include "core/operators/face_load.hpp"

namespace perifrac {

template <int D>
SolidBoundary<D>::SolidBoundary(const Body<D>& body) : body_(&body), faces_(body.faces().size()) {}

template <int D>
void SolidBoundary<D>::roller(int face, double normal_displacement) {
  faces_[face].hold = Hold::roller;
  const Face& plane = body_->faces()[face];
  faces_[face].displacement[plane.axis] = plane.direction * normal_displacement;
}

template <int D>
void SolidBoundary<D>::fixed(int face, const Vector<D>& displacement) {
  faces_[face].hold = Hold::fixed;
  faces_[face].displacement = displacement;
}

template <int D>
void SolidBoundary<D>::rigid_plate(int face, double force) {
  faces_[face].hold = Hold::rigid_plate;
  faces_[face].plate_force = -body_->faces()[face].direction * force;
}

template <int D>
void SolidBoundary<D>::traction(int face, const Vector<D>& traction) {
  faces_[face].traction = traction;
  faces_[face].loaded = true;
}

template <int D>
FaceSet SolidBoundary<D>::mirrored() const {
  FaceSet set = 0;
  for (std::size_t f = 0; f < faces_.size(); ++f) {
    if (faces_[f].hold != Hold::free) set |= face_bit(f);
  }
  return set;
}

template <int D>
MirrorCondition<D, D> SolidBoundary<D>::mirror_condition(const Family<D>& family) const {
  MirrorCondition<D, D> mirror(family);
  for (std::size_t f = 0; f < faces_.size(); ++f) {
    for (int a = 0; a < D; ++a) {
      const bool normal = a == body_->faces()[f].axis;
      if (faces_[f].hold == Hold::fixed || (faces_[f].hold != Hold::free && normal)) {
        mirror.set_odd(f, a);
      }
    }
  }
  return mirror;
}

template <int D>
auto SolidBoundary<D>::plates(const MirrorCondition<D, D>& mirror) const -> std::vector<Plate> {
  std::vector<Plate> plates;
  for (std::size_t f = 0; f < faces_.size(); ++f) {
    if (faces_[f].hold != Hold::rigid_plate) continue;
    const Face& face = body_->faces()[f];
    plates.push_back({face.name, D * body_->points().size() + mirror.face_value(f, face.axis)});
  }
  return plates;
}

template <int D>
Eigen::VectorXd SolidBoundary<D>::prescribed_values(const MirrorCondition<D, D>& mirror) const {
  const Index points = D * body_->points().size();
  Eigen::VectorXd values = Eigen::VectorXd::Zero(points + mirror.face_value_count());
  for (std::size_t f = 0; f < faces_.size(); ++f) {
    for (int a = 0; a < D; ++a) {
      const int value = mirror.face_value(f, a);
      if (value >= 0) values[points + value] = faces_[f].displacement[a];
    }
  }
  return values;
}

template <int D>
Eigen::VectorXd SolidBoundary<D>::load(const MirrorCondition<D, D>& mirror,
                                       const Eigen::SparseMatrix<double>& gradient) const {
  const Index points = body_->points().size();
  Eigen::VectorXd load = Eigen::VectorXd::Zero(D * points + mirror.face_value_count());
  for (int a = 0; a < D; ++a) {
    for (Index i = 0; i < points; ++i) {
      load[a * points + i] = body_force_[a] * body_->points().volume[i];
    }
  }
  for (std::size_t f = 0; f < faces_.size(); ++f) {
    if (faces_[f].hold == Hold::rigid_plate) {
      const int plate = mirror.face_value(f, body_->faces()[f].axis);
      load[D * points + plate] = faces_[f].plate_force;
    }
    for (int a = 0; a < D && faces_[f].loaded; ++a) {
      load.segment(a * points, points) +=
          faces_[f].traction[a] * face_load<D, D>(*body_, gradient, mirrored(), f, a);
    }
  }
  return load;
}

KeyTable solid_boundary_keys() {
  return {
      {.path = "boundary.*.type",
       .type = KeyType::word,
       .required = true,
       .words = {"free", "traction", "roller", "fixed", "rigid_plate"},
       .meaning = "Condition of a face; a face that is not named is free."},
      {.path = "boundary.*.traction",
       .type = KeyType::vector,
       .unit = "Pa",
       .required = true,
       .when = "type=traction",
       .meaning = "Force per area on the face."},
      {.path = "boundary.*.normal_displacement",
       .unit = "m",
       .fallback = "0 m",
       .when = "type=roller",
       .meaning = "Displacement of the face along its outward normal."},
      {.path = "boundary.*.displacement",
       .type = KeyType::vector,
       .unit = "m",
       .when = "type=fixed",
       .meaning = "Displacement of the face; 0 where left out."},
      {.path = "boundary.*.force",
       .unit = "N/m|N",
       .required = true,
       .when = "type=rigid_plate",
       .meaning = "Force that presses the plate on the body."},
      {.path = "body_force",
       .type = KeyType::vector,
       .unit = "N/m^3",
       .meaning = "Force per volume; 0 where left out."},
  };
}

namespace {

template <int D>
Vector<D> read_vector(const Section& section, const std::string& path) {
  Vector<D> result{};
  if (section.has(path)) std::ranges::copy(section.numbers(path), result.begin());
  return result;
}

}  // namespace

template <int D>
SolidBoundary<D> read_solid_boundary(const Section& section, const Body<D>& body) {
  SolidBoundary<D> boundary(body);
  for (const auto& [face, type, path] : read_face_conditions(section, body.faces(), {"free"})) {
    if (type == "roller") {
      boundary.roller(face, section.number(path + ".normal_displacement"));
    } else if (type == "fixed") {
      boundary.fixed(face, read_vector<D>(section, path + ".displacement"));
    } else if (type == "rigid_plate") {
      boundary.rigid_plate(face, section.number(path + ".force"));
    } else if (type == "traction") {
      boundary.traction(face, read_vector<D>(section, path + ".traction"));
    }
  }
  boundary.body_force(read_vector<D>(section, "body_force"));
  return boundary;
}

template class SolidBoundary<2>;
template class SolidBoundary<3>;
template SolidBoundary<2> read_solid_boundary<2>(const Section&, const Body<2>&);
template SolidBoundary<3> read_solid_boundary<3>(const Section&, const Body<3>&);

}  // namespace perifrac
