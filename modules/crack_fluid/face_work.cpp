#include "modules/crack_fluid/face_work.hpp"

#include "core/state/visit_each.hpp"

namespace perifrac {

void FaceWork::add_new(const CrackFlow& before) {
  for (Index f = static_cast<Index>(facets_.size()); f < before.graph().facet_count(); ++f) {
    const double pressure = before.face_pressure()[f];
    const bool follows = !before.is_full(f) && before.is_beside_full(f);
    facets_.push_back({follows ? 0.0 : before.opening()[f], pressure, follows});
  }
}

bool FaceWork::knows_all_of(const CrackFlow& now) const {
  return static_cast<Index>(facets_.size()) == now.graph().facet_count();
}

double FaceWork::book(const CrackFlow& now, Index f) {
  Facet& facet = facets_[f];
  const double opening = now.opening()[f], pressure = now.face_pressure()[f];
  if (facet.fluid_follows) {
    if (!now.is_full(f)) return 0.0;
    facet.pressure = pressure;
  }
  const double mean = 0.5 * (facet.pressure + pressure);
  const double work = now.graph().area(f) * mean * (opening - facet.opening);
  facet = {opening, pressure, false};
  return work;
}

void FaceWork::visit_state(StateVisitor& visitor) {
  visit_each(
      visitor, "face_work", facets_,
      FieldOfEach("opening", [](Facet& facet) -> double& { return facet.opening; }),
      FieldOfEach("pressure", [](Facet& facet) -> double& { return facet.pressure; }),
      FieldOfEach("fluid_follows", [](Facet& facet) -> bool& { return facet.fluid_follows; }));
}

}  // namespace perifrac
