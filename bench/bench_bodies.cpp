#include "bench/bench_bodies.hpp"

#include <algorithm>
#include <numeric>
#include <random>

#include "core/geometry/jitter.hpp"
#include "core/geometry/lattice.hpp"
#include "core/geometry/space_filling_curve.hpp"

namespace perifrac::bench {

template <int D>
std::shared_ptr<const Body<D>> box_body(int count, Cloud cloud) {
  std::array<int, D> counts;
  counts.fill(count);
  Points<D> points = box_lattice<D>(counts, 1.0);
  if (cloud == Cloud::shuffled) {
    std::vector<Index> place(points.volume.size());
    std::iota(place.begin(), place.end(), 0);
    std::ranges::shuffle(place, std::mt19937(1));
    const Points<D> sorted = points;
    for (Index i = 0; i < points.size(); ++i) {
      for (int a = 0; a < D; ++a) points.position[a][place[i]] = sorted.position[a][i];
    }
  }
  if (cloud == Cloud::jittered) {
    sort_along_curve(points, 1.0);
    jitter_points(points, 0.2, 1);
  }
  return std::make_shared<const Body<D>>(std::move(points), std::vector<Face>{}, 1.0,
                                         D == 2 ? 2.5 : 3.0, InfluenceFunction::gaussian);
}

template <int D>
void count_bonds(benchmark::State& state, const Family<D>& family) {
  state.counters["million_bonds_per_s"] =
      benchmark::Counter(1e-6 * static_cast<double>(family.steps.total()),
                         benchmark::Counter::kIsIterationInvariantRate);
  state.counters["bonds_per_point"] =
      static_cast<double>(family.steps.total()) / family.point_count;
  state.counters["bytes_per_point"] = static_cast<double>(family.bytes()) / family.point_count;
}

template std::shared_ptr<const Body<2>> box_body<2>(int, Cloud);
template std::shared_ptr<const Body<3>> box_body<3>(int, Cloud);
template void count_bonds<2>(benchmark::State&, const Family<2>&);
template void count_bonds<3>(benchmark::State&, const Family<3>&);

}  // namespace perifrac::bench
