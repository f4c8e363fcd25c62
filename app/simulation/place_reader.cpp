#include "app/simulation/place_reader.hpp"

#include <algorithm>
#include <cmath>
#include <set>

#include "core/base/small_vector.hpp"
#include "core/bonds/crack_cut.hpp"

namespace perifrac {

namespace {

constexpr double reach_in_spacings = 2.0;
constexpr double tie = 1e-6;  // of a distance: points equally near

template <int D>
Vector<D> vector_of(const std::vector<double>& place) {
  Vector<D> x;
  std::ranges::copy(place, x.begin());
  return x;
}

/// The body around a place, of which only what is near is kept.
template <int D>
class Surroundings {
 public:
  Surroundings(std::shared_ptr<const Body<D>> body, const Vector<D>& place)
      : body_(std::move(body)), place_(place) {
    const double reach = reach_in_spacings * body_->spacing();
    std::vector<bool> in_layer(body_->points().size(), false);
    for (std::size_t f = 0; f < body_->faces().size(); ++f) {
      for (const Index i : body_->layer(static_cast<int>(f))) in_layer[i] = true;
    }
    for (Index i = 0; i < body_->points().size(); ++i) {
      if (!in_layer[i] && distance(i) < reach && is_open(i)) near_.push_back(i);
    }
    if (near_.empty()) near_ = {body_->nearest_point(place_)};
    keep_own_region();
    std::ranges::stable_sort(near_, {}, [&](Index i) { return distance(i); });
  }

  /// Those near that no crack parts from the place.
  std::vector<Index> visible() const {
    std::vector<Index> seen = near_;
    for (const CrackFacet<D>& facet : body_->bond_state().facets()) {
      std::erase_if(seen, [&](Index i) { return is_cut<D>(facet, place_, position(i)); });
    }
    if (seen.empty()) return {near_.front()};
    remove_broken_off(seen);
    std::ranges::sort(seen);
    return seen;
  }

 private:
  Vector<D> position(Index i) const { return body_->points().at(i); }
  double distance(Index i) const { return norm(position(i) - place_); }
  bool is_open(Index i) const { return !body_->are_parted_by_cutout(place_, position(i)); }
  std::vector<bool> regions_of(const Vector<D>& x) const {
    std::vector<bool> in;
    for (const Region<D>& region : body_->regions()) in.push_back(region.contains(x));
    return in;
  }
  /// Fields have kinks and jumps where regions meet.
  void keep_own_region() {
    const std::vector<bool> own = regions_of(place_);
    const auto is_other = [&](Index i) { return regions_of(position(i)) != own; };
    if (!std::ranges::all_of(near_, is_other)) std::erase_if(near_, is_other);
  }
  /// Cracks without facets: who has no bond left to the nearest is beyond one. Of points equally
  /// near the first decides.
  void remove_broken_off(std::vector<Index>& seen) const {
    std::set<Index> nearest = {seen.front()};
    const std::set<Index> from_first = broken_off(nearest);
    for (const Index i : seen) {
      const bool is_tied = distance(i) <= distance(seen.front()) * (1.0 + tie);
      if (is_tied && !from_first.contains(i)) nearest.insert(i);
    }
    const std::set<Index> gone = broken_off(nearest);
    std::erase_if(seen, [&](Index i) { return gone.contains(i); });
  }
  std::set<Index> broken_off(const std::set<Index>& points) const {
    std::set<Index> gone;
    for (const BrokenBond& bond : body_->bond_state().broken()) {
      if (bond.facet != no_facet) continue;
      if (points.contains(bond.i)) gone.insert(bond.j);
      if (points.contains(bond.j)) gone.insert(bond.i);
    }
    return gone;
  }

