#pragma once

#include <string>
#include <vector>

namespace perifrac {

enum class KeyType {
  number,  ///< a quantity, read in SI
  integer,
  boolean,
  word,     ///< one of `words`
  text,     ///< free text
  vector,   ///< a list of quantities, one a dimension of space
  numbers,  ///< a list of quantities of any length
  tree,     ///< any list or map, for who declares the key to read
};

/// One line of the table of scene keys: all that is known of a key, declared once, where it is
/// used. The reader, its errors, `perifrac list` and the reference page come from it.
struct Key {
  /// Relative to the table's section. `*` stands for any name the user gives (`boundary.*.type`),
  /// `[]` for the items of a list (`probes[].at`); two items of a list may not share their `name`.
  std::string path;
  KeyType type = KeyType::number;
  /// SI unit that the value is converted to; empty: dimensionless. `N/m|N`: in 2D, in 3D.
  std::string unit{};
  /// Interval that every number must lie in, as in `(0, inf)` or `[0, 0.5)`, in `unit`; empty: any.
  std::string range{};
  /// The value, as it would stand in a scene, where the key is left out.
  std::string fallback{};
  /// Must be written wherever its section is on; below `*` and `[]`, in every item that is written.
  bool required = false;
  std::vector<std::string> words{};
  /// `type=pressure|flux`: the key holds only where the key `type` beside it is one of these words.
  /// One path may be declared several times under different words. Empty: holds always.
  std::string when{};
  std::string meaning;
};

using KeyTable = std::vector<Key>;

}  // namespace perifrac
