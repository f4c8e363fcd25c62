#include "modules/fluid/points/fluid_domain.hpp"

#include <algorithm>

#include <fmt/format.h>

#include "core/base/errors.hpp"

namespace perifrac {

namespace {

/// Of the domain where a scene names none, in longest edges of what there is at the start.
constexpr double margin = 5.0;

}  // namespace

template <int D>
Index FluidDomain<D>::remove(FluidPoints<D>& points, double t) {
  const auto is_outside = [&](Index i) { return !box_.contains(points.at(i)); };
  Index first = 0;
  while (first < points.count && !is_outside(first)) ++first;
  if (first == points.count) return 0;
  return points.remove_if([&](Index i) {
    if (!is_outside(i)) return false;
    if (++left_ > most_lost_) {
      throw NumericalError("fluid_position", describe_point(points.id[i], points.at(i)), t,
                           fmt::format("the box leaks: fluid left its domain ({} lost, {} allowed)",
                                       left_, most_lost_));
    }
    removed_.add(points.mass[i]);
    return true;
  });
}

template <int D>
void FluidDomain<D>::visit_state(StateVisitor& visitor) {
  if (!may_lose()) return;
  visitor.visit("points_left", left_);
  removed_.visit_state(visitor, "lost_mass");
}

KeyTable fluid_domain_keys() {
  return {
      {.path = "domain.from",
       .type = KeyType::vector,
       .unit = "m",
       .meaning = "Low corner of the box that fluid stays in; where left out that of all there is "
                  "at the start, farther out by five times its longest edge."},
      {.path = "domain.to",
       .type = KeyType::vector,
       .unit = "m",
       .meaning = "Its high corner; likewise."},
      {.path = "domain.most_lost",
       .type = KeyType::integer,
       .range = "[0, inf)",
       .fallback = "0",
       .meaning = "Points that may leave it, and are removed; one more ends the run."},
  };
}

template <int D>
FluidDomain<D> read_fluid_domain(const Section& section, const Region<D>& all,
                                 const Period<D>& period) {
  Region<D> box = all;
  double edge = 0.0;
  for (int a = 0; a < D; ++a) edge = std::max(edge, all.to[a] - all.from[a]);
  for (int a = 0; a < D; ++a) {
    box.from[a] -= margin * edge;
    box.to[a] += margin * edge;
  }
  if (section.has("domain.from"))
    std::ranges::copy(section.numbers("domain.from"), box.from.begin());
  if (section.has("domain.to")) std::ranges::copy(section.numbers("domain.to"), box.to.begin());
  for (int a = 0; a < D; ++a) {
    if (!(box.from[a] < box.to[a])) {
      section.fail(
          "domain",
          fmt::format("from {:g} m to {:g} m along axis {}", box.from[a], box.to[a], "xyz"[a]),
          "a box that holds the fluid");
    }
    if (!period.ends[a]) continue;
    box.from[a] = -std::numeric_limits<double>::infinity();
    box.to[a] = std::numeric_limits<double>::infinity();
  }
  return FluidDomain<D>(std::move(box), section.integer("domain.most_lost"));
}

template class FluidDomain<2>;
template class FluidDomain<3>;
template FluidDomain<2> read_fluid_domain<2>(const Section&, const Region<2>&, const Period<2>&);
template FluidDomain<3> read_fluid_domain<3>(const Section&, const Region<3>&, const Period<3>&);

}  // namespace perifrac
