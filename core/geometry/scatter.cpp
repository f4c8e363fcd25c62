#include "core/geometry/scatter.hpp"

#include <algorithm>

namespace perifrac {

KeyTable scatter_keys(const std::string& path, const std::string& what) {
  return {{.path = path + ".coefficient_of_variation",
           .range = "(0, 3]",
           .meaning = "How widely " + what +
                      " scatters from place to place: its standard deviation over its mean, which "
                      "stays what the scene gives; log-normal."},
          {.path = path + ".correlation_length",
           .unit = "m",
           .range = "(0, inf)",
           .meaning = "Two places so far apart have a correlation of 1/e."},
          {.path = path + ".seed",
           .type = KeyType::integer,
           .range = "[0, inf)",
           .fallback = "1",
           .meaning = "Another number, another rock; the same one at any spacing."}};
}

namespace {

double required(const Section& section, const std::string& path, const std::string& key,
                const std::string& expected) {
  if (section.has(path + "." + key)) return section.number(path + "." + key);
  section.fail(path, "missing key '" + key + "'", expected);
}

}  // namespace

template <int D>
std::optional<Scatter<D>> read_scatter(const Section& section, const std::string& path) {
  if (!section.has(path)) return {};
  const double variation = required(section, path, "coefficient_of_variation", "a number");
  const double length = required(section, path, "correlation_length", "a number in m");
  return Scatter<D>{
      RandomField<D>(length, static_cast<std::uint64_t>(section.integer(path + ".seed"))),
      std::sqrt(std::log1p(variation * variation))};
}

template <int D>
FieldClasses<D>::FieldClasses(const RandomField<D>& field, const Points<D>& points, int count)
    : levels(count), of_point(points.size()) {
#pragma omp parallel for schedule(static)
  for (Index i = 0; i < points.size(); ++i) {
    const double level = std::floor((field.at(points.at(i)) + 4.0) / 8.0 * levels);
    of_point[i] = static_cast<std::uint8_t>(std::clamp(level, 0.0, levels - 1.0));
  }
}

template std::optional<Scatter<2>> read_scatter<2>(const Section&, const std::string&);
template std::optional<Scatter<3>> read_scatter<3>(const Section&, const std::string&);
template struct FieldClasses<2>;
template struct FieldClasses<3>;

}  // namespace perifrac
