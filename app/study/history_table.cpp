#include "app/study/history_table.hpp"

#include <algorithm>
#include <fstream>
#include <sstream>

#include "core/base/errors.hpp"

namespace perifrac {

namespace {

std::string without_unit(const std::string& name) {
  const auto unit = name.rfind(" [");
  return unit == std::string::npos ? name : name.substr(0, unit);
}

}  // namespace

HistoryTable::HistoryTable(const std::filesystem::path& file) {
  std::ifstream stream(file);
  std::string line, cell;
  if (!std::getline(stream, line))
    throw InputError(file.string() + ": cannot be read; expected a history");
  std::stringstream header(line);
  while (std::getline(header, cell, ',')) names_.push_back(without_unit(cell));
  columns_.resize(names_.size());
  while (std::getline(stream, line)) {
    std::stringstream row(line);
    for (std::size_t k = 0; std::getline(row, cell, ',') && k < columns_.size(); ++k) {
      columns_[k].push_back(std::strtod(cell.c_str(), nullptr));
    }
  }
}

std::vector<std::string> HistoryTable::names() const {
  return {names_.begin() + std::min<std::ptrdiff_t>(2, names_.size()), names_.end()};
}

bool HistoryTable::has(const std::string& name) const { return place(name) < names_.size(); }

std::size_t HistoryTable::place(const std::string& name) const {
  return static_cast<std::size_t>(std::ranges::find(names_, without_unit(name)) - names_.begin());
}

double HistoryTable::at(const std::string& name, double time) const {
  const std::vector<double>& values = columns_[place(name)];
  const auto after = std::ranges::upper_bound(times(), time);
  if (after == times().end()) return values.back();
  if (after == times().begin()) return values.front();
  const auto i = static_cast<std::size_t>(after - times().begin());
  const double share = (time - times()[i - 1]) / (times()[i] - times()[i - 1]);
  return values[i - 1] + share * (values[i] - values[i - 1]);
}

}  // namespace perifrac
