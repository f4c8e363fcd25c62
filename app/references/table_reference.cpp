#include "app/references/table_reference.hpp"

#include <algorithm>
#include <charconv>
#include <cmath>
#include <fstream>
#include <limits>
#include <sstream>

#include <fmt/format.h>
#include <fmt/ranges.h>

#include "core/errors.hpp"

namespace perifrac {

namespace {

struct Table {
  std::vector<std::string> names;
  std::vector<std::vector<double>> columns;

  /// Column k at time t.
  double at(std::size_t k, double t) const {
    const std::vector<double>& times = columns.front();
    const auto after = std::ranges::upper_bound(times, t);
    if (after == times.begin() || t > times.back()) return std::numeric_limits<double>::quiet_NaN();
    if (after == times.end()) return columns[k].back();
    const auto i = static_cast<std::size_t>(after - times.begin());
    const double share = (t - times[i - 1]) / (times[i] - times[i - 1]);
    return columns[k][i - 1] + share * (columns[k][i] - columns[k][i - 1]);
  }
};

std::vector<std::string> split(const std::string& line) {
  std::vector<std::string> parts;
  std::stringstream stream(line);
  for (std::string part; std::getline(stream, part, ',');) parts.push_back(part);
  return parts;
}

Table read_table(const std::string& path) {
  std::ifstream file(path);
  if (!file) throw InputError(path + ": cannot be read; expected a table with commas");
  Table table;
  std::string line;
  std::getline(file, line);
  table.names = split(line);
  if (table.names.size() < 2 || table.names.front() != "time [s]") {
    throw InputError(path + ":1: no column of time; expected `time [s],QUANTITY [UNIT],...`");
  }
  table.columns.resize(table.names.size());
  for (int number = 2; std::getline(file, line); ++number) {
    const std::vector<std::string> parts = split(line);
    if (parts.size() != table.names.size()) {
      throw InputError(fmt::format("{}:{}: {} columns; expected {}", path, number, parts.size(),
                                   table.names.size()));
    }
    for (std::size_t k = 0; k < parts.size(); ++k) {
      double value = 0.0;
      const char* const end = parts[k].data() + parts[k].size();
      const auto [rest, error] = std::from_chars(parts[k].data(), end, value);
      if (error != std::errc() || rest != end || !std::isfinite(value)) {
        throw InputError(
            fmt::format("{}:{}: '{}'; expected a finite number", path, number, parts[k]));
      }
      if (k == 0 && !table.columns[0].empty() && value <= table.columns[0].back()) {
        throw InputError(fmt::format("{}:{}: time does not grow; expected later than {:g} s", path,
                                     number, table.columns[0].back()));
      }
      table.columns[k].push_back(value);
    }
  }
  if (table.columns.front().empty()) throw InputError(path + ": no rows; expected one or more");
  return table;
}

}  // namespace

std::unique_ptr<Reference> make_table_reference(const Section& scene,
                                                const Simulation& simulation) {
  const std::string path = scene.file("reference.file");
  const auto table = std::make_shared<const Table>(read_table(path));
  auto reference = std::make_unique<Reference>("table", scene.text("reference.file"), 0.0);
  for (std::size_t k = 1; k < table->names.size(); ++k) {
    std::vector<std::string> known;
    bool found = false;
    for (const Field& field : fields_of(*simulation.manager)) {
      if (field.port.components != 1 || field.points().dimension != 0) continue;
      const std::string name = fmt::format("{} [{}]", field.port.name, field.port.unit);
      known.push_back(name);
      if (name != table->names[k]) continue;
      found = true;
      const auto computed = [field] { return field.values()[0]; };
      const auto exact = [table, k](double t) { return table->at(k, t); };
      reference->add(Reference::Error{field.port.name + "_error", [=](double t) {
                                        return std::abs(computed() / exact(t) - 1.0);
                                      }});
      reference->add(
          Reference::History{field.port.name + " at the crack", field.port.unit, computed, exact});
    }
    if (!found) {
      throw InputError(fmt::format("{}:1: '{}' is not a scalar of this run; expected some of {}",
                                   path, table->names[k], fmt::join(known, ", ")));
    }
  }
  return reference;
}

}  // namespace perifrac
