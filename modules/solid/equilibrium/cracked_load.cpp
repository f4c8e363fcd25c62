#include "modules/solid/equilibrium/cracked_load.hpp"

#include "core/base/eigen_view.hpp"

namespace perifrac {

namespace {

/// Forces of a stress on cut families hold the faces of cracks, too, which is no part of what bears
/// on a face of the body that they begin at.
template <int D>
ForceOfStress force_beside_cracks(const BreakableElasticity<D>& elastic,
                                  const CutBody<D>& cracked) {
  return [&](const Eigen::VectorXd& stress) -> Eigen::VectorXd {
    return elastic.force_of_stress(stress) - cracked.force_on_faces(stress);
  };
}

}  // namespace

template <int D>
CrackedLoad<D>::CrackedLoad(std::shared_ptr<const Body<D>> body,
                            std::shared_ptr<BreakableElasticity<D>> elastic,
                            const CutBody<D>& cracked, const SolidBoundary<D>& boundary,
                            const MirrorCondition<D, D>& mirror)
    : body_(std::move(body)),
      elastic_(std::move(elastic)),
      prescribed_(boundary.prescribed(mirror)),
      load_(boundary.loads(mirror, force_beside_cracks<D>(*elastic_, cracked))),
      prescribes_(!prescribed_.is_constant() || prescribed_.at(0.0).any()),
      is_steady_by_itself_(load_.is_constant() && !prescribes_) {}

template <int D>
void CrackedLoad<D>::add_ports(PortTable& ports) {
  const PointSet* const points = &body_->point_set();
  const std::size_t count = body_->points().size();
  ports.in(
      {"pore_stress", "Pa"}, [this, count] { pore_stress_.resize(count); },
      [this, points] {
        return PortView{points, pore_stress_};
      });
  ports.in(
      InterfaceForce::port(D), [this, count] { interface_.connect(D * count); },
      [this, points] {
        return PortView{points, interface_.impulse()};
      });
}

template <int D>
Eigen::VectorXd CrackedLoad<D>::force(double t) {
  Eigen::VectorXd all = load_.at(t);
  std::vector<double> force(all.size()), scratch(body_->points().size());
  if (prescribes_) {
    const Eigen::VectorXd displaced = prescribed_.at(t);
    elastic_->apply(view(displaced), {}, force, scratch);
    all -= view(force);
  }
  if (interface_.is_linked() && !interface_.force().empty()) {
    all.head(interface_.force().size()) += view(interface_.force());
  }
  if (!pore_stress_.empty()) {
    const std::vector<double> rest(all.size(), 0.0);
    elastic_->apply(rest, {added_pore_stress()}, force, scratch);
    all -= view(force);
  }
  return all;
}

template <int D>
std::span<const double> CrackedLoad<D>::added_pore_stress() {
  if (pore_stress_.empty() || at_rest_.empty()) return pore_stress_;
  added_.resize(pore_stress_.size());
  view(added_) = view(pore_stress_) - view(at_rest_);
  return added_;
}

/// Where facets were added at the end of a window, openings are read anew under the last pore
/// stress.
template <int D>
void CrackedLoad<D>::visit_state(StateVisitor& visitor) {
  if (!pore_stress_.empty()) visitor.visit("pore_stress", pore_stress_);
  interface_.visit_state(visitor);
}

template class CrackedLoad<2>;
template class CrackedLoad<3>;

}  // namespace perifrac
