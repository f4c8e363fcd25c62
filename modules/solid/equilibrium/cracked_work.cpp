#include "modules/solid/equilibrium/cracked_work.hpp"

#include "core/base/eigen_view.hpp"
#include "core/base/small_vector.hpp"

namespace perifrac {

template <int D>
void CrackedWork<D>::start() {
  has_begun_ = 0;
  external_ = spent_ = radiated_ = relief_ = load_ = elastic_ = 0.0;
  displacement_.assign(body_.unknowns().size(), 0.0);
  force_ = displacement_;
}

/// That of the fluid in the cracks is the fluid's, and contact does none.
template <int D>
void CrackedWork<D>::book() {
  if constexpr (D == 2) {
    if (CrackFriction* const friction = body_.friction()) {
      friction->book(body_.body(), body_.faces(), body_.pressure_in_cracks());
    }
  }
  body_.load().is_steady() ? book_steady() : book_changing();
  has_begun_ = 1;
}

template <int D>
void CrackedWork<D>::book_steady() {
  CrackFriction* const friction = body_.friction();
  const auto& faces = body_.faces();
  const auto energies = body_.body().energies(faces.pressure, faces.shear);
  external_ += share() * (energies.load - load_ + energies.relief - relief_);
  // Faces begin to slide once half, and more, has come on.
  if (has_begun_ == 0 && friction != nullptr) external_ += 0.5 * friction->dissipation();
  load_ = energies.load;
  relief_ = energies.relief;
  elastic_ = energies.elastic + (friction != nullptr ? friction->elastic_energy() : 0.0);
}

template <int D>
void CrackedWork<D>::book_changing() {
  const std::span<const double> unknowns = body_.unknowns();
  CrackedBody<D>& cracked = body_.body();
  const auto& faces = body_.faces();
  std::vector<double> force(unknowns.size()), dilatation(body_.load().points().size());
  cracked.elastic().apply(unknowns, {body_.load().added_pore_stress()}, force, dilatation);
  view(force) -= cracked.face_force(faces.pressure, true, faces.shear);
  const auto held = cracked.held(unknowns, faces.pressure, faces.shear);
  if (held.force.size() > 0) view(force) += held.force;
  const double relieved = relief(unknowns, dilatation);
  external_ += 0.5 * (view(force_) + view(force)).dot(view(unknowns) - view(displacement_)) +
               share() * (relieved - relief_);
  relief_ = relieved;
  force_ = force;
  displacement_.assign(unknowns.begin(), unknowns.end());
}

/// Of what bears the stress at rest from outside: on faces, and of pores that swell.
template <int D>
double CrackedWork<D>::relief(std::span<const double> unknowns,
                              std::span<const double> dilatation) const {
  CrackedBody<D>& cracked = body_.body();
  double relief = 0.0;
  for (Index f = 0; f < static_cast<Index>(cracked.jumps().size()); ++f) {
    const Vector<D> stress = cracked.relief(f), jump = cracked.jump(f, unknowns);
    relief += cracked.jumps()[f].area * dot(stress, jump);
  }
  const auto& faces = body_.faces();
  relief += cracked.pressed_energies(faces.pressure).relief +
            cracked.held(unknowns, faces.pressure, faces.shear).relief;
  const std::span<const double> at_rest = body_.load().pore_stress_at_rest();
  for (std::size_t i = 0; i < at_rest.size(); ++i) {
    relief -= at_rest[i] * dilatation[i] * body_.load().points().volume[i];
  }
  return relief;
}

template <int D>
double CrackedWork<D>::elastic_energy() {
  return body_.load().is_steady() ? elastic_ : body_.elastic_energy();
}

template <int D>
double CrackedWork<D>::released_energy() {
  double sum = external_ - elastic_energy();
  if constexpr (D == 2) {
    if (CrackFriction* const friction = body_.friction()) sum -= friction->dissipation();
  }
  const std::span<const double> pore_stress = body_.load().pore_stress();
  if (pore_stress.empty()) return sum;
  const std::span<const double> dilatation = body_.dilatation();
  for (std::size_t i = 0; i < pore_stress.size(); ++i) {
    sum += pore_stress[i] * dilatation[i] * body_.load().points().volume[i];
  }
  return sum;
}

template <int D>
void CrackedWork<D>::visit_state(StateVisitor& visitor) {
  visitor.visit("has_begun", has_begun_);
  visitor.visit("relief_work", relief_);
  if (body_.load().is_steady()) {
    visitor.visit("load_work", load_);
    visitor.visit("elastic_energy", elastic_);
  } else {
    visitor.visit("displacement", displacement_);
    visitor.visit("external_force", force_);
  }
  visitor.visit("external_work", external_);
  visitor.visit("fracture_energy", spent_);
  visitor.visit("radiated_energy", radiated_);
}

template <int D>
std::span<const double> CrackedWork<D>::displacement() const {
  if (body_.load().is_steady()) return {};
  return displacement_;
}

template class CrackedWork<2>;
template class CrackedWork<3>;

}  // namespace perifrac
