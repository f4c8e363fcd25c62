#include <algorithm>
#include <functional>

#include "modules/solid/fracture/condensed_body.hpp"

namespace perifrac {

// What CondensedBody does about facets that are cut in part.

template <int D>
void CondensedBody<D>::set_partial(std::span<const PartialCut> cuts) {
  const auto are_held = [&](auto same) {
    bool held = cuts.size() == partial_.count();
    for (std::size_t k = 0; held && k < cuts.size(); ++k) held = same(cuts[k], partial_.at(k));
    return held;
  };
  if (are_held(std::equal_to<>())) return;
  ++partial_version_;
  if (!are_held([](const auto& a, const auto& b) { return a.facet == b.facet; })) {
    return take_partial(cuts);
  }
  std::vector<double> opened;
  for (const PartialCut& cut : cuts) opened.push_back(cut.opened);
  partial_.open(opened);
  hold_partial();
}

/// Of the block as it is.
template <int D>
void CondensedBody<D>::take_partial(std::span<const PartialCut> cuts) {
  for (std::size_t k = 0; k < partial_.count(); ++k) {
    const Index f = partial_.at(k).facet;
    modes_[f] = mode_of(jumps_[f]);
    pressed_[f] = this->pressed_by(f);
  }
  partial_ = {};
  find_compliance();
  if (cuts.empty()) return find_opening();
  std::vector<PartialCuts::Cut> taken;
  for (const PartialCut& cut : cuts) taken.push_back(partial_cut(cut));
  partial_.take(std::move(taken), inverse_->block());
  const auto count = static_cast<Eigen::Index>(modes_.size());
  std::vector<Eigen::MatrixXd> rows(D, Eigen::MatrixXd::Zero(count, partial_.columns().cols()));
  for (int k = 0; k < D; ++k) {
    for (Eigen::Index f = 0; f < count; ++f) {
      for (const auto& [place, c] : modes_[f][k]) {
        rows[k].row(f) += c * partial_.columns().row(place);
      }
    }
  }
  partial_.tell(std::move(rows), this->areas());
  find_cut_loaded();
  hold_partial();
}

template <int D>
PartialCuts::Cut CondensedBody<D>::partial_cut(const PartialCut& cut) const {
  const Index f = cut.facet;
  const auto& change = inverse_->changes()[change_of_[f - seeds_.size()]];
  PartialCuts::Cut taken{cut, jumps_[f].area, pressed_[f], change.places, {}, {}};
  const Mode mode = mode_of(jumps_[f]);
  for (const auto& axis : mode) {
    for (const auto& [place, c] : axis) {
      if (std::ranges::find(taken.places, place) == taken.places.end()) {
        taken.places.push_back(place);
      }
    }
  }
  const auto all = std::ssize(taken.places), changed = std::ssize(change.places);
  taken.less = Eigen::MatrixXd::Zero(all, all);
  taken.less.topLeftCorner(changed, changed) = -change.delta;
  taken.modes = Eigen::MatrixXd::Zero(all, D);
  for (int k = 0; k < D; ++k) {
    for (const auto& [place, c] : mode[k]) {
      taken.modes(std::ranges::find(taken.places, place) - taken.places.begin(), k) += c;
    }
  }
  return taken;
}

template <int D>
void CondensedBody<D>::hold_partial() {
  for (std::size_t k = 0; k < partial_.count(); ++k) {
    const auto [f, opened] = partial_.at(k);
    pressed_[f] = opened * this->pressed_by(f);
    for (int a = 0; a < D; ++a) {
      const Eigen::VectorXd force = partial_.traction_force(k, a, inverse_->block().rows());
      modes_[f][a].clear();
      for (Eigen::Index place = 0; place < force.size(); ++place) {
        if (force[place] == 0.0) continue;
        modes_[f][a].emplace_back(static_cast<int>(place), force[place] / jumps_[f].area);
      }
    }
  }
  compliance_ = compliance(0, 0);
  find_free_opening();
}

template <int D>
Eigen::VectorXd CondensedBody<D>::own_jump(std::size_t k, const Vector<D>& load) const {
  return partial_.own_compliance(k) * Eigen::Map<const Eigen::VectorXd>(load.data(), D);
}

template <int D>
std::vector<CutLoad> CondensedBody<D>::cut_loads(const Eigen::VectorXd& pressure,
                                                 std::span<const double> shear) {
  const auto loads = face_loads(pressure, shear);
  const Eigen::VectorXd block = loaded_ + moved_by(force_of(loads));
  std::vector<CutLoad> cuts;
  for (std::size_t k = 0; k < partial_.count(); ++k) {
    const Vector<D>& load = loads[partial_.at(k).facet];
    cuts.push_back(partial_.load(k, block, Eigen::Map<const Eigen::VectorXd>(load.data(), D)));
  }
  return cuts;
}

template <int D>
std::vector<Vector<D>> CondensedBody<D>::jumps_by(std::span<const Vector<D>> tractions) {
  return jumps_at(moved_by(force_of(tractions)), tractions);
}

template <int D>
typename CrackedBody<D>::Held CondensedBody<D>::held(std::span<const double> unknowns,
                                                     const Eigen::VectorXd& pressure,
                                                     std::span<const double> shear) {
  Held result;
  if (partial_.empty()) return result;
  const std::span<const int> condensed = inverse_->unknowns();
  Eigen::VectorXd free = Eigen::VectorXd::Zero(free_unknowns_.cols()), weight = free;
  for (std::size_t unknown = 0; unknown < free_of_.size(); ++unknown) {
    const auto [column, by] = free_of_[unknown];
    if (column < 0) continue;
    free[column] += by * unknowns[unknown];
    weight[column] += by * by;
  }
  Eigen::VectorXd moved(std::ssize(condensed));
  for (Eigen::Index k = 0; k < moved.size(); ++k) {
    moved[k] = free[condensed[k]] / weight[condensed[k]];
  }
  const Eigen::VectorXd block = inverse_->at_places(moved);
  Eigen::VectorXd force = partial_.force(block);
  result.elastic = partial_.energy(block);
  for (std::size_t k = 0; k < partial_.count(); ++k) {
    const Index f = partial_.at(k).facet;
    const Vector<D> load = this->face_load(f, pressure[f], shear), relief = this->relief(f);
    const double area = jumps_[f].area;
    const Mode whole = mode_of(jumps_[f]);
    const Eigen::VectorXd own = own_jump(k, load);
    for (int a = 0; a < D; ++a) {
      double more = own[a];
      for (const auto& [place, c] : modes_[f][a]) {
        more += c * block[place];
        force[place] -= area * load[a] * c;
      }
      for (const auto& [place, c] : whole[a]) {
        more -= c * block[place];
        force[place] += area * load[a] * c;
      }
      result.relief += area * relief[a] * more;
      result.elastic += 0.5 * area * load[a] * own[a];
    }
  }
  Eigen::VectorXd by_free = Eigen::VectorXd::Zero(free_unknowns_.cols());
  const Eigen::VectorXd by_unknown = inverse_->on_unknowns(force);
  for (Eigen::Index k = 0; k < by_unknown.size(); ++k) {
    by_free[condensed[k]] = by_unknown[k] / weight[condensed[k]];
  }
  result.force = free_unknowns_ * by_free;
  return result;
}

template class CondensedBody<2>;
template class CondensedBody<3>;

}  // namespace perifrac
