#pragma once

#include <vector>

#include "app/simulation.hpp"
#include "core/config/section.hpp"
#include "core/io/history.hpp"

namespace perifrac {

/// The columns of history.csv that come from fields: probes at places, and values without a place
/// (the displacement of a plate). A probe reads the nearest point: of the body the one that was
/// nearest at the start, of points that move the one that is nearest now.
class Probes {
 public:
  /// Reads `output.probes`; the manager must be initialised. Throws InputError for an unknown
  /// field, and for a field of the body at a place outside it; where no field is named, those of
  /// the body are left out there, if others are recorded.
  Probes(const Section& output, const Simulation& simulation);

  const std::vector<HistoryColumn>& columns() const { return columns_; }
  /// Appends the values as they are now, one a column; not a number where there is no point.
  void append_values(std::vector<double>& row) const;

 private:
  struct Probe {
    Field field;
    std::vector<double> place;  ///< [m]; empty: `point` never changes
    std::size_t point = 0;
  };
  void read(const Section& output, const std::string& item, const Simulation& simulation);
  void add(Probe probe, const std::string& suffix);

  std::vector<Probe> probes_;
  std::vector<HistoryColumn> columns_;
};

}  // namespace perifrac
