#pragma once

#include <cmath>
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "core/base/law_by_region.hpp"
#include "core/config/key.hpp"
#include "core/config/section.hpp"
#include "core/geometry/random_field.hpp"

namespace perifrac {

/// A rock constant that scatters about what the scene gives: times a log-normal factor of mean 1
/// that varies from place to place.
template <int D>
struct Scatter {
  RandomField<D> field;
  double deviation;  ///< of the factor's logarithm

  double factor_at(double field_value) const {
    return std::exp(deviation * field_value - 0.5 * deviation * deviation);
  }
  double factor(const Vector<D>& x) const { return factor_at(field.at(x)); }
};

/// The keys of a scatter of `what`, under `path`.
KeyTable scatter_keys(const std::string& path, const std::string& what);

/// Nothing where the section has none; throws InputError.
template <int D>
std::optional<Scatter<D>> read_scatter(const Section& section, const std::string& path);

/// Values of a field in `levels` classes of equal width within four deviations, by point.
template <int D>
struct FieldClasses {
  FieldClasses(const RandomField<D>& field, const Points<D>& points, int levels);

  double value(int level) const { return 8.0 * (level + 0.5) / levels - 4.0; }

  int levels;
  std::vector<std::uint8_t> of_point;
};

/// Splits every law into as many as its scatter has classes: a law and a byte a point remain all
/// there is. `scaled(law, factor)` gives the law of a rock that is so much stiffer, or more
/// permeable.
template <int D, class Law, class Scaled>
LawByRegion<Law> scattered(const LawByRegion<Law>& law, const Scatter<D>& scatter,
                           const Points<D>& points, Scaled&& scaled) {
  const int regions = static_cast<int>(law.laws.size());
  const FieldClasses<D> classes(scatter.field, points, std::min(64, 256 / regions));
  LawByRegion<Law> all;
  for (const Law& own : law.laws) {
    for (int level = 0; level < classes.levels; ++level) {
      all.laws.push_back(scaled(own, scatter.factor_at(classes.value(level))));
    }
  }
  for (Index i = 0; i < points.size(); ++i) {
    all.law_of_point.push_back(
        static_cast<std::uint8_t>(law.law_of_point[i] * classes.levels + classes.of_point[i]));
  }
  return all;
}

}  // namespace perifrac
