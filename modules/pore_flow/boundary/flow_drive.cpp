#include "modules/pore_flow/boundary/flow_drive.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

namespace perifrac {

FlowDrive::FlowDrive(ScheduledVector face_pressures, ScheduledVector sources)
    : face_pressures_(std::move(face_pressures)),
      sources_(std::move(sources)),
      source_rate_(sources_.size()) {
  for (const ScheduledVector* scheduled : {&face_pressures_, &sources_}) {
    const std::vector<double> times = scheduled->break_points();
    break_points_.insert(break_points_.end(), times.begin(), times.end());
  }
  std::ranges::sort(break_points_);
  find_sources(0.0);
  for (const double t : pressures_change() ? break_points_ : std::vector{0.0}) {
    for (const double p : face_pressures_.at(t)) {
      largest_pressure_ = std::max(largest_pressure_, std::abs(p));
    }
  }
}

}  // namespace perifrac
