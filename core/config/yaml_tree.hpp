#pragma once

#include <string>
#include <vector>

namespace perifrac {

/// One node of a YAML document as the user wrote it, with its place for messages.
struct YamlNode {
  enum class Kind { null, scalar, list, map };

  Kind kind = Kind::null;
  std::string text{};                ///< of a scalar
  std::string place{};               ///< `file:line:column`, or `--set key=value`
  std::string key{};                 ///< the name of this node in a map
  std::string key_place{};           ///< where that name stands; the node's own place in a list
  std::vector<YamlNode> children{};  ///< in the order of the file

  const YamlNode* child(const std::string& name) const;
};

/// What stands there instead of what should: `is a list`, `'4 m' is a single value`.
std::string describe_kind(const YamlNode& node);

/// The node on one line, which reads back as the same.
std::string yaml_text(const YamlNode& node);

/// Reads one YAML document. Throws InputError for bad syntax, duplicate keys (yaml-cpp itself keeps
/// them silently), aliases and a second document. No text gives a null node.
YamlNode parse_yaml_file(const std::string& path);

/// As above from a text that stands at one place, such as the value of `--set key=value`.
YamlNode parse_yaml_text(const std::string& text, const std::string& place);

}  // namespace perifrac
