#include "modules/crack_fluid/crack_outlets.hpp"

#include <algorithm>
#include <limits>
#include <map>

#include <fmt/format.h>
#include <fmt/ranges.h>

#include "core/base/small_vector.hpp"
#include "core/io/log.hpp"

namespace perifrac {

namespace {

/// So near a face no bond lies ahead of a tip: the outermost points are half a spacing inside it
/// [spacings].
constexpr double at_face = 0.55;

constexpr int no_face = -1;

/// From a face to an inlet, up to which what flows between is known no better than by facets: with
/// 2 in place of 1 between them, a third as much leaked off beyond the inlet [spacings].
constexpr double few = 5.0;

template <int D>
Vector<D> middle_of(const FacetSide<D>& side) {
  return 0.5 * (side.front() + side.back());
}

}  // namespace

template <int D>
CrackOutlets<D>::CrackOutlets(std::shared_ptr<const Body<D>> body, std::vector<BehindFace> behind)
    : body_(std::move(body)), behind_(std::move(behind)) {}

template <int D>
void CrackOutlets<D>::start() {
  seeds_ = body_->bond_state().facets().size();
  told_.clear();
}

/// The nearest of those that all of the side lies at or beyond.
template <int D>
int CrackOutlets<D>::face_at(const FacetSide<D>& side) const {
  int nearest = no_face;
  double least = at_face * body_->spacing();
  for (int f = 0; f < std::ssize(body_->faces()); ++f) {
    const Face& face = body_->faces()[f];
    if (!body_->layer(f).empty()) continue;
    const double farthest = std::max(face.depth(side.front()), face.depth(side.back()));
    if (farthest > least) continue;
    least = farthest;
    nearest = f;
  }
  return nearest;
}

template <int D>
void CrackOutlets<D>::match(const CrackGraph& graph) {
  outlets_.clear();
  const auto facets = body_->bond_state().facets();
  if (facets.size() == seeds_) return;
  std::map<FacetSide<D>, int> facets_at;
  for (const CrackFacet<D>& facet : facets) {
    for (const auto& side : sides<D>(facet)) ++facets_at[side];
  }
  std::set<std::pair<Index, int>> given;  // cracks that meet a face from the start
  for (std::size_t f = 0; f < facets.size(); ++f) {
    for (const auto& side : sides<D>(facets[f])) {
      const int face = facets_at[side] == 1 ? face_at(side) : no_face;
      if (face == no_face) continue;
      const std::pair crack{graph.crack(static_cast<Index>(f)), face};
      if (f < seeds_) {
        given.insert(crack);
      } else if (D == 2 || !given.contains(crack)) {
        outlets_.push_back({static_cast<Index>(f), face, middle_of<D>(side)});
      }
    }
  }
}

template <int D>
void CrackOutlets<D>::tell(double t, std::span<const CrackInlet> inlets) {
  for (const auto& [facet, face, at] : outlets_) {
    if (!told_.insert({face, D == 2 ? facet : 0}).second) continue;
    const BehindFace& behind = behind_[face];
    std::string what = fmt::format("opens there, and drains to {:.6g} Pa",
                                   behind.pressure * behind.schedule.factor(t));
    if (behind.kind == BehindFace::Kind::held) what = "stops there and stays closed: it is held";
    if (behind.kind == BehindFace::Kind::free_fluid) {
      what = "stays closed there: what free fluid beside it does is not followed";
    }
    log_info(fmt::format("at t = {:.6g} s a crack has grown to the face '{}' at ({:.6g}) m; it {}",
                         t, body_->faces()[face].name, fmt::join(at, ", "), what));
    if (behind.kind == BehindFace::Kind::open) tell_of_near(at, inlets);
  }
}

template <int D>
void CrackOutlets<D>::tell_of_near(const Vector<D>& at, std::span<const CrackInlet> inlets) const {
  for (const CrackInlet& inlet : inlets) {
    Vector<D> way;
    for (int a = 0; a < D; ++a) way[a] = at[a] - inlet.at[a];
    const double spacings = norm(way) / body_->spacing();
    if (spacings > few) continue;
    log_warning(
        fmt::format("inlet '{}' lies {:.2g} spacings from there: what of it flows out depends on "
                    "body.spacing; bring points closer together, or pump farther from the face",
                    inlet.name, spacings));
  }
}

template <int D>
void CrackOutlets<D>::append_to(std::vector<FacetInflow>& inflows, const TimeWindow& step,
                                double vapour_pressure) const {
  if (!(step.length() > 0.0)) return;
  constexpr double infinity = std::numeric_limits<double>::infinity();
  for (const Outlet& outlet : outlets_) {
    const BehindFace& behind = behind_[outlet.face];
    if (behind.kind != BehindFace::Kind::open) continue;
    if (std::ranges::count(inflows, outlet.facet, &FacetInflow::facet) > 0) continue;
    const double pressure = behind.pressure * behind.schedule.factor(step.end);
    inflows.push_back({.facet = outlet.facet,
                       .least = -infinity,
                       .most = behind.gives ? infinity : 0.0,
                       .target = std::max(pressure, vapour_pressure)});
  }
}

template <int D>
std::vector<BehindFace> read_behind_faces(const Section& scene, const Body<D>& body) {
  std::vector<BehindFace> faces;
  for (const Face& face : body.faces()) {
    BehindFace& behind = faces.emplace_back();
    const auto has = [&](const std::string& section) {
      return scene.has(section + ".boundary." + face.name + ".type");
    };
    const auto take_pressure = [&](const std::string& section) {
      const std::string path = section + ".boundary." + face.name;
      if (scene.word(path + ".type") != "pressure") return;
      behind.pressure = scene.number(path + ".pressure");
      behind.schedule = read_schedule(scene, path);
      behind.gives = true;
    };
    if (has("solid")) {
      const std::string type = scene.word("solid.boundary." + face.name + ".type");
      if (type == "roller" || type == "fixed" || type == "rigid_plate") {
        behind.kind = BehindFace::Kind::held;
      }
      take_pressure("solid");
    }
    if (has("pore_flow")) take_pressure("pore_flow");
    if (behind.kind == BehindFace::Kind::open && scene.has("fluid")) {
      behind.kind = BehindFace::Kind::free_fluid;
    }
  }
  return faces;
}

template class CrackOutlets<2>;
template class CrackOutlets<3>;
template std::vector<BehindFace> read_behind_faces<2>(const Section&, const Body<2>&);
template std::vector<BehindFace> read_behind_faces<3>(const Section&, const Body<3>&);

}  // namespace perifrac
