#pragma once

#include <memory>

#include <benchmark/benchmark.h>

#include "core/body/body.hpp"

namespace perifrac::bench {

/// A lattice; one whose points lie in memory at random and not row by row; and points that lie a
/// fifth of a spacing aside, along a space-filling curve.
enum class Cloud { lattice, shuffled, jittered };

/// A box of `count` points an axis at the horizon ratio of everyday use: 2.5 in 2D, 3 in 3D.
template <int D>
std::shared_ptr<const Body<D>> box_body(int count, Cloud cloud = Cloud::lattice);

/// Some hundred thousand points.
template <int D>
std::shared_ptr<const Body<D>> large_body(Cloud cloud = Cloud::lattice) {
  return box_body<D>(D == 2 ? 316 : 46, cloud);
}

/// Counts what performance is measured in: millions of bond-updates per second, one a directed
/// family entry and pass over all forces.
template <int D>
void count_bonds(benchmark::State& state, const Family<D>& family);

}  // namespace perifrac::bench
