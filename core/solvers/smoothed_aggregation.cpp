#include "core/solvers/smoothed_aggregation.hpp"

#include <algorithm>
#include <utility>

namespace perifrac {

namespace {

using Matrix = Eigen::SparseMatrix<double>;
using Entry = Matrix::InnerIterator;

/// Of the largest entry of its row, or of its column, a strong one has this part.
constexpr double strong_part = 0.25;
/// A coarser matrix that has more than this part of the unknowns is not worth its cycle.
constexpr double worth_part = 0.7;
constexpr int none = -1;

class Aggregation {
 public:
  Aggregation(const Matrix& matrix, const std::vector<bool>& held);

  Matrix from_coarser() const;

 private:
  bool is_strong(const Entry& entry) const {
    const auto i = entry.row(), j = entry.col();
    return i != j && !held_[i] && -entry.value() > 0.0 &&
           -entry.value() >= strong_part * std::min(largest_[i], largest_[j]);
  }
  void find_largest();
  void gather_whole_neighbourhoods();
  void join_neighbours();
  void gather_rest();

  const Matrix& matrix_;
  const std::vector<bool>& held_;
  Eigen::VectorXd largest_;     ///< size of each row's entries off the diagonal
  std::vector<int> aggregate_;  ///< of each unknown
  int count_ = 0;
};

Aggregation::Aggregation(const Matrix& matrix, const std::vector<bool>& held)
    : matrix_(matrix), held_(held), aggregate_(matrix.cols(), none) {
  find_largest();
  gather_whole_neighbourhoods();
  join_neighbours();
  gather_rest();
}

void Aggregation::find_largest() {
  largest_.setZero(matrix_.cols());
  for (Eigen::Index j = 0; j < matrix_.cols(); ++j) {
    for (Entry entry(matrix_, j); entry; ++entry) {
      if (entry.row() != j) largest_[j] = std::max(largest_[j], -entry.value());
    }
  }
}

void Aggregation::gather_whole_neighbourhoods() {
  for (Eigen::Index j = 0; j < matrix_.cols(); ++j) {
    if (held_[j] || aggregate_[j] != none) continue;
    bool is_free = true, has_any = false;
    for (Entry entry(matrix_, j); entry && is_free; ++entry) {
      if (!is_strong(entry)) continue;
      has_any = true;
      is_free = aggregate_[entry.row()] == none;
    }
    if (!is_free || !has_any) continue;
    aggregate_[j] = count_;
    for (Entry entry(matrix_, j); entry; ++entry) {
      if (is_strong(entry)) aggregate_[entry.row()] = count_;
    }
    ++count_;
  }
}

/// To where the strongest entry leads.
void Aggregation::join_neighbours() {
  const std::vector<int> whole = aggregate_;
  for (Eigen::Index j = 0; j < matrix_.cols(); ++j) {
    if (held_[j] || whole[j] != none) continue;
    double strongest = 0.0;
    for (Entry entry(matrix_, j); entry; ++entry) {
      if (!is_strong(entry) || whole[entry.row()] == none) continue;
      if (-entry.value() <= strongest) continue;
      strongest = -entry.value();
      aggregate_[j] = whole[entry.row()];
    }
  }
}

void Aggregation::gather_rest() {
  for (Eigen::Index j = 0; j < matrix_.cols(); ++j) {
    if (held_[j] || aggregate_[j] != none) continue;
    for (Entry entry(matrix_, j); entry; ++entry) {
      if (!is_strong(entry) || aggregate_[entry.row()] != none) continue;
      aggregate_[entry.row()] = count_;
      aggregate_[j] = count_;
    }
    if (aggregate_[j] != none) ++count_;
  }
}

/// One step of Jacobi's iteration on the strong entries, from 1 in each aggregate, with the largest
/// step that makes no value negative; what is weak is added to the diagonal, so that rows keep
/// their sums.
Matrix Aggregation::from_coarser() const {
  std::vector<int> starts{0}, aggregates;
  std::vector<double> values;
  std::vector<std::pair<int, double>> row;
  for (Eigen::Index j = 0; j < matrix_.cols(); ++j) {
    row.clear();
    double diagonal = 0.0;
    for (Entry entry(matrix_, j); entry && aggregate_[j] != none; ++entry) {
      if (is_strong(entry) && aggregate_[entry.row()] != none) {
        row.emplace_back(aggregate_[entry.row()], -entry.value());
      } else if (!is_strong(entry) && !held_[entry.row()]) {
        diagonal += entry.value();
      }
    }
    std::ranges::sort(row);
    for (std::size_t k = 0; k < row.size(); ++k) {
      const double part = row[k].second / diagonal;
      if (k > 0 && row[k].first == row[k - 1].first) {
        values.back() += part;
      } else {
        aggregates.push_back(row[k].first);
        values.push_back(part);
      }
    }
    starts.push_back(static_cast<int>(values.size()));
  }
  const Eigen::Map<const Matrix> to_coarser(count_, matrix_.cols(), static_cast<int>(values.size()),
                                            starts.data(), aggregates.data(), values.data());
  return to_coarser.transpose();
}

}  // namespace

std::vector<AggregatedMatrix> aggregate(Eigen::SparseMatrix<double> finest,
                                        const std::vector<bool>& held, Eigen::Index few) {
  std::vector<AggregatedMatrix> levels;
  std::vector<bool> is_held = held;
  levels.push_back({std::move(finest), {}});
  while (levels.back().matrix.cols() > few) {
    AggregatedMatrix& fine = levels.back();
    Matrix way = Aggregation(fine.matrix, is_held).from_coarser();
    if (way.cols() == 0 ||
        static_cast<double>(way.cols()) > worth_part * static_cast<double>(way.rows()))
      break;
    Matrix coarse = Matrix(way.transpose()) * (fine.matrix * way).eval();
    fine.from_coarser = std::move(way);
    is_held.assign(coarse.cols(), false);
    levels.push_back({std::move(coarse), {}});
  }
  return levels;
}

}  // namespace perifrac
