#pragma once

#include <memory>

#include <benchmark/benchmark.h>

#include "core/body/body.hpp"

namespace perifrac::bench {

/// Points in memory along the space-filling curve, or at random.
enum class Order { curve, shuffled };

/// A box lattice of `count` points an axis at the horizon ratio of everyday use: 2.5 in 2D, 3 in
/// 3D.
template <int D>
std::shared_ptr<const Body<D>> lattice_body(int count, Order order = Order::curve);

/// Counts what performance is measured in: millions of bond-updates per second, one a directed
/// family entry and pass over all forces.
template <int D>
void count_bonds(benchmark::State& state, const Family<D>& family);

}  // namespace perifrac::bench
