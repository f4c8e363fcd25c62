#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "core/config/catalogue.hpp"

namespace perifrac {

/// `a.b[0].c` as `a`, `b`, `[0]`, `c`.
std::vector<std::string> path_segments(std::string_view path);

/// A name or `[i]` behind a path.
std::string join_path(std::string_view path, std::string_view segment);

/// A name in the tree of all keys that a scene may hold: either keys end here, or more names
/// follow.
struct KeyNode {
  struct Declaration {
    Key key;
    std::string type;  ///< of its section; empty: holds under every type
  };

  std::string name;                         ///< `*`: any name; `[]`: the items of a list
  std::vector<Declaration> declarations{};  ///< several where `type` or Key::when differ
  std::vector<KeyNode> children{};          ///< in the order of declaration
  bool optional = false;                    ///< a section whose keys hold only where it is written

  bool is_list() const { return children.size() == 1 && children[0].name == "[]"; }
  bool takes_any_name() const { return children.size() == 1 && children[0].name == "*"; }

  bool is_conditional() const;  ///< declared with Key::when
  bool has_types() const;       ///< a section whose key `type` picks what else it holds

  /// What `segment` of a concrete path leads to; null if nothing is declared there.
  const KeyNode* child(std::string_view segment) const;
  const KeyNode* find(std::string_view path) const;

  /// Some key here or below holds in a section of this type.
  bool holds_under(const std::string& type) const;
};

/// Lays the catalogue out as a tree. Throws std::logic_error where it contradicts itself.
KeyNode build_key_tree(const Catalogue& catalogue);

/// The name and the words of Key::when.
struct KeyCondition {
  std::string name;
  std::vector<std::string> words;
};
KeyCondition parse_condition(const std::string& when);

}  // namespace perifrac
