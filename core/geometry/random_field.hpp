#pragma once

#include <cstdint>
#include <vector>

#include "core/base/points.hpp"

namespace perifrac {

/// A random function of place: standard normal values whose correlation over a distance r is
/// exp(-(r / correlation_length)^2). A sum of many waves (Shinozuka & Deodatis 1991), so that it is
/// the same field whatever points it is asked at, with a gradient everywhere.
template <int D>
class RandomField {
 public:
  /// `correlation_length` [m].
  RandomField(double correlation_length, std::uint64_t seed);

  double at(const Vector<D>& x) const;

 private:
  struct Wave {
    Vector<D> number;  ///< [1/m]
    double phase;
  };
  std::vector<Wave> waves_;
};

}  // namespace perifrac
