#pragma once

#include <array>
#include <pybind11/pybind11.h>
#include <string>
#include <string_view>
#include <utility>

#include <fmt/format.h>

#include "core/config/key.hpp"
#include "core/module/port.hpp"

namespace perifrac {

/// What Python calls the values of an enum.
template <class Value, std::size_t count>
using Words = std::array<std::pair<std::string_view, Value>, count>;

inline constexpr Words<PortDirection, 2> directions{
    {{"in", PortDirection::in}, {"out", PortDirection::out}}};
inline constexpr Words<PortKind, 2> kinds{
    {{"intensive", PortKind::intensive}, {"extensive", PortKind::extensive}}};
inline constexpr Words<PortRole, 10> roles{{{"field", PortRole::field},
                                            {"property", PortRole::property},
                                            {"mass_stored", PortRole::mass_stored},
                                            {"mass_reference", PortRole::mass_reference},
                                            {"mass_gained", PortRole::mass_gained},
                                            {"mass_artificial", PortRole::mass_artificial},
                                            {"energy_stored", PortRole::energy_stored},
                                            {"energy_gained", PortRole::energy_gained},
                                            {"energy_dissipated", PortRole::energy_dissipated},
                                            {"work", PortRole::work}}};
inline constexpr Words<KeyType, 8> key_types{{{"number", KeyType::number},
                                              {"integer", KeyType::integer},
                                              {"boolean", KeyType::boolean},
                                              {"word", KeyType::word},
                                              {"text", KeyType::text},
                                              {"vector", KeyType::vector},
                                              {"numbers", KeyType::numbers},
                                              {"tree", KeyType::tree}}};

template <class Value, std::size_t count>
Value value_of(const Words<Value, count>& words, std::string_view word) {
  std::string known;
  for (const auto& [name, value] : words) {
    if (name == word) return value;
    known += (known.empty() ? "" : ", ") + std::string(name);
  }
  throw pybind11::value_error(
      fmt::format("'{}' is no such word; expected one of: {}", word, known));
}

template <class Value, std::size_t count>
std::string word_of(const Words<Value, count>& words, Value value) {
  for (const auto& [name, each] : words) {
    if (each == value) return std::string(name);
  }
  return {};
}

}  // namespace perifrac
