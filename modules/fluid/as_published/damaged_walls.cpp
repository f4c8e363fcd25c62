#include "modules/fluid/as_published/damaged_walls.hpp"

#include <algorithm>

#include "core/base/small_vector.hpp"

namespace perifrac {

template <int D>
void add_inner_points(const Body<D>& body, bool slips, WallCloud<D>& cloud) {
  std::vector<bool> there(body.points().size(), false);
  for (Index w = cloud.rigid_count; w < cloud.size(); ++w) there[cloud.owner[w]] = true;
  for (Index i = 0; i < body.points().size(); ++i) {
    if (!there[i]) cloud.add(body.points().at(i), {}, 0.0, body.points().volume[i], slips, i);
  }
}

template <int D>
bool DamagedWalls<D>::apply(std::span<const double> damage, WallCloud<D>& cloud) {
  if (std::ranges::equal(damage, damage_)) return false;
  damage_.assign(damage.begin(), damage.end());
  for (Index w = cloud.rigid_count; w < cloud.size(); ++w) {
    const double lost = damage[cloud.owner[w]];
    const bool is_intact = lost == 0.0;
    cloud.volume[w] = (1.0 - lost) * intact_.volume[w];
    cloud.depth[w] = is_intact ? intact_.depth[w] : 0.0;
    set_at(cloud.normal, w, is_intact ? vector_at(intact_.normal, w) : Vector<D>{});
  }
  return true;
}

template void add_inner_points<2>(const Body<2>&, bool, WallCloud<2>&);
template void add_inner_points<3>(const Body<3>&, bool, WallCloud<3>&);
template class DamagedWalls<2>;
template class DamagedWalls<3>;

}  // namespace perifrac
