#include "modules/solid/equilibrium/moving_tip.hpp"

#include <string>

#include "core/base/eigen_view.hpp"
#include "core/base/require.hpp"
#include "core/state/visit_each.hpp"

namespace perifrac {

namespace {

void visit_modes(StateVisitor& visitor, std::vector<MovingTip>& tips) {
  std::vector<double> all;
  const auto each = [&](const auto& see) {
    for (MovingTip& tip : tips) {
      for (auto& [root_of_j, modes, slid] : tip.even) {
        for (double* value :
             {&root_of_j, &modes.sliding, &modes.opens, &modes.slides, &modes.root_of_j, &slid}) {
          see(*value);
        }
      }
      for (auto* sheared : {&tip.sheared_held, &tip.sheared_cut}) {
        for (double& value : *sheared) see(value);
      }
    }
  };
  each([&](double& value) { all.push_back(value); });
  const std::size_t size = all.size();
  visitor.visit("tip_modes", all);
  require(all.size() == size, "a state in parts that do not fit");
  std::size_t next = 0;
  each([&](double& value) { value = all[next++]; });
}

/// One after the other: how many numbers, and these.
void visit_loads(StateVisitor& visitor, std::vector<MovingTip>& tips) {
  std::vector<double> all;
  for (const MovingTip& tip : tips) {
    all.push_back(static_cast<double>(tip.load.borne.size()));
    all.insert(all.end(), tip.load.borne.begin(), tip.load.borne.end());
    all.insert(all.end(), tip.load.apart.begin(), tip.load.apart.end());
    all.insert(all.end(), tip.load.traction.begin(), tip.load.traction.end());
  }
  visitor.visit("tip_loads", all);
  Eigen::Index next = 0;
  const Eigen::VectorXd values = view(all);
  for (MovingTip& tip : tips) {
    const auto count = static_cast<Eigen::Index>(values[next++]);
    tip.load.borne = values.segment(next, count);
    tip.load.apart = values.segment(next + count, 2);
    tip.load.traction = values.segment(next + count + 2, 2);
    next += count + 4;
  }
}

}  // namespace

void visit_moving_tips(StateVisitor& visitor, std::vector<MovingTip>& tips) {
  const std::vector<MovingTip> before = tips;
  visit_each(
      visitor, "moving_tips", tips,  //
      FieldOfEach("x", [](MovingTip& tip) -> double& { return tip.at.place[0]; }),
      FieldOfEach("y", [](MovingTip& tip) -> double& { return tip.at.place[1]; }),
      FieldOfEach("direction_x", [](MovingTip& tip) -> double& { return tip.at.direction[0]; }),
      FieldOfEach("direction_y", [](MovingTip& tip) -> double& { return tip.at.direction[1]; }),
      FieldOfEach("facet_behind", [](MovingTip& tip) -> Index& { return tip.at.facet; }),
      FieldOfEach("facet_before", [](MovingTip& tip) -> Index& { return tip.at.before; }),
      FieldOfEach("facet", [](MovingTip& tip) -> Index& { return tip.facet; }),
      FieldOfEach("ends", [](MovingTip& tip) -> bool& { return tip.ends; }),
      FieldOfEach("nearest", [](MovingTip& tip) -> Index& { return tip.nearest; }),
      FieldOfEach("part", [](MovingTip& tip) -> double& { return tip.part; }),
      FieldOfEach("per_spacing", [](MovingTip& tip) -> double& { return tip.per_spacing; }),
      FieldOfEach("rate", [](MovingTip& tip) -> double& { return tip.rate; }),
      FieldOfEach("facets", [](MovingTip& tip) -> std::int64_t& { return tip.facets; }),
      FieldOfEach("release", [](MovingTip& tip) -> double& { return tip.release; }),
      FieldOfEach("held", [](MovingTip& tip) -> double& { return tip.held[0]; }),
      FieldOfEach("held_before", [](MovingTip& tip) -> double& { return tip.held[1]; }),
      FieldOfEach("cut", [](MovingTip& tip) -> double& { return tip.cut[0]; }),
      FieldOfEach("cut_before", [](MovingTip& tip) -> double& { return tip.cut[1]; }),
      FieldOfEach("facets_begin",
                  [](MovingTip& tip) -> std::vector<Index>& { return tip.shapes[0].facets; }),
      FieldOfEach("jumps_begin",
                  [](MovingTip& tip) -> std::vector<double>& { return tip.shapes[0].jumps; }),
      FieldOfEach("modes_begin",
                  [](MovingTip& tip) -> std::vector<double>& { return tip.shapes[0].intensities; }),
      FieldOfEach("scale_begin", [](MovingTip& tip) -> double& { return tip.shapes[0].scale; }),
      FieldOfEach("scale_end", [](MovingTip& tip) -> double& { return tip.shapes[1].scale; }),
      FieldOfEach("facets_end",
                  [](MovingTip& tip) -> std::vector<Index>& { return tip.shapes[1].facets; }),
      FieldOfEach("jumps_end",
                  [](MovingTip& tip) -> std::vector<double>& { return tip.shapes[1].jumps; }),
      FieldOfEach("modes_end", [](MovingTip& tip) -> std::vector<double>& {
        return tip.shapes[1].intensities;
      }));
  visit_modes(visitor, tips);
  visit_loads(visitor, tips);
  // What the passes of a window look for outlasts their going back.
  for (std::size_t k = 0; k < tips.size(); ++k) {
    if (k < before.size() && before[k].facet == tips[k].facet) continue;
    tips[k].search.put(tips[k].part);
  }
}

}  // namespace perifrac
