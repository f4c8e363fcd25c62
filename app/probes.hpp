#pragma once

#include <vector>

#include "app/simulation.hpp"
#include "core/config/section.hpp"
#include "core/io/history.hpp"

namespace perifrac {

/// The columns of history.csv that come from fields: probes at points, and values without a place
/// (the displacement of a plate).
class Probes {
 public:
  /// Reads `output.probes`; the manager must be initialised. Throws InputError for a place outside
  /// the body or an unknown field.
  Probes(const Section& output, const Simulation& simulation);

  const std::vector<HistoryColumn>& columns() const { return columns_; }
  /// Appends the values as they are now, one a column.
  void append_values(std::vector<double>& row) const;

 private:
  struct Probe {
    Field field;
    std::size_t place;  ///< in the port's values
  };
  void add(const Field& field, Index point, std::size_t count, const std::string& suffix);

  std::vector<Probe> probes_;
  std::vector<HistoryColumn> columns_;
};

}  // namespace perifrac
