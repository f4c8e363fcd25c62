#include "core/geometry/random_field.hpp"

#include <cmath>
#include <numbers>

#include "core/base/random_bits.hpp"

namespace perifrac {

namespace {

/// Values of so many waves are normal to within a percent of their distribution.
constexpr int wave_count = 400;

}  // namespace

template <int D>
RandomField<D>::RandomField(double correlation_length, std::uint64_t seed) {
  std::uint64_t drawn = 0;
  const auto positive = [&] { return 0.5 * (uniform(random_bits(seed, drawn++)) + 1.0); };
  // The spectrum of such a correlation is normal, of this deviation along every axis.
  const double deviation = std::numbers::sqrt2 / correlation_length;
  for (int w = 0; w < wave_count; ++w) {
    Wave wave;
    for (double& number : wave.number) {
      const double radius = std::sqrt(-2.0 * std::log(positive()));  // Box & Muller 1958
      number = deviation * radius * std::cos(2.0 * std::numbers::pi * positive());
    }
    wave.phase = 2.0 * std::numbers::pi * positive();
    waves_.push_back(wave);
  }
}

template <int D>
double RandomField<D>::at(const Vector<D>& x) const {
  double sum = 0.0;
  for (const Wave& wave : waves_) {
    double angle = wave.phase;
    for (int a = 0; a < D; ++a) angle += wave.number[a] * x[a];
    sum += std::cos(angle);
  }
  return std::sqrt(2.0 / wave_count) * sum;
}

template class RandomField<2>;
template class RandomField<3>;

}  // namespace perifrac
