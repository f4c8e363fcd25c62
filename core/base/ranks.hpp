#pragma once

#include <cstddef>
#include <cstdint>
#include <functional>
#include <span>
#include <vector>

#include "core/base/points.hpp"
#include "core/base/require.hpp"

/// The processes that run one scene together, as mpirun starts them: decision 36. Each holds the
/// whole state and goes the same way through the program. Loops that are worth it are divided, and
/// what they wrote is gathered before anyone reads it, so that results have the bits of one
/// process. Built without PERIFRAC_MPI there is one process, and all of this is nothing.
namespace perifrac::ranks {

/// Pieces begin <= k < end of a loop.
struct Share {
  Index begin, end;
};

#ifdef PERIFRAC_MPI
int count();
int own();  ///< 0 <= own() < count()
/// A loop of so many points is divided: not where what others are told costs more than their share.
bool divides(Index points);
/// Every process gets what each one wrote between its bounds, bounds[r] and bounds[r + 1].
void gather(std::span<double> values, std::span<const Index> bounds);
/// The largest of what the processes say.
std::int64_t largest(std::int64_t own);
/// What the first process says.
double of_first(double own);
/// How many of the processes are on this machine, whose memory they share.
int count_here();
/// Returns once every process is here.
void wait_for_all();
/// The first process alone does `work`, which writes and asks no module: divided loops are not for
/// one. Where it throws, all throw.
void on_first(const std::function<void()>& work);

/// From the start of a process to its end.
class Session {
 public:
  /// Processes but the first say nothing from here on.
  Session();
  ~Session();
  Session(const Session&) = delete;
  Session& operator=(const Session&) = delete;
  /// The code with which this process ends: the largest of all. Where one has failed and others do
  /// not end, they are ended. What this one had to say is said where the first has nothing to say.
  int end(int code);
};
#else
constexpr int count() { return 1; }
constexpr int own() { return 0; }
constexpr bool divides(Index) { return false; }
constexpr void gather(std::span<double>, std::span<const Index>) {}
constexpr std::int64_t largest(std::int64_t own) { return own; }
constexpr double of_first(double own) { return own; }
constexpr int count_here() { return 1; }
constexpr void wait_for_all() {}
inline void on_first(auto&& work) { work(); }

struct Session {
  static constexpr int end(int code) { return code; }
};
#endif

inline bool is_first() { return own() == 0; }

/// What the first one says, as by its clock.
inline bool first_says(bool own) { return largest(is_first() && own) != 0; }

/// All say the same.
inline bool agree(std::int64_t own) { return largest(own) == -largest(-own); }

/// Where the share of each process in `pieces` begins, and where the last one ends.
inline std::vector<Index> bounds(Index pieces) {
  std::vector<Index> bounds;
  for (std::int64_t rank = 0; rank <= count(); ++rank) {
    bounds.push_back(static_cast<Index>(pieces * rank / count()));
  }
  return bounds;
}

/// What of a loop over `pieces` this process does, where there are `points` in them.
inline Share share(Index pieces, Index points) {
  if (!divides(points)) return {0, pieces};
  const std::vector<Index> ends = bounds(pieces);
  return {ends[own()], ends[own() + 1]};
}

/// Every process gets the values of all points, block by block, from those whose share they are.
inline void gather_shares(std::span<double> values, Index points) {
  if (!divides(points)) return;
  require(std::ssize(values) % points == 0, "whole blocks of points");
  const std::vector<Index> ends = bounds(points);
  for (std::size_t begin = 0; begin < values.size(); begin += points) {
    gather(values.subspan(begin, points), ends);
  }
}

}  // namespace perifrac::ranks
