#pragma once

#include <optional>
#include <string>
#include <vector>

#include "app/simulation/place_reader.hpp"
#include "app/simulation/simulation.hpp"
#include "core/config/section.hpp"
#include "core/io/history.hpp"

namespace perifrac {

/// The columns of history.csv that come from fields: probes at places, and values without a place
/// (the displacement of a plate). A probe reads its fields at its place (PlaceReader), and has a
/// column that says from how many points of each kind: 1 is a point's own value, 0 is none.
class Probes {
 public:
  /// Reads `output.probes`; the manager must be initialised. Throws InputError for an unknown
  /// field, and for a field of the body at a place outside it; where no field is named, those of
  /// the body are left out there, if others are recorded.
  Probes(const Section& output, const Simulation& simulation, double fluid_spacing);

  const std::vector<HistoryColumn>& columns() const { return columns_; }
  /// Appends the values as they are now, one a column; not a number where there is no point.
  void append_values(std::vector<double>& row);

 private:
  /// A place where the fields of one set of points are read.
  struct Probe {
    PlaceReader reader;
    std::size_t column;    ///< that says from how many points
    bool follows = false;  ///< points and cracks as they are in this row
  };
  /// Of one field: it may be worked out when it is asked for, so that a row asks once.
  struct Column {
    std::size_t column;
    int component;
    std::optional<std::size_t> probe;  ///< none: a field without places
  };
  struct Recorded {
    Field field;
    std::vector<Column> columns;
  };
  void read(const Section& output, const std::string& item, const Simulation& simulation,
            double fluid_spacing);
  void add_columns(const Field& field, std::optional<std::size_t> probe, const std::string& suffix);

  std::vector<Probe> probes_;
  std::vector<Recorded> recorded_;
  std::vector<HistoryColumn> columns_;
};

}  // namespace perifrac
