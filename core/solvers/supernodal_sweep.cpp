#include "core/solvers/supernodal_sweep.hpp"

#include <algorithm>
#include <cstdint>
#include <ranges>

#include <omp.h>

namespace perifrac {
namespace {

/// A branch has at most one part in this many of the factor's values.
constexpr int parts = 16;
/// Below this many values, waking a thread costs more than its share.
constexpr std::int64_t values_worth_threads = 200'000;

/// Where the rows of each supernode lie in those of the one that it leads up to, as in every factor
/// whose supernodes are in postorder; sums of a branch for rows beyond it have their place then.
bool are_nested(const Supernodes& factor, std::span<const int> parent) {
  for (int s = 0; s < factor.count(); ++s) {
    if (parent[s] < 0) continue;
    if (parent[s] <= s) return false;
    const auto beyond = std::ranges::subrange(
        std::ranges::lower_bound(factor.below(s), factor.columns[parent[s] + 1]),
        factor.below(s).end());
    if (!std::ranges::includes(factor.below(parent[s]), beyond)) return false;
  }
  return true;
}

/// By supernode, the one that it leads up to; -1 of a root.
std::vector<int> parents(const Supernodes& factor) {
  const std::vector<int> supernode_of = factor.supernode_of();
  std::vector<int> result(factor.count(), -1);
  for (int s = 0; s < factor.count(); ++s)
    if (!factor.below(s).empty()) result[s] = supernode_of[factor.below(s).front()];
  return result;
}

}  // namespace

SupernodalSweep::SupernodalSweep(const Supernodes& factor) : factor_(factor) {
  find_branches();
  int next = 0;
  for (const Branch& branch : branches_) {
    for (; next < branch.first; ++next) trunk_.push_back(next);
    next = branch.root + 1;
  }
  for (; next < factor_.count(); ++next) trunk_.push_back(next);
  std::ranges::stable_sort(branches_, std::greater(), [](const Branch& b) { return b.values; });
}

/// In the order of their supernodes.
void SupernodalSweep::find_branches() {
  const std::vector<int> parent = parents(factor_);
  std::vector<Branch> upper;  // of each supernode, it and all that lead up to it
  std::int64_t all = 0;
  for (int s = 0; s < factor_.count(); ++s) {
    upper.push_back({.first = s, .root = s, .values = factor_.size(s), .beyond = {}});
    all += factor_.size(s);
  }
  is_worth_threads_ = all >= values_worth_threads;
  if (!is_worth_threads_ || !are_nested(factor_, parent)) return;
  std::vector<int> members(factor_.count(), 1);
  for (int s = 0; s < factor_.count(); ++s) {  // all that lead up to s have come
    if (parent[s] < 0) continue;
    upper[parent[s]].values += upper[s].values;
    upper[parent[s]].first = std::min(upper[parent[s]].first, upper[s].first);
    members[parent[s]] += members[s];
  }
  for (int s = 0; s < factor_.count(); ++s)
    if (members[s] != s - upper[s].first + 1) return;  // not in postorder
  const auto is_branch = [&](int s) { return s >= 0 && upper[s].values * parts <= all; };
  for (int s = 0; s < factor_.count(); ++s) {
    if (!is_branch(s) || is_branch(parent[s])) continue;
    branches_.push_back(upper[s]);
    branches_.back().beyond.resize(std::ssize(factor_.below(s)));
  }
}

/// For as many threads as it returns: no more than there are large branches, for each takes room.
int SupernodalSweep::make_room() {
  const int threads = std::min(omp_get_max_threads(), parts);
  if (std::ssize(rooms_) >= threads) return threads;
  std::ptrdiff_t most = 0;
  for (int s = 0; s < factor_.count(); ++s) most = std::max(most, std::ssize(factor_.below(s)));
  rooms_.resize(threads);
  for (ThreadRoom& room : rooms_) {
    room.gathered.resize(most);
    room.place.resize(factor_.permutation.size());
  }
  return threads;
}

void SupernodalSweep::forward(const double* values, Branch& branch, ThreadRoom& room,
                              Eigen::Ref<Eigen::VectorXd> x) const {
  const std::span<const int> beyond = factor_.below(branch.root);
  const int end = factor_.columns[branch.root + 1];
  for (std::size_t k = 0; k < beyond.size(); ++k) room.place[beyond[k]] = static_cast<int>(k);
  branch.beyond.setZero();
  for (int s = branch.first; s <= branch.root; ++s) {
    const std::span<const int> rows = factor_.below(s);
    auto change = room.gathered.head(std::ssize(rows));
    factor_.eliminate(values, s, factor_.own(x, s), change);
    const auto inside = std::ranges::lower_bound(rows, end) - rows.begin();
    for (std::ptrdiff_t k = 0; k < inside; ++k) x[rows[k]] -= change[k];
    for (std::ptrdiff_t k = inside; k < std::ssize(rows); ++k)
      branch.beyond[room.place[rows[k]]] += change[k];
  }
}

void SupernodalSweep::forward(const double* values, Eigen::Ref<Eigen::VectorXd> x) {
  const int threads = make_room();
#pragma omp parallel for schedule(dynamic, 1) num_threads(threads) if (is_worth_threads_)
  for (std::size_t b = 0; b < branches_.size(); ++b)
    forward(values, branches_[b], rooms_[omp_get_thread_num()], x);
  for (const Branch& branch : branches_) {
    const std::span<const int> rows = factor_.below(branch.root);
    for (std::size_t k = 0; k < rows.size(); ++k)
      x[rows[k]] -= branch.beyond[static_cast<Eigen::Index>(k)];
  }
  for (const int s : trunk_) {
    const std::span<const int> rows = factor_.below(s);
    auto change = rooms_[0].gathered.head(std::ssize(rows));
    factor_.eliminate(values, s, factor_.own(x, s), change);
    for (std::ptrdiff_t k = 0; k < std::ssize(rows); ++k) x[rows[k]] -= change[k];
  }
}

void SupernodalSweep::backward(const double* values, int s, ThreadRoom& room,
                               Eigen::Ref<Eigen::VectorXd> x) const {
  const std::span<const int> rows = factor_.below(s);
  auto known = room.gathered.head(std::ssize(rows));
  for (std::ptrdiff_t k = 0; k < std::ssize(rows); ++k) known[k] = x[rows[k]];
  factor_.substitute(values, s, factor_.own(x, s), known);
}

void SupernodalSweep::backward(const double* values, Eigen::Ref<Eigen::VectorXd> x) {
  const int threads = make_room();
  for (const int s : std::views::reverse(trunk_)) backward(values, s, rooms_[0], x);
#pragma omp parallel for schedule(dynamic, 1) num_threads(threads) if (is_worth_threads_)
  for (std::size_t b = 0; b < branches_.size(); ++b) {
    ThreadRoom& room = rooms_[omp_get_thread_num()];
    for (int s = branches_[b].root; s >= branches_[b].first; --s) backward(values, s, room, x);
  }
}

}  // namespace perifrac
