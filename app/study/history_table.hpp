#pragma once

#include <filesystem>
#include <string>
#include <vector>

namespace perifrac {

/// A history.csv, read.
class HistoryTable {
 public:
  /// Throws InputError where the file cannot be read.
  explicit HistoryTable(const std::filesystem::path& file);

  const std::vector<double>& times() const { return columns_.front(); }  ///< [s]
  std::vector<std::string> names() const;  ///< of the columns behind time and step, without units
  bool has(const std::string& name) const;
  /// Between rows on a straight line; `time` must lie within the table.
  double at(const std::string& name, double time) const;

 private:
  std::size_t place(const std::string& name) const;

  std::vector<std::string> names_;
  std::vector<std::vector<double>> columns_;
};

}  // namespace perifrac
