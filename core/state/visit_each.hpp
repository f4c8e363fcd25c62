#pragma once

#include <cstdint>
#include <string>
#include <string_view>
#include <type_traits>
#include <vector>

#include "core/base/require.hpp"
#include "core/state/state_visitor.hpp"

namespace perifrac {

/// A field of every one of many: `of(item)` is a reference to a number, a bool, or a vector of
/// numbers.
template <class Of>
struct FieldOfEach {
  std::string_view name;
  Of of;
};

template <class Of>
FieldOfEach(std::string_view, Of) -> FieldOfEach<Of>;

namespace detail {

template <class Number>
using Stored = std::conditional_t<std::is_floating_point_v<Number>, double, std::int64_t>;

template <class Item, class Of>
void visit_numbers(StateVisitor& visitor, std::vector<Item>& items, bool sizes_items,
                   std::string_view name, const Of& of) {
  using Number = std::remove_cvref_t<decltype(of(items[0]))>;
  std::vector<Stored<Number>> column;
  for (Item& item : items) column.push_back(static_cast<Stored<Number>>(of(item)));
  visitor.visit(name, column);
  if (sizes_items) items.resize(column.size());
  require(column.size() == items.size(), "a state in parts that do not fit");
  for (std::size_t k = 0; k < items.size(); ++k) of(items[k]) = static_cast<Number>(column[k]);
}

template <class Item, class Of>
void visit_vectors(StateVisitor& visitor, std::vector<Item>& items, bool sizes_items,
                   std::string_view name, const Of& of) {
  using Number = typename std::remove_cvref_t<decltype(of(items[0]))>::value_type;
  std::vector<std::int64_t> sizes;
  std::vector<Stored<Number>> all;
  for (Item& item : items) {
    sizes.push_back(static_cast<std::int64_t>(of(item).size()));
    all.insert(all.end(), of(item).begin(), of(item).end());
  }
  visitor.visit(std::string(name).append("_count"), sizes);
  visitor.visit(name, all);
  if (sizes_items) items.resize(sizes.size());
  require(sizes.size() == items.size(), "a state in parts that do not fit");
  std::size_t begin = 0;
  for (std::size_t k = 0; k < items.size(); ++k) {
    const auto count = static_cast<std::size_t>(sizes[k]);
    require(sizes[k] >= 0 && count <= all.size() - begin, "a state in parts that do not fit");
    const auto first = all.begin() + static_cast<std::ptrdiff_t>(begin);
    of(items[k]).assign(first, first + static_cast<std::ptrdiff_t>(count));
    begin += count;
  }
}

}  // namespace detail

/// Shows the fields of many, each as a column `group/name`; a visitor that restores may change how
/// many there are.
template <class Item, class... Of>
void visit_each(StateVisitor& visitor, std::string_view group, std::vector<Item>& items,
                const FieldOfEach<Of>&... fields) {
  visitor.enter(group);
  bool sizes_items = true;
  const auto visit = [&](const auto& field) {
    using Value = std::remove_cvref_t<decltype(field.of(items[0]))>;
    if constexpr (std::is_arithmetic_v<Value>) {
      detail::visit_numbers(visitor, items, sizes_items, field.name, field.of);
    } else {
      detail::visit_vectors(visitor, items, sizes_items, field.name, field.of);
    }
    sizes_items = false;
  };
  (visit(fields), ...);
  visitor.leave();
}

}  // namespace perifrac
