#include "core/config/key_tree.hpp"

#include <algorithm>
#include <stdexcept>

#include <fmt/format.h>

namespace perifrac {
namespace {

KeyNode& declared_child(KeyNode& parent, const std::string& name) {
  for (KeyNode& child : parent.children) {
    if (child.name == name) return child;
  }
  if (!parent.children.empty() &&
      (parent.is_list() || parent.takes_any_name() || name == "[]" || name == "*")) {
    throw std::logic_error(fmt::format("key '{}' stands beside a '*' or '[]'", name));
  }
  parent.children.push_back({.name = name});
  return parent.children.back();
}

void declare(KeyNode& root, const std::string& section, const std::string& type, const Key& key) {
  KeyNode* node = &root;
  if (!section.empty()) node = &declared_child(*node, section);
  for (const std::string& segment : path_segments(key.path)) node = &declared_child(*node, segment);
  node->declarations.push_back({key, type});
}

void check(const KeyNode& node) {
  if (!node.declarations.empty() && !node.children.empty()) {
    throw std::logic_error(fmt::format("key '{}' is a value and a parent", node.name));
  }
  for (const KeyNode& child : node.children) check(child);
}

}  // namespace

std::vector<std::string> path_segments(std::string_view path) {
  std::vector<std::string> segments(1);
  for (const char c : path) {
    if (c == '.' || (c == '[' && !segments.back().empty())) segments.emplace_back();
    if (c != '.') segments.back() += c;
  }
  return segments;
}

std::string join_path(std::string_view path, std::string_view segment) {
  const bool plain = path.empty() || segment.empty() || segment[0] == '[';
  return fmt::format("{}{}{}", path, plain ? "" : ".", segment);
}

bool KeyNode::is_conditional() const {
  return std::any_of(declarations.begin(), declarations.end(),
                     [](const Declaration& declaration) { return !declaration.key.when.empty(); });
}

bool KeyNode::has_types() const {
  return std::any_of(children.begin(), children.end(), [](const KeyNode& child) {
    return child.name == "type" && !child.declarations.empty();
  });
}

const KeyNode* KeyNode::child(std::string_view segment) const {
  const bool item = segment.starts_with('[');
  for (const KeyNode& candidate : children) {
    if (item ? candidate.name == "[]" : candidate.name == segment || candidate.name == "*") {
      return &candidate;
    }
  }
  return nullptr;
}

const KeyNode* KeyNode::find(std::string_view path) const {
  const KeyNode* node = this;
  if (path.empty()) return node;
  for (const std::string& segment : path_segments(path)) {
    node = node->child(segment);
    if (node == nullptr) return nullptr;
  }
  return node;
}

bool KeyNode::holds_under(const std::string& type) const {
  return std::any_of(declarations.begin(), declarations.end(),
                     [&](const Declaration& declaration) {
                       return declaration.type.empty() || declaration.type == type;
                     }) ||
         std::any_of(children.begin(), children.end(),
                     [&](const KeyNode& child) { return child.holds_under(type); });
}

KeyNode build_key_tree(const Catalogue& catalogue) {
  KeyNode root;
  for (const SectionKeys& entry : catalogue) {
    if (!entry.type.empty()) {
      KeyNode& section = declared_child(root, entry.section);
      KeyNode& choice = declared_child(section, "type");
      if (choice.declarations.empty()) {
        choice.declarations.push_back(
            {{.path = "type", .type = KeyType::word, .required = true, .meaning = "What does it."},
             ""});
      }
      choice.declarations[0].key.words.push_back(entry.type);
    }
    for (const Key& key : entry.keys) declare(root, entry.section, entry.type, key);
    if (entry.optional) declared_child(root, entry.section).optional = true;
  }
  check(root);
  return root;
}

KeyCondition parse_condition(const std::string& when) {
  const auto equals = when.find('=');
  if (equals == std::string::npos) throw std::logic_error("no '=' in condition '" + when + "'");
  KeyCondition condition{when.substr(0, equals), {""}};
  for (const char c : when.substr(equals + 1)) {
    if (c == '|') {
      condition.words.emplace_back();
    } else {
      condition.words.back() += c;
    }
  }
  return condition;
}

}  // namespace perifrac
