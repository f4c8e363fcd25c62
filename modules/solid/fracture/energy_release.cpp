#include "modules/solid/fracture/energy_release.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <numeric>

#include "core/base/small_vector.hpp"
#include "core/bonds/bond_traversal.hpp"
#include "core/bonds/shape_tensor.hpp"

namespace perifrac {

namespace {

double length(const Vector<2>& a) { return std::hypot(a[0], a[1]); }

/// The weight q of the domain integral, 1 at the tip, and its gradient.
struct Cutoff {
  Vector<2> centre;
  double inner;
  double outer;

  double at(const Vector<2>& x) const {
    const double distance = length(x - centre);
    if (distance <= inner) return 1.0;
    if (distance >= outer) return 0.0;
    return 0.5 * (1.0 + std::cos(M_PI * (distance - inner) / (outer - inner)));
  }

  bool reaches(const Vector<2>& x) const {
    return std::abs(x[0] - centre[0]) < outer && std::abs(x[1] - centre[1]) < outer;
  }

  Vector<2> gradient(const Vector<2>& x) const {
    const Vector<2> r = x - centre;
    const double distance = length(r);
    if (distance <= inner || distance >= outer) return {};
    const double slope =
        -0.5 * M_PI / (outer - inner) * std::sin(M_PI * (distance - inner) / (outer - inner));
    return slope * r / distance;
  }
};

/// d . grad a at point i, from the bonds that are left.
double rise_along(const Vector<2>& d, std::span<const double> a, const Family<2>& family, Index i) {
  if (is_thin(family, i)) return 0.0;
  const auto moment = sum_over_bonds<2>(family, i, [&](Index j, const Vector<2>& xi, double w) {
    const Index end = j < family.point_count ? j : family.ghost_source[j - family.point_count];
    const double difference = w * (a[end] - a[i]);
    return difference * xi;
  });
  const auto shape = shape_tensor_at(family, i);
  const double determinant = shape[0] * shape[3] - shape[1] * shape[2];
  const Vector<2> gradient = {(shape[3] * moment[0] - shape[1] * moment[1]) / determinant,
                              (shape[0] * moment[1] - shape[2] * moment[0]) / determinant};
  return dot(d, gradient);
}

/// The jump that turns a straight crack least reliably is the last one. On a row at 26.6 degrees to
/// the lattice jumps repeat every 2.2 spacings: the mean is over more than that.
constexpr double first_jump = 1.0, last_jump = 4.0;  // spacings behind the tip

/// K_II / K_I over the ratio of the jumps at 1-4 spacings behind a tip on a lattice.
constexpr double mode_ratio = 0.87;

/// What J looks at around a tip, at least [spacings].
constexpr double least_ring = 2.0;

/// Cosine of the direction to another tip. The other end of its own crack lies behind: of seeds
/// that are so short others know (short_seeds.hpp).
constexpr double abreast = -0.5;

/// J of another tip, which goes with the square of its opening, counts beside that of this one
/// where it opens by more than this of its opening.
constexpr double telling_opening = 0.25;

constexpr double largest_kink = 70.0 * M_PI / 180.0;

/// A turn below this is rounding [rad].
constexpr double least_kink = 1e-6;

}  // namespace

EnergyRelease::EnergyRelease(CutBody<2>& body, double spacing, std::vector<Face> holes)
    : body_(body), spacing_(spacing), holes_(std::move(holes)), by_x_(body.family().point_count) {
  std::iota(by_x_.begin(), by_x_.end(), 0);
  std::ranges::sort(by_x_, {}, [&](Index i) { return body.family().position[0][i]; });
  mirrors_.fill({-INFINITY, INFINITY});
  const Family<2>& family = body.family();
  for (Index g = 0; g < family.ghost_count() && !family.curved; ++g) {
    const Vector<2> source = vector_at(family.position, family.ghost_source[g]);
    const Vector<2> image = vector_at(family.position, family.point_count + g);
    for (int a = 0; a < 2; ++a) {
      if (std::abs(image[1 - a] - source[1 - a]) > 1e-9 * spacing) continue;
      mirrors_[a][image[a] > source[a] ? 1 : 0] = 0.5 * (image[a] + source[a]);
    }
  }
}

TipLoad EnergyRelease::at(const CrackTip& tip, std::span<const double> unknowns,
                          const Eigen::VectorXd& pressure, std::span<const double> pore_stress,
                          const PointInertia<2>& inertia, std::span<const double> shear) const {
  const std::vector<Vector<2>> jumps = jumps_in(unknowns);
  const auto load = [&](Index f) -> Vector<2> {
    const Vector<2> relief = body_.relief(f);
    return {pressure[f] + relief[0], shear.empty() ? relief[1] : relief[1] + shear[f]};
  };
  const double ring = radius(tip, jumps);
  return {jump(tip, jumps),
          of_points(tip, ring, unknowns, pore_stress, inertia) + of_faces(tip, ring, jumps, load)};
}

TipLoad EnergyRelease::under(const CrackTip& tip, std::span<const double> unknowns,
                             std::span<const Index> faces, const Vector<2>& traction) const {
  const std::vector<Vector<2>> jumps = jumps_in(unknowns);
  const auto load = [&](Index f) {
    return std::ranges::find(faces, f) != faces.end() ? traction : Vector<2>{};
  };
  const double ring = radius(tip, jumps);
  return {jump(tip, jumps),
          of_points(tip, ring, unknowns, {}, {}) + of_faces(tip, ring, jumps, load)};
}

std::vector<Vector<2>> EnergyRelease::jumps_in(std::span<const double> unknowns) const {
  std::vector<Vector<2>> jumps;
  for (std::size_t f = 0; f < body_.jumps().size(); ++f) {
    jumps.push_back(body_.jump(static_cast<Index>(f), unknowns));
  }
  return jumps;
}

bool EnergyRelease::reaches(const Vector<2>& x, double distance) const {
  const auto is_clear = [&](const Face& hole) {  // points end half a spacing before a wall
    return hole.depth(x) >= distance + 0.5 * spacing_;
  };
  return body_.reaches(x, distance) && std::ranges::all_of(holes_, is_clear);
}

/// Near a boundary the ring is drawn in, so as to lie within the body [m].
double EnergyRelease::largest_radius(const CrackTip& tip) const {
  return (reaches(tip.place, largest_ring * spacing_) ? largest_ring : 3.0) * spacing_;
}

/// And near another tip so as to hold this one alone [m].
double EnergyRelease::radius(const CrackTip& tip, std::span<const Vector<2>> jumps) const {
  double alone = largest_radius(tip);
  const auto counts = [&](Index f) { return jumps[f][0] > telling_opening * jumps[tip.facet][0]; };
  for_tips_around(tip, counts, [&](const OtherTip& other) {
    if (other.cosine >= abreast) alone = std::min(alone, other.away);
  });
  return std::max(alone, least_ring * spacing_);
}

bool EnergyRelease::meets_another(const CrackTip& tip, const Eigen::VectorXd& opening) const {
  bool found = false;
  for_tips_around(
      tip, [&](Index f) { return opening[f] > telling_opening * opening[tip.facet]; },
      [&](const OtherTip& other) { found = found || meets(other.clear / spacing_, other.cosine); });
  return found;
}

/// A facet's corner that no other has, in the rock.
bool EnergyRelease::is_end(const Vector<2>& corner) const {
  const auto has = [&](const CrackFacet<2>& facet) {
    return length(facet[0] - corner) < 1e-6 * spacing_ ||
           length(facet[1] - corner) < 1e-6 * spacing_;
  };
  return std::ranges::count_if(body_.facets(), has) == 1 && reaches(corner, -0.25 * spacing_);
}

/// Of images of the tip and ends of cracks, these where their facet `counts`, those within the
/// largest ring that run at it.
void EnergyRelease::for_tips_around(const CrackTip& tip, const std::function<bool(Index)>& counts,
                                    const std::function<void(const OtherTip&)>& see) const {
  const double within = largest_ring * spacing_;
  const auto look = [&](const Vector<2>& off, const Vector<2>& direction, double clear) {
    const double away = length(off);
    if (away < 1e-6 * spacing_ || away >= within) return;
    if (!are_opposed(dot(direction, tip.direction))) return;
    see({away, clear, dot(off, tip.direction) / away});
  };
  for (std::size_t f = 0; f < body_.facets().size(); ++f) {
    const CrackFacet<2>& facet = body_.facets()[f];
    for (const int end : {0, 1}) {
      const Vector<2> off = facet[end] - tip.place, along = facet[end] - facet[1 - end];
      if (length(off) < within && counts(static_cast<Index>(f)) && is_end(facet[end]))
        look(off, along / length(along), length(off));
    }
  }
  for (int a = 0; a < 2; ++a) {
    Vector<2> image = tip.direction;
    image[a] = -image[a];
    for (const double plane : mirrors_[a]) {
      Vector<2> off{};
      off[a] = 2.0 * (plane - tip.place[a]);
      look(off, image, 0.5 * length(off));
    }
  }
}

/// In the square of that half width, in their order.
std::vector<Index> EnergyRelease::points_around(const Vector<2>& centre, double radius) const {
  const std::vector<double>& x = body_.family().position[0];
  const std::vector<double>& y = body_.family().position[1];
  std::vector<Index> points;
  const auto from =
      std::ranges::upper_bound(by_x_, centre[0] - radius, {}, [&](Index i) { return x[i]; });
  for (auto i = from; i != by_x_.end() && x[*i] < centre[0] + radius; ++i) {
    if (std::abs(y[*i] - centre[1]) < radius) points.push_back(*i);
  }
  std::ranges::sort(points);
  return points;
}

std::vector<Index> EnergyRelease::looks_at(const CrackTip& tip) const {
  const Family<2>& family = body_.family();
  const Cutoff cutoff{tip.place, spacing_, largest_radius(tip)};
  std::vector<Index> unknowns;
  for (const Index i : points_around(cutoff.centre, cutoff.outer)) {
    body_.elastic().append_unknowns(i, unknowns);
  }
  // A facet that is within the ring, behind the tip, or beside one of these.
  const Cutoff beside{tip.place, spacing_, cutoff.outer + 2.0 * spacing_};
  for (std::size_t f = 0; f < body_.jumps().size(); ++f) {
    const CrackFacet<2>& facet = body_.facets()[f];
    if (!beside.reaches(facet[0]) && !beside.reaches(facet[1])) continue;
    for (const auto& [point, coefficient] : body_.jumps()[f].terms) {
      for (int a = 0; a < 2; ++a) unknowns.push_back(a * family.point_count + point);
    }
  }
  std::ranges::sort(unknowns);
  const auto twice = std::ranges::unique(unknowns);
  unknowns.erase(twice.begin(), twice.end());
  return unknowns;
}

bool EnergyRelease::is_straight(const CrackTip& tip, double angle) const {
  const Cutoff ring{tip.place, spacing_, largest_radius(tip)};
  for (std::size_t f = 0; f < body_.jumps().size(); ++f) {
    const CrackFacet<2>& facet = body_.facets()[f];
    if (!ring.reaches(facet[0]) && !ring.reaches(facet[1])) continue;
    if (std::abs(cross(body_.jumps()[f].tangents[0], tip.direction)) > std::sin(angle))
      return false;
  }
  return true;
}

TipJump EnergyRelease::jump(const CrackTip& tip, std::span<const Vector<2>> jumps) const {
  Vector<2> apart{}, ahead{};
  int count = 0;
  for (std::size_t f = 0; f < jumps.size(); ++f) {
    const CrackFacet<2>& facet = body_.facets()[f];
    const Vector<2> back = tip.place - middle<2>(facet);
    const double behind = dot(back, tip.direction), aside = cross(back, tip.direction);
    if (behind < first_jump * spacing_ || behind > last_jump * spacing_) continue;
    if (std::abs(aside) > spacing_) continue;
    const FaceJump<2>& face = body_.jumps()[f];
    const double cosine = dot(face.tangents[0], tip.direction);
    if (is_other_leg(std::abs(cosine))) continue;
    apart += parted(tip.direction, static_cast<Index>(f), jumps[f]);
    ahead += (cosine > 0.0 ? 1.0 : -1.0) * face.tangents[0];
    ++count;
  }
  if (count == 0) return {0.0, 0.0};
  apart = apart / static_cast<double>(count);
  ahead = ahead / length(ahead);
  const double turn_to = std::atan2(cross(tip.direction, ahead), dot(tip.direction, ahead));
  return {cross(ahead, apart), dot(ahead, apart), turn_to};
}

/// From the face on the right to that on the left.
Vector<2> EnergyRelease::parted(const Vector<2>& ahead, Index facet, const Vector<2>& jump) const {
  const FaceJump<2>& face = body_.jumps()[facet];
  const double sign = cross(ahead, face.normal) > 0.0 ? 1.0 : -1.0;
  return sign * (jump[0] * face.normal + jump[1] * face.tangents[0]);
}

double EnergyRelease::opening_across(const Vector<2>& ahead, Index facet,
                                     const Vector<2>& jump) const {
  return cross(ahead, parted(ahead, facet, jump));
}

/// Where facets meet: the mean of theirs, 0 at the tip.
Vector<2> EnergyRelease::jump_at(const Vector<2>& corner, const CrackTip& tip,
                                 std::span<const Vector<2>> jumps) const {
  Vector<2> sum{};
  const auto is_at = [&](const Vector<2>& x) { return length(x - corner) < 1e-6 * spacing_; };
  if (is_at(tip.place)) return sum;
  int count = 0;
  for (std::size_t f = 0; f < jumps.size(); ++f) {
    const CrackFacet<2>& facet = body_.facets()[f];
    if (!is_at(facet[0]) && !is_at(facet[1])) continue;
    ++count;
    sum += jumps[f];
  }
  return sum / count;
}

double EnergyRelease::of_points(const CrackTip& tip, double radius,
                                std::span<const double> unknowns,
                                std::span<const double> pore_stress,
                                const PointInertia<2>& inertia) const {
  const Family<2>& family = body_.family();
  const Cutoff cutoff{tip.place, spacing_, radius};
  const DeformedMaterial<2> deformed = body_.elastic().deform(unknowns);
  const Vector<2>& d = tip.direction;
  double sum = 0.0;
  for (const Index i : points_around(cutoff.centre, cutoff.outer)) {
    const Vector<2> x = vector_at(family.position, i);
    const double q = cutoff.at(x);
    const Vector<2> grad_q = cutoff.gradient(x);
    const Tensor<2, 2> grad_u = deformed.gradient(i);
    if (inertia) sum += dot(inertia(i), grad_u * d) * q;
    Tensor<2, 2> stress = deformed.stress(i, grad_u);
    if (!pore_stress.empty()) {
      add_to_diagonal(stress, -pore_stress[i]);
      sum += family.volume[i] * trace(grad_u) *
             (pore_stress[i] * dot(d, grad_q) + q * rise_along(d, pore_stress, family, i));
    }
    if (grad_q == Vector<2>{}) continue;
    sum +=
        family.volume[i] * dot(grad_u * d, stress * grad_q) - deformed.energy(i) * dot(d, grad_q);
  }
  return sum;
}

/// `load`: what a facet's faces carry along its normal and tangent [Pa].
double EnergyRelease::of_faces(const CrackTip& tip, double radius, std::span<const Vector<2>> jumps,
                               const std::function<Vector<2>(Index)>& load) const {
  const Cutoff cutoff{tip.place, spacing_, radius};
  double sum = 0.0;
  for (std::size_t f = 0; f < jumps.size(); ++f) {
    const CrackFacet<2>& facet = body_.facets()[f];
    const std::array q = {cutoff.at(facet[0]), cutoff.at(facet[1])};
    if (q[0] == 0.0 && q[1] == 0.0) continue;
    const double ahead = dot(body_.jumps()[f].tangents[0], tip.direction);
    const Vector<2> begin = jump_at(facet[0], tip, jumps) - jumps[f];
    const Vector<2> end = jump_at(facet[1], tip, jumps) - jumps[f];
    sum += ahead * dot(load(static_cast<Index>(f)), q[0] * begin - q[1] * end);
  }
  return sum;
}

namespace {

/// The root between 0 and `free` of what hoop stress rises by, K_I sin a + K_II (3 cos a - 1) -
/// along sin a cos a / cos(a / 2).
double held_to_direction(const TipModes& modes, double along, double free) {
  const auto rises = [&](double a) {
    return modes.opening * std::sin(a) + modes.sliding * (3.0 * std::cos(a) - 1.0) -
           along * std::sin(a) * std::cos(a) / std::cos(0.5 * a);
  };
  double none = 0.0;
  for (int n = 0; n < 50; ++n) {
    const double middle = 0.5 * (none + free);
    (rises(middle) * modes.sliding > 0.0 ? none : free) = middle;
  }
  return 0.5 * (none + free);
}

}  // namespace

TipModes modes_of(const TipJump& jump) {
  return {std::max(0.0, jump.opening), mode_ratio * jump.sliding};
}

double kink_angle(const TipModes& modes, double along) {
  if (modes.sliding == 0.0) return 0.0;
  double angle = modes.sliding > 0.0 ? -largest_kink : largest_kink;
  if (modes.opening > 0.0) {
    const double ratio = modes.sliding / modes.opening;
    angle =
        std::clamp(2.0 * std::atan((1.0 - std::sqrt(1.0 + 8.0 * ratio * ratio)) / (4.0 * ratio)),
                   -largest_kink, largest_kink);
  }
  if (along < 0.0) angle = held_to_direction(modes, along, angle);
  return std::abs(angle) < least_kink ? 0.0 : angle;
}

double kink_intensity(const TipModes& modes) {
  const double half = 0.5 * kink_angle(modes), c = std::cos(half);
  return c * c * (c * std::max(0.0, modes.opening) - 3.0 * std::sin(half) * modes.sliding);
}

}  // namespace perifrac
