#include "docs/example_module/compaction.hpp"

#include <limits>

namespace perifrac {

namespace {

const PointSet whole_body{.name = "solid"};

}  // namespace

Compaction::Compaction(std::shared_ptr<const Body<2>> body, double stiffness, double overburden)
    : body_(std::move(body)), stiffness_(stiffness), overburden_(overburden) {
  const PointSet* const points = &body_->point_set();
  ports_.in(
      {"pore_stress", "Pa"}, [] {},  // it has room from the start
      [this, points] {
        return PortView{points, pore_stress_};
      });
  ports_.out({.name = "dilatation", .unit = "1", .negligible = negligible_strain}, [this, points] {
    return PortView{points, dilatation_, {}, slope_};
  });
  ports_.total(total_port("compaction_energy", "J", PortRole::energy_stored, 2), whole_body,
               [this] { return energy(); });
  ports_.total(total_port("overburden_work", "J", PortRole::energy_gained, 2), whole_body,
               [this] { return work_; });
}

double Compaction::energy() const {
  double sum = 0.0;
  for (std::size_t i = 0; i < dilatation_.size(); ++i) {
    sum += 0.5 * stiffness_ * dilatation_[i] * dilatation_[i] * body_->points().volume[i];
  }
  return sum;
}

void Compaction::initialize(double) {
  const std::size_t count = body_->points().volume.size();
  pore_stress_.assign(count, 0.0);
  dilatation_.assign(count, 0.0);
  slope_.assign(count, 1.0 / stiffness_);
  load_ = work_ = 0.0;
}

double Compaction::stable_time_step() const { return std::numeric_limits<double>::infinity(); }

double Compaction::advance(const TimeWindow& window) {
  double thickening = 0.0;  // change of the body's volume
  for (std::size_t i = 0; i < dilatation_.size(); ++i) {
    const double before = dilatation_[i];
    dilatation_[i] = (pore_stress_[i] - overburden_) / stiffness_;
    thickening += (dilatation_[i] - before) * body_->points().volume[i];
  }
  // A load that comes on at once does the work of one that grows in proportion.
  work_ -= 0.5 * (load_ + overburden_) * thickening;
  load_ = overburden_;
  return window.end;
}

void Compaction::visit_state(StateVisitor& visitor) {
  visitor.visit("dilatation", dilatation_);
  visitor.visit("load", load_);
  visitor.visit("work", work_);
}

void Compaction::on_restored(double) {}  // nothing is derived from the state and kept

ModuleType compaction_type() {
  return {.section = "solid",
          .name = "compaction",
          .meaning = "Rock that thins and thickens point by point under a constant overburden. 2D.",
          .keys = {{.path = "stiffness",
                    .unit = "Pa",
                    .range = "(0, inf)",
                    .required = true,
                    .meaning = "Uniaxial stiffness of the drained rock, lambda + 2 mu."},
                   {.path = "overburden",
                    .unit = "Pa",
                    .required = true,
                    .meaning = "Stress that presses on the layer from the start on."}},
          .make = [](const Section& section, const AnyBody& any) -> std::unique_ptr<PhysicsModule> {
            const auto* body = std::get_if<std::shared_ptr<const Body<2>>>(&any);
            if (!body) section.fail("type", "compaction is written for 2D", "dimension: 2");
            return std::make_unique<Compaction>(*body, section.number("stiffness"),
                                                section.number("overburden"));
          }};
}

}  // namespace perifrac
