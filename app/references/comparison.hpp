#pragma once

#include <functional>
#include <initializer_list>
#include <string>
#include <vector>

#include "app/references/reference.hpp"
#include "app/simulation/simulation.hpp"
#include "core/config/section.hpp"

namespace perifrac {

/// The scene writes this key. Unlike Section::has, also of a key that its types do not have.
bool writes(const Section& scene, std::string_view path);

/// Refuses the scene unless the key at `path` is one of `words`. `problem` names what was solved.
void require_word(const Section& scene, const std::string& problem, const std::string& path,
                  std::initializer_list<std::string_view> words);

/// Refuses the scene where it leaves this section out.
void require_section(const Section& scene, const std::string& problem, const std::string& section);

/// Refuses the scene where it has any of these keys.
void require_absent(const Section& scene, const std::string& problem,
                    std::initializer_list<std::string_view> paths);

/// Whether a bonded layer carries the conditions of this face.
bool is_layer(const Section& scene, const std::string& face);

/// How far [m] the plane that a condition on this face acts in lies outside the box: half a spacing
/// where a bonded layer carries it, 0 where the face is mirrored.
double outside(const Section& scene, const std::string& face);

/// Points of the nominal box: those of bonded layers are left out.
std::vector<Index> points_inside(const Section& scene, const PointSet& points);

/// Points in a row along `axis`, in order: those less than half a spacing off the line through the
/// point nearest to `origin`.
std::vector<Index> points_along(const Section& scene, const PointSet& points, int axis,
                                const std::vector<double>& origin);

/// The place on the line of `row` with the coordinate `x` along `axis`.
std::vector<double> place_on(const std::vector<Index>& row, const PointSet& points, int axis,
                             double x);

/// One component of a field of the body at a place, as probes read it.
Reference::Computed value_at(const Simulation& simulation, const Field& field,
                             const std::vector<double>& place, int component = 0);

/// Exact values by point and time.
using ExactField = std::function<double(Index point, double t)>;

/// Of a place that many points share, as on a lattice, a series is summed once a time.
std::function<double(double place, double t)> once_each(
    std::function<double(double place, double t)> exact);

/// The largest |computed - exact| / scale over `points`.
Reference::OfTime largest_error(const Field& field, int component, std::vector<Index> points,
                                double scale, ExactField exact);

/// A scalar field at the points of `row` along `axis`; `exact` takes the coordinate and time.
Reference::Profile profile_along(const std::vector<Index>& row, const PointSet& points, int axis,
                                 const std::string& quantity, const std::string& unit,
                                 const Field& field,
                                 std::function<double(double x, double t)> exact);

}  // namespace perifrac
