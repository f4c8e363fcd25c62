#pragma once

#include <algorithm>
#include <array>
#include <cstddef>
#include <functional>
#include <span>
#include <string_view>
#include <utility>
#include <vector>

#include "core/base/points.hpp"

namespace perifrac {

/// Rows of values by number, of which several may be one and the same until it is changed.
template <class T>
class SharedRows {
 public:
  Index count() const { return static_cast<Index>(rows_.size()); }
  Index size(Index row) const { return rows_[row].size; }
  std::span<const T> operator[](Index row) const {
    return {values_.data() + rows_[row].begin, static_cast<std::size_t>(rows_[row].size)};
  }
  /// Of all rows.
  std::size_t total() const {
    std::size_t sum = 0;
    for (const Row& row : rows_) sum += row.size;
    return sum;
  }

  /// Adds a row behind the others.
  void add(std::span<const T> values) {
    rows_.push_back({static_cast<Index>(values_.size()), static_cast<Index>(values.size())});
    is_shared_.push_back(false);
    values_.insert(values_.end(), values.begin(), values.end());
  }
  /// Adds a row that is the same as an earlier one.
  void repeat(Index earlier) {
    is_shared_[earlier] = true;
    is_shared_.push_back(true);
    rows_.push_back(Row(rows_[earlier]));
  }
  void reserve(Index rows, std::size_t values) {
    rows_.reserve(rows);
    is_shared_.reserve(rows);
    values_.reserve(values);
  }

  /// A row to be changed, of which none other is a part any more. From several threads only where
  /// no row was repeated.
  std::span<T> own(Index row) {
    if (is_shared_[row]) {
      const std::vector<T> values((*this)[row].begin(), (*this)[row].end());
      rows_[row].begin = static_cast<Index>(values_.size());
      is_shared_[row] = false;
      values_.insert(values_.end(), values.begin(), values.end());
    }
    return {values_.data() + rows_[row].begin, static_cast<std::size_t>(rows_[row].size)};
  }

  std::size_t bytes() const {
    return sizeof(Row) * rows_.size() + sizeof(T) * values_.size() + is_shared_.size() / 8;
  }

  /// Of equal rows, however they are kept.
  bool operator==(const SharedRows& other) const {
    if (count() != other.count()) return false;
    for (Index row = 0; row < count(); ++row) {
      if (!std::ranges::equal((*this)[row], other[row])) return false;
    }
    return true;
  }

 private:
  struct Row {
    Index begin;  ///< among the values
    Index size;
  };

  std::vector<Row> rows_;
  std::vector<bool> is_shared_;
  std::vector<T> values_;
};

/// Rows as they are found, one after the other: a row that is equal to one of late is that one.
template <class T>
class SharedRowList {
 public:
  SharedRowList() { late_.fill(-1); }

  void add(std::span<const T> values) {
    const std::string_view bytes(reinterpret_cast<const char*>(values.data()), values.size_bytes());
    Index& late = late_[std::hash<std::string_view>{}(bytes) % late_.size()];
    if (late >= 0 && std::ranges::equal(rows_[late], values)) {
      rows_.repeat(late);
    } else {
      late = rows_.count();
      rows_.add(values);
    }
  }
  SharedRows<T> take() { return std::move(rows_); }

 private:
  SharedRows<T> rows_;
  std::array<Index, 1 << 14> late_;  ///< by hash: the last row that has it, or -1
};

}  // namespace perifrac
