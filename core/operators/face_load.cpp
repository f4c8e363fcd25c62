#include "core/operators/face_load.hpp"

#include <algorithm>
#include <limits>
#include <vector>

#include <fmt/format.h>

#include "core/base/errors.hpp"

namespace perifrac {

template <int D, int R>
Eigen::VectorXd face_load(const Body<D>& body, const ForceOfStress& force_of, FaceSet mirrored,
                          int face, int component, FaceSet without_layers) {
  const Face& loaded = body.faces()[face];
  const int across = body.opposite(face);
  const Face& opposite = body.faces()[across];
  if (loaded.curved() || opposite.curved()) {
    throw BodyError(fmt::format("a load on face '{}' of a ball", loaded.name),
                    "a box, or another condition of this face");
  }
  const Index points = body.points().size();
  // Families within a horizon of the face are cut; their members lie within two. So it is at the
  // opposite face, or, where that one is mirrored, the stress jumps there and one horizon feels it.
  const double reach = 2.0 * body.horizon();
  const double needed = reach + (contains(mirrored, across) ? body.horizon() : reach);
  const double thickness = body.thickness(face, without_layers);
  if (thickness < needed * (1.0 - 1e-9)) {
    throw BodyError(fmt::format("{:g} m between faces '{}' and '{}' is too thin for a load on one",
                                thickness, loaded.name, opposite.name),
                    fmt::format("at least {:g} horizons, {:g} m", needed / body.horizon(), needed));
  }
  for (const Face& hole : body.holes()) {
    Vector<D> centre;
    std::copy_n(hole.centre.begin(), D, centre.begin());
    const double apart = loaded.depth(centre) - hole.coordinate;
    if (loaded.axis != hole.along && apart >= 2.0 * reach * (1.0 - 1e-9)) continue;
    throw BodyError(
        fmt::format("hole '{}' is {:g} m from face '{}', which is loaded", hole.name,
                    loaded.axis == hole.along ? 0.0 : std::max(0.0, apart), loaded.name),
        fmt::format("at least 4 horizons, {:g} m, or no load there", 2.0 * reach));
  }
  for (const Region<D>& box : body.cutouts()) {
    const int a = loaded.axis;
    const double apart =
        loaded.direction > 0 ? loaded.coordinate - box.to[a] : box.from[a] - loaded.coordinate;
    if (apart >= 2.0 * reach * (1.0 - 1e-9)) continue;
    throw BodyError(fmt::format("cut-out '{}' is {:g} m from face '{}', which is loaded", box.name,
                                std::max(0.0, apart), loaded.name),
                    fmt::format("at least 4 horizons, {:g} m, or no load there", 2.0 * reach));
  }
  const auto depth = [&](Index i) {
    return std::abs(loaded.coordinate - body.points().position[loaded.axis][i]);
  };
  Eigen::VectorXd stress = Eigen::VectorXd::Zero(R * D * points);
  for (Index i = 0; i < points; ++i) {
    if (depth(i) > reach + 1.01 * body.horizon()) continue;  // no bond to where it is asked for
    stress[(component * D + loaded.axis) * points + i] = loaded.direction * body.points().volume[i];
  }
  const Eigen::VectorXd forces = force_of(stress);
  Eigen::VectorXd load = Eigen::VectorXd::Zero(points);
  for (Index i = 0; i < points; ++i) {
    if (depth(i) <= reach) load[i] = forces[component * points + i];
  }
  return load;
}

namespace {

/// Coordinates of the walls of a box that are normal to an axis and lie within the body. Throws
/// BodyError where one is within `least` of a face.
template <int D>
std::vector<double> walls_of(const Body<D>& body, const Region<D>& box, int axis, double least) {
  const double low = body.faces()[2 * axis].coordinate;
  const double high = body.faces()[2 * axis + 1].coordinate;
  std::vector<double> walls;
  for (const double wall : {box.from[axis], box.to[axis]}) {
    if (wall <= low || wall >= high) continue;
    walls.push_back(wall);
    const double apart = std::min(wall - low, high - wall);
    if (apart >= least * (1.0 - 1e-9)) continue;
    throw BodyError(fmt::format("a wall of cut-out '{}' is {:g} m from the face beside it, in a "
                                "body under confining stress",
                                box.name, apart),
                    fmt::format("at least 4 horizons, {:g} m, or no confining stress", least));
  }
  return walls;
}

}  // namespace

template <int D>
Eigen::VectorXd cutout_load(const Body<D>& body, const ForceOfStress& force_of, int axis) {
  const Index points = body.points().size();
  const double reach = 2.0 * body.horizon();
  Eigen::VectorXd stress = Eigen::VectorXd::Zero(D * D * points);
  for (Index i = 0; i < points; ++i) {
    stress[(axis * D + axis) * points + i] = body.points().volume[i];
  }
  const Eigen::VectorXd forces = force_of(stress);
  Eigen::VectorXd load = Eigen::VectorXd::Zero(points);
  for (const Region<D>& box : body.cutouts()) {
    const std::vector<double> walls = walls_of(body, box, axis, 2.0 * reach);
    for (Index i = 0; i < points; ++i) {
      const Vector<D> x = body.points().at(i);
      bool beside = std::ranges::any_of(
          walls, [&](double wall) { return std::abs(x[axis] - wall) <= reach; });
      for (int a = 0; a < D; ++a) {
        beside = beside && x[a] >= box.from[a] - reach && x[a] <= box.to[a] + reach;
      }
      if (beside) load[i] = forces[axis * points + i];
    }
  }
  return load;
}

template <int D>
Eigen::VectorXd curved_load(const Body<D>& body, const ForceOfStress& force_of, FaceSet mirrored,
                            const Face& curved, const Vector<D>& stress) {
  const Index points = body.points().size();
  // Volumes of a ball's points follow its surface, which is felt deeper than two horizons.
  const double reach =
      curved.is_hole() ? 2.0 * body.horizon() : std::numeric_limits<double>::infinity();
  Eigen::VectorXd everywhere = Eigen::VectorXd::Zero(D * D * points);
  for (int a = 0; a < D; ++a) {
    for (Index i = 0; i < points; ++i) {
      everywhere[(a * D + a) * points + i] = stress[a] * body.points().volume[i];
    }
  }
  const Eigen::VectorXd forces = force_of(everywhere);
  Eigen::VectorXd load = Eigen::VectorXd::Zero(D * points);
  for (Index i = 0; i < points; ++i) {
    const Vector<D> x = body.points().at(i);
    if (curved.depth(x) > reach) continue;
    for (int f = 0; f < std::ssize(body.faces()); ++f) {
      const Face& face = body.faces()[f];
      if (face.curved() || contains(mirrored, f) || face.depth(x) > reach) continue;
      throw BodyError(fmt::format("face '{}', which bears load, is less than 4 horizons from "
                                  "face '{}', which is free",
                                  curved.name, face.name),
                      fmt::format("{:g} m, or a face that is held", 4.0 * body.horizon()));
    }
    for (int a = 0; a < D; ++a) load[a * points + i] = forces[a * points + i];
  }
  return load;
}

template Eigen::VectorXd curved_load<2>(const Body<2>&, const ForceOfStress&, FaceSet, const Face&,
                                        const Vector<2>&);
template Eigen::VectorXd curved_load<3>(const Body<3>&, const ForceOfStress&, FaceSet, const Face&,
                                        const Vector<3>&);
template Eigen::VectorXd cutout_load<2>(const Body<2>&, const ForceOfStress&, int);
template Eigen::VectorXd cutout_load<3>(const Body<3>&, const ForceOfStress&, int);
template Eigen::VectorXd face_load<2, 1>(const Body<2>&, const ForceOfStress&, FaceSet, int, int,
                                         FaceSet);
template Eigen::VectorXd face_load<2, 2>(const Body<2>&, const ForceOfStress&, FaceSet, int, int,
                                         FaceSet);
template Eigen::VectorXd face_load<3, 1>(const Body<3>&, const ForceOfStress&, FaceSet, int, int,
                                         FaceSet);
template Eigen::VectorXd face_load<3, 3>(const Body<3>&, const ForceOfStress&, FaceSet, int, int,
                                         FaceSet);

}  // namespace perifrac