  std::shared_ptr<const Body<D>> body_;
  Vector<D> place_;
  std::vector<Index> near_;  ///< the nearest first
};

/// They have a side in common.
template <int D>
bool meet(const CrackFacet<D>& one, const CrackFacet<D>& other) {
  const double rounding = 1e-6 * std::pow(area<D>(one), 1.0 / (D - 1));
  const auto same = [&](const FacetSide<D>& a, const FacetSide<D>& b) {
    double off = 0.0;
    for (int k = 0; k < D - 1; ++k) {
      for (int axis = 0; axis < D; ++axis) off = std::max(off, std::abs(a[k][axis] - b[k][axis]));
    }
    return off < rounding;
  };
  const auto of_other = sides<D>(other);
  return std::ranges::any_of(sides<D>(one), [&](const FacetSide<D>& side) {
    return std::ranges::any_of(of_other,
                               [&](const FacetSide<D>& another) { return same(side, another); });
  });
}

/// Facets within reach that hang together with the nearest through facets within reach.
template <int D>
std::vector<Index> connected_facets(std::span<const CrackFacet<D>> facets, const PointSet& points,
                                    const std::vector<double>& place, double reach) {
  std::vector<Index> near;
  for (std::size_t f = 0; f < points.count; ++f) {
    if (square_distance(points, f, place) < reach * reach) near.push_back(static_cast<Index>(f));
  }
  std::ranges::stable_sort(near, {}, [&](Index f) { return square_distance(points, f, place); });
  std::vector<Index> connected(near.begin(), near.begin() + (near.empty() ? 0 : 1));
  for (std::size_t n = 0; n < connected.size(); ++n) {
    for (const Index g : near) {
      if (std::ranges::count(connected, g) > 0) continue;
      if (meet<D>(facets[connected[n]], facets[g])) connected.push_back(g);
    }
  }
  return connected;
}

std::vector<Index> points_near(const PointSet& points, const std::vector<double>& place,
                               double reach) {
  std::vector<Index> near;
  for (std::size_t i = 0; i < points.count; ++i) {
    if (square_distance(points, i, place) < reach * reach) near.push_back(static_cast<Index>(i));
  }
  return near;
}

}  // namespace

PlaceReader::PlaceReader(const Simulation& simulation, const PointSet& points,
                         std::vector<double> place, double fluid_spacing)
    : place_(std::move(place)) {
  const auto settle = [&]<int D>(const std::shared_ptr<const Body<D>>& body) {
    const bool on_body = body && points.name == body->point_set().name;
    const bool on_cracks = body && points.name == body->bond_state().facet_points().name;
    const double spacing = on_body || on_cracks ? body->spacing() : fluid_spacing;
    reach_ = reach_in_spacings * spacing;
    farthest_ = on_body ? INFINITY : spacing;  // the scene's reader knows what lies in the body
    if (on_body) {
      choose_ = [around = Surroundings<D>(body, vector_of<D>(place_))](const PointSet&) {
        return around.visible();
      };
    } else if (on_cracks) {
      choose_ = [body, at = place_, reach = reach_](const PointSet& set) {
        return connected_facets<D>(body->bond_state().facets(), set, at, reach);
      };
    } else {
      choose_ = [at = place_, reach = reach_](const PointSet& set) {
        return points_near(set, at, reach);
      };
    }
    if (on_body || on_cracks) version_ = [body] { return body->bond_state().version(); };
  };
  std::visit(settle, simulation.body);
}

PlaceWeights PlaceReader::weights_now(const PointSet& points) const {
  const std::vector<Index> chosen = choose_(points);
  const auto is_near = [&](Index i) {
    return square_distance(points, i, place_) <= farthest_ * farthest_ * (1.0 + tie);
  };
  if (std::ranges::none_of(chosen, is_near)) return {};
  PlaceWeights weights = linear_fit(points, chosen, place_, reach_);
  if (weights.points.empty()) return {{chosen.front()}, {1.0}};  // a lone one of the body
  return weights;
}

void PlaceReader::follow(const PointSet& points) {
  const std::uint64_t now = version_ ? version_() : 0;
  if (has_read_ && version_ && now == known_) return;
  weights_ = weights_now(points);
  known_ = now;
  has_read_ = true;
}

double PlaceReader::value(const Field& field, int component) const {
  return value(field.module->port(field.id), component);
}

double PlaceReader::value(const PortView& view, int component) const {
  const std::size_t count = view.points->count;
  return weights_.value(view.value.subspan(component * count, count));
}

double fluid_spacing(const Section& scene) {
  if (!scene.has("fluid")) return 0.0;
  const double body = scene.has("body.spacing") ? scene.number("body.spacing") : 0.0;
  return scene.has("fluid.spacing") ? scene.number("fluid.spacing") : body;
}

}  // namespace perifrac
