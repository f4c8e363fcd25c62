#include "app/references/solutions/martin_moyce.hpp"

#include <algorithm>
#include <array>
#include <cmath>

namespace perifrac::martin_moyce {

namespace {

struct Measurement {
  double T;
  double front;
};

constexpr std::array measurements = {
    Measurement{0.00, 1.00}, Measurement{0.41, 1.11}, Measurement{0.84, 1.22},
    Measurement{1.19, 1.44}, Measurement{1.43, 1.67}, Measurement{1.63, 1.89},
    Measurement{1.83, 2.11}, Measurement{1.98, 2.33}, Measurement{2.20, 2.56},
    Measurement{2.32, 2.78}, Measurement{2.51, 3.00}, Measurement{2.65, 3.22},
    Measurement{2.83, 3.44}, Measurement{2.98, 3.67}, Measurement{3.11, 3.89},
    Measurement{3.33, 4.11}};

}  // namespace

double front(double T) {
  const auto later = std::ranges::lower_bound(measurements, T, {}, &Measurement::T);
  if (later == measurements.begin()) return measurements.front().front;
  if (later == measurements.end()) return NAN;
  const auto& [T0, front0] = *(later - 1);
  return front0 + (later->front - front0) * (T - T0) / (later->T - T0);
}

double end() { return measurements.back().T; }

}  // namespace perifrac::martin_moyce
