#pragma once

#include <cstdint>
#include <vector>

#include "core/base/packet.hpp"
#include "core/base/points.hpp"

namespace perifrac {

/// A law that differs from region to region; few laws, one byte a point.
template <class Law>
struct LawByRegion {
  static constexpr int components = Law::components;

  std::vector<Law> laws;
  std::vector<std::uint8_t> law_of_point;

  const Law& at(Index i) const { return laws[law_of_point[i]]; }

  /// Of a packet of points: of all by the first one's law, and of those with another by their own.
  template <std::size_t K>
  std::array<Packet, K> stress(PointPacket points,
                               const std::array<Packet, K>& gradient) const requires
      requires(const Law& law) {
    law.stress(gradient);
  }
  {
    int first = 0;
    while (points.point[first] < 0) ++first;
    const std::uint8_t most = law_of_point[points.point[first]];
    std::array<Packet, K> result = laws[most].stress(gradient);
    for (int l = first + 1; l < packet_size; ++l) {
      const Index i = points.point[l];
      if (i < 0 || law_of_point[i] == most) continue;
      std::array<double, K> own;
      for (std::size_t k = 0; k < K; ++k) own[k] = gradient[k][l];
      own = at(i).stress(own);
      for (std::size_t k = 0; k < K; ++k) result[k][l] = own[k];
    }
    return result;
  }
};

/// The law takes packets of gradients, of D components each: whatever the points, or of given ones.
template <class Law, int D>
concept PacketLaw = requires(const Law& law, PointPacket points,
                             const std::array<Packet, Law::components * D>& gradient) {
  law.stress(gradient);
}
|| requires(const Law& law, PointPacket points,
            const std::array<Packet, Law::components * D>& gradient) {
  law.stress(points, gradient);
};

template <class Law, std::size_t K>
std::array<Packet, K> stress_at(const Law& law, PointPacket points,
                                const std::array<Packet, K>& gradient) {
  if constexpr (requires { law.stress(points, gradient); }) {
    return law.stress(points, gradient);
  } else {
    return law.stress(gradient);
  }
}

/// The law of point i: the law itself where it is the same everywhere, which then costs nothing.
template <class Law>
decltype(auto) law_at(const Law& law, Index i) {
  if constexpr (requires { law.at(i); }) {
    return law.at(i);
  } else {
    return (law);
  }
}

/// The stress at a point, as at a packet of them.
template <class Law, std::size_t K>
std::array<double, K> stress_at(const Law& law, Index i, const std::array<double, K>& gradient) {
  return law_at(law, i).stress(gradient);
}

}  // namespace perifrac
