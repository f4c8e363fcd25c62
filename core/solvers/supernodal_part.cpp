#include "core/solvers/supernodal_part.hpp"

#include <algorithm>
#include <cassert>
#include <type_traits>

namespace perifrac {

SupernodalPart::SupernodalPart(const Supernodes& factor)
    : factor_(factor),
      sweep_(factor),
      place_(factor.permutation.size()),
      supernode_of_(factor.supernode_of()),
      is_on_path_(factor.count(), 0) {
  for (std::size_t k = 0; k < place_.size(); ++k)
    place_[factor.permutation[k]] = static_cast<int>(k);
}

/// The supernodes on the ways from these rows of A to the root, each once, ascending: those that
/// come first are eliminated first.
void SupernodalPart::find_paths(std::span<const int> rows, std::vector<int>& path) {
  path.clear();
  for (const int row : rows) {
    assert(row >= 0 && row < std::ssize(place_));
    int s = supernode_of_[place_[row]];
    while (!is_on_path_[s]) {
      is_on_path_[s] = 1;
      path.push_back(s);
      if (factor_.below(s).empty()) break;
      s = supernode_of_[factor_.below(s).front()];
    }
  }
  for (const int s : path) is_on_path_[s] = 0;
  std::ranges::sort(path);
}

/// `columns`: a constant where there are few, each of which goes through a supernode while that is
/// at hand; for more of them there are products of matrices.
template <class Columns, class Go>
void SupernodalPart::in_columns(Columns columns, Go&& go) {
  if constexpr (std::is_same_v<Columns, Eigen::Index>) {
    go(work_.leftCols(columns), gathered_.leftCols(columns));
  } else {
    for (int c = 0; c < columns; ++c) go(work_.col(c), gathered_.col(c));
  }
}

template <class Columns>
void SupernodalPart::forward(const double* values, int s, Columns columns) {
  const std::span<const int> rows = factor_.below(s);
  in_columns(columns, [&](auto work, auto gathered) {
    auto change = gathered.topRows(std::ssize(rows));
    factor_.eliminate(values, s, factor_.own(work, s), change);
    for (Eigen::Index c = 0; c < change.cols(); ++c) {
      for (std::size_t k = 0; k < rows.size(); ++k) {
        work(rows[k], c) -= change(static_cast<Eigen::Index>(k), c);
      }
    }
  });
}

template <class Columns>
void SupernodalPart::backward(const double* values, int s, Columns columns) {
  const std::span<const int> rows = factor_.below(s);
  in_columns(columns, [&](auto work, auto gathered) {
    auto known = gathered.topRows(std::ssize(rows));
    for (Eigen::Index c = 0; c < known.cols(); ++c) {
      for (std::size_t k = 0; k < rows.size(); ++k) {
        known(static_cast<Eigen::Index>(k), c) = work(rows[k], c);
      }
    }
    factor_.substitute(values, s, factor_.own(work, s), known);
  });
}

void SupernodalPart::make_room(Eigen::Index columns) {
  if (work_.cols() >= columns) return;
  std::ptrdiff_t most = 0;
  for (int s = 0; s < factor_.count(); ++s) most = std::max(most, std::ssize(factor_.below(s)));
  work_.setZero(std::ssize(place_), columns);
  gathered_.resize(most, columns);
}

void SupernodalPart::solve(const double* values, const Eigen::Ref<const Eigen::VectorXd>& b,
                           Eigen::Ref<Eigen::VectorXd> x) {
  make_room(1);
  auto work = work_.col(0);
  for (Eigen::Index k = 0; k < b.size(); ++k) work[place_[k]] = b[k];
  sweep_.forward(values, work);
  sweep_.backward(values, work);
  for (Eigen::Index k = 0; k < x.size(); ++k) x[k] = work[place_[k]];
  work.setZero();
}

void SupernodalPart::begin(const double* values, const Eigen::VectorXd& b, Eigen::VectorXd& begun) {
  begun.resize(b.size());
  for (Eigen::Index k = 0; k < b.size(); ++k) begun[place_[k]] = b[k];
  sweep_.forward(values, begun);
}

void SupernodalPart::part(const double* values, const Eigen::VectorXd& begun,
                          std::span<const int> wanted, Eigen::VectorXd& x) {
  make_room(1);
  find_paths(wanted, down_);
  for (const int s : down_) factor_.own(work_, s).col(0) = factor_.own(begun, s);
  for (auto s = down_.rbegin(); s != down_.rend(); ++s) backward(values, *s, Eigen::fix<1>());
  x.resize(std::ssize(wanted));
  for (Eigen::Index k = 0; k < x.size(); ++k) x[k] = work_(place_[wanted[k]], 0);
  for (const int s : down_) factor_.own(work_, s).col(0).setZero();
}

void SupernodalPart::finish(const double* values, const Eigen::VectorXd& begun,
                            std::span<const int> rows, const Eigen::VectorXd& c,
                            Eigen::VectorXd& x) {
  make_room(1);
  find_paths(rows, up_);
  for (Eigen::Index k = 0; k < c.size(); ++k) work_(place_[rows[k]], 0) = c[k];
  for (const int s : up_) forward(values, s, Eigen::fix<1>());
  work_.col(0) += begun;
  sweep_.backward(values, work_.col(0));
  x.resize(begun.size());
  for (Eigen::Index k = 0; k < x.size(); ++k) x[k] = work_(place_[k], 0);
  work_.col(0).setZero();
}

void SupernodalPart::solve(const double* values, std::span<const int> rows,
                           const Eigen::Ref<const Eigen::MatrixXd>& b, std::span<const int> wanted,
                           Eigen::Ref<Eigen::MatrixXd> x) {
  const Eigen::Index columns = b.cols();
  find_paths(rows, up_);
  find_paths(wanted, down_);
  make_room(columns);
  for (std::size_t k = 0; k < rows.size(); ++k) {
    work_.row(place_[rows[k]]).head(columns) = b.row(static_cast<Eigen::Index>(k));
  }
  const auto pass = [&](auto count) {
    for (const int s : up_) forward(values, s, count);
    for (auto s = down_.rbegin(); s != down_.rend(); ++s) backward(values, *s, count);
  };
  if (columns == 1) {
    pass(Eigen::fix<1>());
  } else if (columns == 2) {
    pass(Eigen::fix<2>());
  } else {
    pass(columns);
  }
  for (std::size_t k = 0; k < wanted.size(); ++k) {
    x.row(static_cast<Eigen::Index>(k)) = work_.row(place_[wanted[k]]).head(columns);
  }
  for (const std::vector<int>* path : {&up_, &down_}) {
    for (const int s : *path) {
      factor_.own(work_.leftCols(columns), s).setZero();
    }
  }
}

}  // namespace perifrac
