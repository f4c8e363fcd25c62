#include "modules/fluid/openings/fluid_mouths.hpp"

#include <algorithm>
#include <limits>

#include <fmt/format.h>

#include "core/base/small_vector.hpp"
#include "core/state/compensated_sum.hpp"

namespace perifrac {

namespace {

/// Of what lies at a mouth: the most that leaves in a step.
constexpr double most_part = 0.5;

template <int D>
double distance(const Vector<D>& x, const Vector<D>& y) {
  return norm(x - y);
}

/// The points of the body that are nearest to x, equally near ones together.
template <int D>
std::vector<Index> nearest_points(const Body<D>& body, const Vector<D>& x) {
  double least = std::numeric_limits<double>::infinity();
  for (Index i = 0; i < body.points().size(); ++i) {
    least = std::min(least, distance<D>(body.points().at(i), x));
  }
  std::vector<Index> nearest;
  for (Index i = 0; i < body.points().size(); ++i) {
    if (distance<D>(body.points().at(i), x) <= least * (1.0 + 1e-9)) nearest.push_back(i);
  }
  return nearest;
}

/// Behind all faces of the body and walls of its cut-outs; upon one of them is not within.
template <int D>
bool is_within(const Body<D>& body, const Vector<D>& x) {
  const double rounding = 1e-6 * body.spacing();
  for (const Face& face : body.faces()) {
    if (face.depth(x) <= rounding) return false;
  }
  return std::ranges::none_of(body.cutouts(), [&](Region<D> box) {
    for (int a = 0; a < D; ++a) {
      box.from[a] -= rounding;
      box.to[a] += rounding;
    }
    return box.contains(x);
  });
}

}  // namespace

template <int D>
FluidMouths<D>::FluidMouths(const std::vector<Vector<D>>& places, const Body<D>& body,
                            double horizon)
    : horizon_(horizon), influence_(horizon) {
  for (const Vector<D>& x : places) {
    append(place_, x);
    beside_.push_back(nearest_points<D>(body, x));
  }
  point_set_ = {.name = "mouths", .dimension = D, .count = places.size()};
  for (int a = 0; a < D; ++a) point_set_.position[a] = place_[a];
  for (auto* values : {&pressure_, &stiffness_, &volume_stiffness_, &relaxation_, &taken_, &given_,
                       &given_lost_}) {
    values->assign(places.size(), 0.0);
  }
}

/// Finds the points at a mouth with omega m; returns the sum.
template <int D>
double FluidMouths<D>::find_weights(const FluidPoints<D>& fluid, std::size_t mouth) {
  weights_.clear();
  const Vector<D> x = vector_at(place_, mouth);
  double sum = 0.0;
  for (Index i = 0; i < fluid.count; ++i) {
    const double r = distance<D>(fluid.at(i), x);
    if (r >= horizon_) continue;
    const double weight = influence_(r * r) * fluid.mass[i];
    weights_.emplace_back(i, weight);
    sum += weight;
  }
  return sum;
}

/// Points at a mouth lose omega m / sum(omega m) of a mass each, at their volumes.
template <int D>
std::span<double> FluidMouths<D>::stiffness(const FluidPoints<D>& fluid,
                                            const FluidProperties& properties) {
  for (std::size_t k = 0; k < stiffness_.size(); ++k) {
    const double all = find_weights(fluid, k);
    stiffness_[k] = 0.0;
    for (const auto& [i, weight] : weights_) {
      const double share = weight / all, speed = properties.sound_speed(fluid.density[i]);
      stiffness_[k] += speed * speed * share * share * fluid.density[i] / fluid.mass[i];
    }
  }
  return stiffness_;
}

template <int D>
std::span<double> FluidMouths<D>::pressure(const FluidPoints<D>& fluid,
                                           const FluidProperties& properties) {
  for (std::size_t k = 0; k < pressure_.size(); ++k) {
    const double all = find_weights(fluid, k);
    pressure_[k] = 0.0;
    for (const auto& [i, weight] : weights_) {
      pressure_[k] += weight / all * properties.pressure(fluid.density[i]);
    }
  }
  return pressure_;
}

template <int D>
std::span<double> FluidMouths<D>::volume_stiffness(const FluidPoints<D>& fluid,
                                                   const FluidProperties& properties) {
  double compliance = 0.0;
  for (Index i = 0; i < fluid.count; ++i) {
    const double speed = properties.sound_speed(fluid.density[i]);
    compliance += fluid.mass[i] / (fluid.density[i] * speed * speed);
  }
  std::ranges::fill(volume_stiffness_, compliance > 0.0 ? 1.0 / compliance : 0.0);
  return volume_stiffness_;
}

template <int D>
std::span<double> FluidMouths<D>::relaxation(const FluidProperties& properties) {
  std::ranges::fill(relaxation_, horizon_ / properties.sound_speed());
  return relaxation_;
}

template <int D>
void FluidMouths<D>::begin_window(double length) {
  left_ = length;
}

template <int D>
double FluidMouths<D>::given() const {
  double sum = 0.0;
  for (const double of_mouth : given_) sum += of_mouth;
  for (const double of_mouth : given_lost_) sum += of_mouth;
  return sum;
}

template <int D>
void FluidMouths<D>::give(FluidPoints<D>& fluid, double length, std::vector<double>& impulse) {
  const std::size_t body_points = impulse.size() / D;
  const double part = length < left_ ? length / left_ : 1.0;
  left_ -= length;
  for (std::size_t k = 0; k < given_.size(); ++k) {
    const double due = part * (taken_[k] - given_[k]);
    const double all = find_weights(fluid, k);
    const double amount = std::clamp(due, -most_part * all, most_part * all);
    if (amount == 0.0) continue;
    Vector<D> momentum{};
    for (const auto& [i, weight] : weights_) {
      const double before = fluid.mass[i];
      fluid.mass[i] -= amount * weight / all;
      const double left = before - fluid.mass[i];  // as rounded: what is counted is what is gone
      fluid.density[i] -= left / fluid.volume[i];
      add_compensated(given_[k], given_lost_[k], left);
      momentum += left * vector_at(fluid.velocity, i);
    }
    const double share = 1.0 / static_cast<double>(beside_[k].size());
    for (const Index j : beside_[k]) {
      add_at(impulse, body_points, j, share * momentum);
    }
  }
}

template <int D>
void FluidMouths<D>::visit_state(StateVisitor& visitor) {
  visitor.visit("given_to_cracks", given_);
  visitor.visit("given_to_cracks_lost", given_lost_);
}

template <int D>
std::vector<Vector<D>> read_mouths(const Section& scene, const Body<D>* body) {
  std::vector<Vector<D>> places;
  if (body == nullptr || D != 2 || !scene.has("crack_fluid")) return places;
  for (std::size_t k = 0; k < scene.count("crack_fluid.inlets"); ++k) {
    const std::string path = fmt::format("crack_fluid.inlets[{}]", k);
    if (scene.word(path + ".holds") != "fluid") continue;
    Vector<D> x;
    std::ranges::copy(scene.numbers(path + ".at"), x.begin());
    if (is_within<D>(*body, x)) {
      scene.fail(path + ".at", "lies within the body, where there is no free fluid",
                 "a place on a cut-out's wall or a face, where the crack opens into the fluid");
    }
    places.push_back(x);
  }
  return places;
}

template class FluidMouths<2>;
template class FluidMouths<3>;
template std::vector<Vector<2>> read_mouths<2>(const Section&, const Body<2>*);
template std::vector<Vector<3>> read_mouths<3>(const Section&, const Body<3>*);

}  // namespace perifrac
