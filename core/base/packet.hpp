#pragma once

#include <array>
#include <cstdint>
#include <cstring>
#include <span>
#include <utility>

#include "core/base/points.hpp"

namespace perifrac {

/// How many numbers a packet has.
#if defined(__AVX512F__)
inline constexpr int packet_size = 8;
#elif defined(__AVX__)
inline constexpr int packet_size = 4;
#else
inline constexpr int packet_size = 2;
#endif

/// Numbers to compute with at once. Operators act number by number, and a double beside a packet
/// stands for equal numbers.
using Packet = double __attribute__((vector_size(packet_size * sizeof(double))));

/// What comparing packets gives, -1 where it is true; and whole numbers.
using PacketMask = std::int64_t __attribute__((vector_size(packet_size * sizeof(std::int64_t))));

template <int D>
using PacketVector = std::array<Packet, D>;

/// 0, 1, 2, ...
inline PacketMask lanes() {
  return []<std::int64_t... l>(std::integer_sequence<std::int64_t, l...>) {
    return PacketMask{l...};
  }
  (std::make_integer_sequence<std::int64_t, packet_size>{});
}

/// What was compared holds for every number.
inline bool is_everywhere(const PacketMask& mask) {
  std::int64_t both = -1;
  for (int l = 0; l < packet_size; ++l) both &= mask[l];
  return both != 0;
}

/// values[0], values[1], ...
inline Packet load(const double* values) {
  Packet packet;
  std::memcpy(&packet, values, sizeof packet);
  return packet;
}

/// values[index[0]], values[index[1]], ... One by one: that beats the machine's own gather.
inline Packet gather(const double* values, const Index* index) {
  return [&]<int... l>(std::integer_sequence<int, l...>) { return Packet{values[index[l]]...}; }
  (std::make_integer_sequence<int, packet_size>{});
}

inline Packet gather(std::span<const double> values, const Index* index) {
  return gather(values.data(), index);
}

/// Of every pair of rows that many apart, the parts that lie on the wrong side of the diagonal.
template <int step, int... l>
[[gnu::always_inline]] inline void exchange_parts(std::array<Packet, packet_size>& rows,
                                                  std::integer_sequence<int, l...>) {
#pragma GCC unroll 8
  for (int k = 0; k < packet_size; ++k) {
    if ((k & step) != 0) continue;
    const Packet a = rows[k], b = rows[k + step];
    rows[k] = __builtin_shufflevector(a, b, ((l & step) == 0 ? l : packet_size + l - step)...);
    rows[k + step] =
        __builtin_shufflevector(a, b, ((l & step) == 0 ? l + step : packet_size + l)...);
  }
}

/// Turns rows into columns: number l of packet k becomes number k of packet l. Always inline: rows
/// that go through memory cost more than reading numbers one by one.
template <int step = 1>
[[gnu::always_inline]] inline void transpose(std::array<Packet, packet_size>& rows) {
  exchange_parts<step>(rows, std::make_integer_sequence<int, packet_size>());
  if constexpr (2 * step < packet_size) transpose<2 * step>(rows);
}

/// Points to compute with at once; -1 where there is none, of which nothing is kept.
struct PointPacket {
  const Index* point;
};

/// What points have, one or a packet: where there is none, of some other.
inline double value_at(const double* values, Index i) { return values[i]; }
inline Packet value_at(const double* values, PointPacket at) {
  return [&]<int... l>(std::integer_sequence<int, l...>) {
    return Packet{values[at.point[l] < 0 ? 0 : at.point[l]]...};
  }
  (std::make_integer_sequence<int, packet_size>{});
}

inline void set_value(double* values, Index i, double value) { values[i] = value; }
inline void set_value(double* values, PointPacket at, const Packet& value) {
  for (int l = 0; l < packet_size; ++l) {
    if (at.point[l] >= 0) values[at.point[l]] = value[l];
  }
}

inline void store(double* values, const Packet& packet) {
  std::memcpy(values, &packet, sizeof packet);
}

/// The sum of a packet's numbers.
inline double total(const Packet& packet) {
  std::array<double, packet_size> part;
  std::memcpy(part.data(), &packet, sizeof packet);
  for (int half = packet_size / 2; half >= 1; half /= 2) {
    for (int l = 0; l < half; ++l) part[l] += part[l + half];
  }
  return part[0];
}

/// Of several packets. Unrolled, so that they stay in registers.
template <std::size_t K>
[[gnu::always_inline]] inline std::array<double, K> totals(const std::array<Packet, K>& packets) {
  std::array<double, K> result;
#pragma GCC unroll 64
  for (std::size_t k = 0; k < K; ++k) result[k] = total(packets[k]);
  return result;
}

}  // namespace perifrac
