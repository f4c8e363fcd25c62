#include "modules/solid/motion/massless_plates.hpp"

#include <Eigen/Dense>

namespace perifrac {

void MasslessPlates::place(std::span<const double> load, std::span<const double> pore_stress,
                           std::size_t points, const Apply& apply, std::vector<double>& unknowns) {
  if (plates_.empty()) return;
  if (!rows_are_known_) find_rows(unknowns.size(), points, apply);
  Eigen::VectorXd missing(plates_.size());
  for (std::size_t p = 0; p < plates_.size(); ++p) {
    missing[p] = load.empty() ? 0.0 : load[plates_[p].unknown];
    for (const auto& [k, stiffness] : plates_[p].stiffness) missing[p] -= stiffness * unknowns[k];
    if (pore_stress.empty()) continue;
    for (const auto& [i, volume] : plates_[p].dilatation) missing[p] += volume * pore_stress[i];
  }
  const Eigen::VectorXd place = compliance_ * missing;
  for (std::size_t p = 0; p < plates_.size(); ++p) unknowns[plates_[p].unknown] = place[p];
}

/// The stiffness is symmetric: a plate's row is what it does to the others when it moves alone.
void MasslessPlates::find_rows(std::size_t unknowns, std::size_t points, const Apply& apply) {
  const auto entries = [](const std::vector<double>& values) {
    Row result;
    for (std::size_t k = 0; k < values.size(); ++k) {
      if (values[k] != 0.0) result.emplace_back(static_cast<Index>(k), values[k]);
    }
    return result;
  };
  const auto count = static_cast<Eigen::Index>(plates_.size());
  Eigen::MatrixXd own(count, count);
  std::vector<double> unit(unknowns, 0.0), row(unknowns), pore_volume(points);
  for (Eigen::Index p = 0; p < count; ++p) {
    unit[plates_[p].unknown] = 1.0;
    apply(unit, row, pore_volume);
    unit[plates_[p].unknown] = 0.0;
    for (Eigen::Index q = 0; q < count; ++q) {
      own(q, p) = row[plates_[q].unknown];
      row[plates_[q].unknown] = 0.0;
    }
    plates_[p].stiffness = entries(row);
    plates_[p].dilatation = entries(pore_volume);
  }
  compliance_ = own.inverse();
  rows_are_known_ = true;
}

}  // namespace perifrac
