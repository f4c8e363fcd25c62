#include "modules/fluid/openings/inlets.hpp"

#include <algorithm>

#include <fmt/format.h>

#include "core/base/small_vector.hpp"
#include "modules/fluid/openings/named_box.hpp"

namespace perifrac {

template <int D>
Inlets<D>::Inlets(std::vector<Inlet<D>> inlets, const FluidProperties& fluid, double point_mass,
                  Period<D> period)
    : inlets_(std::move(inlets)),
      density_(fluid.density),
      point_mass_(point_mass),
      period_(std::move(period)) {}

template <int D>
void Inlets<D>::find_inside(const FluidPoints<D>& points, const Region<D>& box) {
  inside_.clear();
  for (Index i = 0; i < points.count; ++i) {
    if (box.contains(period_.wrapped(points.at(i)))) inside_.push_back(i);
  }
}

template <int D>
void Inlets<D>::feed(FluidPoints<D>& points, double t, double length,
                     const std::function<bool(Index)>& is_beside_wall) {
  for (Inlet<D>& inlet : inlets_) {
    double amount = inlet.rate * inlet.schedule.factor(t) * length;
    find_inside(points, inlet.box);
    if (inside_.empty()) {
      inlet.waiting += amount;
      continue;
    }
    const double late = std::min(inlet.waiting, amount);
    inlet.waiting -= late;
    amount += late;
    if (!std::ranges::all_of(inside_, is_beside_wall)) std::erase_if(inside_, is_beside_wall);
    double volume = 0.0;
    for (const Index i : inside_) volume += points.volume[i];
    for (const Index i : inside_) {
      const double before = points.mass[i];
      points.mass[i] += amount * points.volume[i] / volume;
      points.density[i] += amount / volume;
      injected_.add(points.mass[i] - before);  // as rounded: what is counted is what is there
    }
  }
}

template <int D>
Index Inlets<D>::make_points(FluidPoints<D>& points,
                             const std::function<bool(const Vector<D>&)>& is_free) {
  Index made = 0;
  for (Inlet<D>& inlet : inlets_) {
    if (inlet.waiting < point_mass_) continue;
    find_inside(points, inlet.box);
    if (!inside_.empty()) continue;
    const Vector<D> centre = 0.5 * (inlet.box.from + inlet.box.to);
    if (!is_free(centre)) continue;
    points.add(centre, {}, density_, point_mass_);
    inlet.waiting -= point_mass_;
    injected_.add(point_mass_);
    ++made;
  }
  return made;
}

template <int D>
void Inlets<D>::visit_state(StateVisitor& visitor) {
  injected_.visit_state(visitor, "injected_mass");
  for (Inlet<D>& inlet : inlets_) {
    visitor.enter(inlet.box.name);
    visitor.visit("waiting_mass", inlet.waiting);
    visitor.leave();
  }
}

KeyTable inlet_keys() {
  KeyTable keys = named_box_keys("inlets", "a box where mass comes in");
  keys.push_back({.path = "inlets[].rate",
                  .unit = "kg/(m s)|kg/s",
                  .range = "(0, inf)",
                  .required = true,
                  .meaning = "Mass per time, times the schedule. Points in the box grow and split, "
                             "those within a horizon of a wall only where there are no others; "
                             "where there are none, one is made at its centre."});
  const KeyTable schedule = schedule_keys("inlets[].");
  keys.insert(keys.end(), schedule.begin(), schedule.end());
  return keys;
}

template <int D>
std::vector<Inlet<D>> read_inlets(const Section& section, double spacing) {
  std::vector<Inlet<D>> inlets;
  for (std::size_t k = 0; k < section.count("inlets"); ++k) {
    const std::string path = fmt::format("inlets[{}]", k);
    Inlet<D> inlet{.box = read_named_box<D>(section, path),
                   .rate = section.number(path + ".rate"),
                   .schedule = read_schedule(section, path)};
    for (int a = 0; a < D; ++a) {
      const double width = inlet.box.to[a] - inlet.box.from[a];
      if (width >= spacing * (1.0 - 1e-9)) continue;
      section.fail(path + ".to",
                   fmt::format("the box is {:g} m wide along axis {}: fluid would flow past it "
                               "without a point inside",
                               width, "xyz"[a]),
                   fmt::format("at least the fluid's spacing, {:g} m", spacing));
    }
    for (const double t : inlet.schedule.break_points()) {
      if (inlet.schedule.factor(t) >= 0.0) continue;
      section.fail(path + ".schedule", fmt::format("the factor at {:g} s is negative", t),
                   "factors from 0 on: an inlet takes nothing out; outlets do");
    }
    inlets.push_back(std::move(inlet));
  }
  return inlets;
}

template class Inlets<2>;
template class Inlets<3>;
template std::vector<Inlet<2>> read_inlets<2>(const Section&, double);
template std::vector<Inlet<3>> read_inlets<3>(const Section&, double);

}  // namespace perifrac
