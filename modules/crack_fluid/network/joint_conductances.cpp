#include "modules/crack_fluid/network/joint_conductances.hpp"

namespace perifrac {

void JointConductances::find(std::span<const CrackGraph::Branch> joint,
                             std::span<const double> aperture, const CrackGraph& graph,
                             double viscosity) {
  conductance.resize(joint.size());
  growth.resize(joint.size());
  partner.resize(joint.size());
  sum = 0.0;
  for (std::size_t a = 0; a < joint.size(); ++a) {
    double widest = 0.0;
    for (std::size_t b = 0; b < joint.size(); ++b) {
      const Index other = joint[b].facet;
      if (b == a || aperture[other] <= widest) continue;
      widest = aperture[other];
      partner[a] = other;
    }
    const double w = 0.5 * (aperture[joint[a].facet] + widest);
    // From the middle to the side is half the area over the side's width.
    const double width = joint[a].width;
    const double way = 0.5 * graph.area(joint[a].facet) / width;
    conductance[a] = width * w * w * w / (12.0 * viscosity * way);
    growth[a] = 1.5 * conductance[a] / w;
    sum += conductance[a];
  }
}

}  // namespace perifrac
