#include "app/references/table_reference.hpp"

#include <algorithm>
#include <charconv>
#include <cmath>
#include <limits>
#include <optional>
#include <sstream>

#include <fmt/format.h>
#include <fmt/ranges.h>

#include "app/references/rock.hpp"
#include "core/base/errors.hpp"
#include "core/base/names.hpp"
#include "core/io/input_file.hpp"

namespace perifrac {

namespace {

/// What a table says of the scene that it is for, `KEY = VALUE` in SI.
struct Condition {
  std::string key;
  std::vector<double> values;  ///< none: the scene does not write the key
};

struct Table {
  std::vector<Condition> conditions;
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

double read_number(const std::string& text, const std::string& place) {
  double value = 0.0;
  const char* const end = text.data() + text.size();
  const auto [rest, error] = std::from_chars(text.data(), end, value);
  if (error != std::errc() || rest != end || !std::isfinite(value)) {
    throw InputError(fmt::format("{}: {}; expected a finite number", place, in_quotes(text)));
  }
  return value;
}

/// `# KEY = 1.2`, `# KEY = 1.2, 3.4` or `# KEY = none`.
Condition read_condition(const std::string& line, const std::string& place) {
  std::istringstream words(line.substr(1));
  Condition condition;
  std::string equals, word;
  if (!(words >> condition.key >> equals) || equals != "=") {
    throw InputError(place + ": no condition; expected `# KEY = VALUE` of the scene, in SI");
  }
  while (words >> word && word != "none") {
    if (word.back() == ',') word.pop_back();
    condition.values.push_back(read_number(word, place));
  }
  return condition;
}

Table read_table(const std::string& path) {
  std::istringstream file(read_input_text(path, "a table with commas"));
  Table table;
  std::string line;
  int number = 1;
  for (; std::getline(file, line) && line.starts_with('#'); ++number) {
    table.conditions.push_back(read_condition(line, fmt::format("{}:{}", path, number)));
  }
  table.names = split(line);
  if (table.names.size() < 2 || table.names.front() != "time [s]") {
    throw InputError(fmt::format(
        "{}:{}: no column of time; expected `time [s],QUANTITY [UNIT],...`", path, number));
  }
  table.columns.resize(table.names.size());
  for (++number; std::getline(file, line); ++number) {
    const std::vector<std::string> parts = split(line);
    if (parts.size() != table.names.size()) {
      throw InputError(fmt::format("{}:{}: {} columns; expected {}", path, number, parts.size(),
                                   table.names.size()));
    }
    for (std::size_t k = 0; k < parts.size(); ++k) {
      const double value = read_number(parts[k], fmt::format("{}:{}", path, number));
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

/// The value of a key in SI; nothing where the scene has none.
std::vector<double> values_of(const Section& scene, const std::string& key,
                              const std::string& path) {
  try {
    if (!scene.has(key)) return {};
  } catch (const std::logic_error&) {
    throw InputError(
        fmt::format("{}: no scene has a key {}; expected one that has", path, in_quotes(key)));
  }
  try {
    return {scene.number(key)};
  } catch (const std::logic_error&) {
    return scene.numbers(key);
  }
}

bool agree(const std::vector<double>& a, const std::vector<double>& b) {
  return std::ranges::equal(
      a, b, [](double x, double y) { return std::abs(x - y) <= 1e-6 * std::abs(y); });
}

/// Why the table is of another case than the scene is.
std::optional<std::string> difference(const Section& scene, const Table& table,
                                      const std::string& path) {
  const auto text = [](const std::vector<double>& values) {
    return values.empty() ? "none" : fmt::format("{:g}", fmt::join(values, ", "));
  };
  if (const auto scatter = scatter_of_rock(scene)) {
    return fmt::format(
        "{} is for rock that is the same everywhere, and the scene has {}: nothing is compared "
        "with it",
        path, *scatter);
  }
  for (const Condition& condition : table.conditions) {
    const std::vector<double> values = values_of(scene, condition.key, path);
    if (agree(values, condition.values)) continue;
    return fmt::format("{} is for {} = {}, and the scene has {}: nothing is compared with it", path,
                       condition.key, text(condition.values), text(values));
  }
  return {};
}

}  // namespace

std::vector<std::string> table_warnings(const Section& scene) {
  if (!scene.has("reference") || scene.word("reference.type") != "table") return {};
  const std::string path = scene.file("reference.file");
  const Table table = read_table(path);
  if (const auto other = difference(scene, table, path)) return {*other};
  const double last = table.columns.front().back();
  if (scene.number("time.end") <= last * (1.0 + 1e-9)) return {};
  return {fmt::format("{} ends at t = {:g} s, before the run does: after it nothing is compared",
                      path, last)};
}

std::unique_ptr<Reference> make_table_reference(const Section& scene,
                                                const Simulation& simulation) {
  const std::string path = scene.file("reference.file");
  const auto table = std::make_shared<const Table>(read_table(path));
  if (difference(scene, *table, path)) return nullptr;
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
      throw InputError(fmt::format("{}: '{}' is not a scalar of this run; expected some of {}",
                                   path, table->names[k], fmt::join(known, ", ")));
    }
  }
  return reference;
}

}  // namespace perifrac
