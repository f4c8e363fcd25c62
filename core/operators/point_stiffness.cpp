#include "core/operators/point_stiffness.hpp"

#include <span>
#include <string_view>
#include <unordered_map>

namespace perifrac {

namespace {

using Matrix = Eigen::SparseMatrix<double>;

/// Lists of numbers, one after the other.
struct Lists {
  std::vector<Index> begin = {0};
  std::vector<Index> all;
  std::span<const Index> at(Index k) const {
    return std::span(all).subspan(begin[k], begin[k + 1] - begin[k]);
  }
  Index count() const { return static_cast<Index>(begin.size()) - 1; }
  void close() { begin.push_back(static_cast<Index>(all.size())); }
};

Lists unknowns_of_points(
    Index points,
    const std::function<void(Index i, std::vector<Index>& unknowns)>& append_unknowns) {
  Lists result;
  std::vector<Index> own;
  for (Index i = 0; i < points; ++i) {
    own.clear();
    append_unknowns(i, own);
    std::ranges::sort(own);
    const auto twice = std::ranges::unique(own);
    result.all.insert(result.all.end(), own.begin(), twice.begin());
    result.close();
  }
  return result;
}

/// The points of each unknown, ascending.
Lists turned(const Lists& unknowns, Index size) {
  Lists result;
  result.begin.assign(size + 1, 0);
  for (const Index k : unknowns.all) ++result.begin[k + 1];
  for (Index k = 0; k < size; ++k) result.begin[k + 1] += result.begin[k];
  result.all.resize(unknowns.all.size());
  std::vector<Index> next(result.begin.begin(), result.begin.end() - 1);
  for (Index i = 0; i < unknowns.count(); ++i) {
    for (const Index k : unknowns.at(i)) result.all[next[k]++] = i;
  }
  return result;
}

/// The first unknown that has the points of unknown k, for each k: mostly that of the first
/// component there.
std::vector<Index> first_of_same(const Lists& points) {
  std::unordered_map<std::string_view, Index> first;
  std::vector<Index> result;
  for (Index k = 0; k < points.count(); ++k) {
    const auto bytes = std::as_bytes(points.at(k));
    result.push_back(
        first.try_emplace({reinterpret_cast<const char*>(bytes.data()), bytes.size()}, k)
            .first->second);
  }
  return result;
}

/// An entry of 0 for each two unknowns that a point has.
/// `like` says which columns are the same.
Matrix pattern(const Lists& unknowns, const Lists& points, const std::vector<Index>& like) {
  const Index size = points.count();
  std::vector<Index> column_of(size, -1), rows(size + 1);
  std::vector<int> begin = {0}, entries;
  for (Index column = 0; column < size; ++column) {
    if (like[column] < column) {  // the same rows
      const int first = begin[like[column]], end = begin[like[column] + 1];
      for (int k = first; k < end; ++k) entries.push_back(entries[k]);
    } else {
      Index count = 0;
      for (const Index i : points.at(column)) {
        for (const Index row : unknowns.at(i)) {
          rows[count] = row;
          count += static_cast<Index>(column_of[row] != column);
          column_of[row] = column;
        }
      }
      std::sort(rows.begin(), rows.begin() + count);
      entries.insert(entries.end(), rows.begin(), rows.begin() + count);
    }
    begin.push_back(static_cast<int>(entries.size()));
  }
  Matrix result(size, size);
  result.resizeNonZeros(std::ssize(entries));
  std::ranges::copy(begin, result.outerIndexPtr());
  std::ranges::copy(entries, result.innerIndexPtr());
  std::fill_n(result.valuePtr(), entries.size(), 0.0);
  return result;
}

}  // namespace

Eigen::SparseMatrix<double> sum_of_points(
    Index size, Index points,
    const std::function<void(Index i, std::vector<Index>& unknowns)>& append_unknowns,
    const std::function<PointStiffness(Index i)>& stiffness) {
  const Lists unknowns = unknowns_of_points(points, append_unknowns);
  const Lists points_of = turned(unknowns, size);
  const std::vector<Index> like = first_of_same(points_of);
  Matrix sum = pattern(unknowns, points_of, like);
  const int *const begin = sum.outerIndexPtr(), *const rows = sum.innerIndexPtr();
  // Unknowns of a point that follow each other do so in the sum, and in each of its columns: where
  // such a run begins is looked for once for all columns that are the same.
  struct Run {
    std::size_t first, count;
  };
  std::vector<Run> runs;
  std::vector<std::ptrdiff_t> places;  // of each run, in the columns looked at
  std::vector<std::size_t> at(size);   // where a column's are
  for (Index i = 0; i < points; ++i) {
    const PointStiffness part = stiffness(i);
    runs.clear();
    for (std::size_t row = 0; row < part.unknowns.size(); ++row) {
      if (row > 0 && part.unknowns[row] == part.unknowns[row - 1] + 1)
        ++runs.back().count;
      else
        runs.push_back({row, 1});
    }
    places.clear();
    for (std::size_t k = 0; k < part.unknowns.size(); ++k) {
      const Index column = part.unknowns[k];
      if (like[column] == column) {
        at[column] = places.size();
        const int* place = rows + begin[column];
        for (const Run& run : runs) {
          place = std::lower_bound(place, rows + begin[column + 1], part.unknowns[run.first]);
          places.push_back(place - (rows + begin[column]));
        }
      }
      const std::ptrdiff_t* place = places.data() + at[like[column]];
      const double* const from = part.matrix.col(static_cast<Eigen::Index>(k)).data();
      for (const Run& run : runs) {
        double* const to = sum.valuePtr() + begin[column] + *place++;
        for (std::size_t row = 0; row < run.count; ++row) to[row] += from[run.first + row];
      }
    }
  }
  return sum;
}

}  // namespace perifrac
