#pragma once

#include <cstdint>

namespace perifrac {

/// The n-th number of the splitmix64 sequence of a seed (Steele, Lea and Flood 2014).
inline std::uint64_t random_bits(std::uint64_t seed, std::uint64_t n) {
  std::uint64_t z = seed + (n + 1) * 0x9e3779b97f4a7c15u;
  z = (z ^ (z >> 30)) * 0xbf58476d1ce4e5b9u;
  z = (z ^ (z >> 27)) * 0x94d049bb133111ebu;
  return z ^ (z >> 31);
}

/// Of 64 random bits: uniform in (-1, 1), ends excluded.
inline double uniform(std::uint64_t bits) {
  return (static_cast<double>(bits >> 11) + 0.5) * 0x1p-52 - 1.0;
}

}  // namespace perifrac
