#include "core/geometry/cloud_file.hpp"

#include <charconv>
#include <cmath>
#include <fstream>
#include <sstream>
#include <string_view>

#include <fmt/format.h>

#include "core/base/errors.hpp"
#include "core/base/names.hpp"
#include "core/io/input_file.hpp"

namespace perifrac {

namespace {

/// The lines of a file, counted for messages.
class Lines {
 public:
  explicit Lines(const std::string& path) : path_(path), file_(path) {
    InputFile(path, "a file of points");
  }

  /// Next line that is not empty, without the end that other systems write.
  bool next(std::string& line) {
    while (std::getline(file_, line)) {
      ++number_;
      if (!line.empty() && line.back() == '\r') line.pop_back();
      if (line.find_first_not_of(" \t") != std::string::npos) return true;
    }
    return false;
  }

  int number() const { return number_; }

  [[noreturn]] void refuse(const std::string& problem, const std::string& expected) const {
    throw InputError(fmt::format("{}:{}: {}; expected {}", path_, number_, problem, expected));
  }

  double read_number(std::string_view text) const {
    while (!text.empty() && (text.front() == ' ' || text.front() == '\t')) text.remove_prefix(1);
    while (!text.empty() && (text.back() == ' ' || text.back() == '\t')) text.remove_suffix(1);
    double value = 0.0;
    const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value);
    if (error != std::errc() || end != text.data() + text.size() || !std::isfinite(value)) {
      refuse(in_quotes(text), "a finite number");
    }
    return value;
  }

 private:
  std::string path_;
  std::ifstream file_;
  int number_ = 0;
};

std::vector<std::string> split(const std::string& line) {
  std::vector<std::string> columns;
  std::stringstream stream(line);
  for (std::string column; std::getline(stream, column, ',');) columns.push_back(column);
  if (line.ends_with(',')) columns.emplace_back();
  return columns;
}

template <int D>
CloudFile<D> read_columns(Lines& lines) {
  const std::string header = D == 2 ? "x,y" : "x,y,z";
  CloudFile<D> cloud;
  std::string line;
  lines.next(line);
  std::erase(line, ' ');
  cloud.has_volumes = line == header + ",volume";
  if (line != header && !cloud.has_volumes) {
    lines.refuse("the first line is " + in_quotes(line),
                 fmt::format("'{0}' or '{0},volume'", header));
  }
  const std::size_t count = D + (cloud.has_volumes ? 1 : 0);
  while (lines.next(line)) {
    const std::vector<std::string> columns = split(line);
    if (columns.size() != count) {
      lines.refuse(fmt::format("{} columns", columns.size()), fmt::format("{}", count));
    }
    Vector<D> x;
    for (int a = 0; a < D; ++a) x[a] = lines.read_number(columns[a]);
    const double volume = cloud.has_volumes ? lines.read_number(columns[D]) : 0.0;
    if (cloud.has_volumes && volume <= 0.0) {
      lines.refuse(fmt::format("the volume {:g}", volume), "a volume above 0");
    }
    cloud.points.add(x, volume);
    cloud.line.push_back(lines.number());
  }
  return cloud;
}

/// Legacy VTK: title, ASCII, kind of data set, and somewhere `POINTS n type` with 3 n numbers.
template <int D>
CloudFile<D> read_vtk(Lines& lines) {
  const std::string expected = "a legacy VTK file, ASCII, with POINTS";
  CloudFile<D> cloud;
  std::string line;
  bool ascii = false;
  long wanted = -1;
  while (wanted < 0) {
    if (!lines.next(line)) lines.refuse("no POINTS", expected);
    if (line.starts_with("BINARY")) lines.refuse("the file is binary", expected);
    ascii = ascii || line.starts_with("ASCII");
    if (!line.starts_with("POINTS ")) continue;
    const auto [end, error] = std::from_chars(line.data() + 7, line.data() + line.size(), wanted);
    if (error != std::errc() || wanted < 0 || !ascii) lines.refuse("'" + line + "'", expected);
  }
  std::vector<double> x;
  while (static_cast<long>(cloud.line.size()) < wanted) {
    if (!lines.next(line)) {
      lines.refuse(fmt::format("the file ends after {} points", cloud.line.size()),
                   fmt::format("{}", wanted));
    }
    std::stringstream words(line);
    for (std::string word; words >> word;) {
      x.push_back(lines.read_number(word));
      if (x.size() % 3 != 0) continue;
      Vector<D> place;
      std::copy(x.end() - 3, x.end() - 3 + D, place.begin());
      cloud.points.add(place, 0.0);
      cloud.line.push_back(lines.number());
    }
  }
  return cloud;
}

}  // namespace

template <int D>
CloudFile<D> read_cloud(const std::string& path) {
  Lines lines(path);
  CloudFile<D> cloud = path.ends_with(".vtk") ? read_vtk<D>(lines) : read_columns<D>(lines);
  if (cloud.line.empty()) lines.refuse("no points", "at least one");
  return cloud;
}

template CloudFile<2> read_cloud<2>(const std::string&);
template CloudFile<3> read_cloud<3>(const std::string&);

}  // namespace perifrac
