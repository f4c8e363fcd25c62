#include "app/warnings/fluid_in_rock.hpp"

#include <cmath>

#include "app/warnings/wendland_kernel.hpp"
#include "core/base/small_vector.hpp"

namespace perifrac {

namespace {

constexpr double reach = 2.5;        ///< [spacings]
constexpr double full_enough = 0.9;  ///< of what is there

}  // namespace

template <int D>
FluidInRock fluid_in_rock(const Body<D>& body, std::span<const double> displacement,
                          const Positions<D>& fluid) {
  const Points<D>& rock = body.points();
  std::array<std::vector<double>, D> now = rock.position;
  for (std::size_t k = 0; k < displacement.size(); ++k) {
    now[k / rock.volume.size()][k % rock.volume.size()] += displacement[k];
  }
  const double horizon = reach * body.spacing();
  CellGrid<D> grid;
  grid.build(positions_of(now), horizon);
  Neighbours near;
  grid.find(fluid, horizon, near);
  FluidInRock found;
  for (Index i = 0; i < near.target_count(); ++i) {
    double filled = 0.0;
    for (Index k = near.offset[i]; k < near.offset[i + 1]; ++k) {
      const Index j = near.other[k];
      Vector<D> off;
      for (int a = 0; a < D; ++a) off[a] = fluid[a][i] - now[a][j];
      filled += rock.volume[j] * wendland_kernel<D>(std::sqrt(squared_norm(off)), horizon);
    }
    if (filled < full_enough) continue;
    if (found.count == 0) found.one = i;
    ++found.count;
  }
  return found;
}

template FluidInRock fluid_in_rock<2>(const Body<2>&, std::span<const double>, const Positions<2>&);
template FluidInRock fluid_in_rock<3>(const Body<3>&, std::span<const double>, const Positions<3>&);

}  // namespace perifrac
