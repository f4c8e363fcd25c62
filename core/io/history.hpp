#pragma once

#include <cstdint>
#include <filesystem>
#include <optional>
#include <span>
#include <string>
#include <vector>

namespace perifrac {

struct HistoryColumn {
  std::string name;
  std::string unit;
};

/// A table that grows by one row an output: CSV, first columns `time [s],step`, units in the
/// header, numbers in the shortest form that reads back to the same bits. After each append the
/// row is with the operating system, so that killing the process does not lose it.
class History {
 public:
  /// Starts a new table; with a `restart_step`, keeps the rows up to that step of the table that is
  /// there, byte for byte. Throws OutputError, and InputError where the table that is there has
  /// other columns.
  History(std::filesystem::path file, const std::vector<HistoryColumn>& columns,
          std::optional<std::int64_t> restart_step = {});

  /// `time` in [s], `values` one a column, in its unit. Throws OutputError.
  void append(double time, std::int64_t step, std::span<const double> values);

  /// Throws OutputError where the table does not hold all that was written.
  void check_kept() const;

 private:
  std::filesystem::path file_;
  std::uintmax_t size_ = 0;  ///< [bytes]
};

}  // namespace perifrac
