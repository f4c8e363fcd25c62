#include "core/config/yaml_tree.hpp"

#include <algorithm>
#include <cctype>
#include <optional>
#include <sstream>
#include <unordered_map>

#include <fmt/format.h>
#include <yaml-cpp/eventhandler.h>
#include <yaml-cpp/yaml.h>

#include "core/base/errors.hpp"
#include "core/base/names.hpp"
#include "core/io/input_file.hpp"

namespace perifrac {
namespace {

/// Builds the tree from yaml-cpp's events: its own Node loses duplicate keys and follows aliases.
class TreeBuilder : public YAML::EventHandler {
 public:
  TreeBuilder(std::string source, bool with_marks)
      : source_(std::move(source)), with_marks_(with_marks) {
    root_.place = root_.key_place = place(YAML::Mark());
  }

  YamlNode take() { return std::move(root_); }

  std::string place(const YAML::Mark& mark) const {
    if (!with_marks_) return source_;
    return fmt::format("{}:{}:{}", source_, mark.line + 1, mark.column + 1);
  }

  void OnDocumentStart(const YAML::Mark& mark) override {
    if (started_) refuse(mark, "a second document begins", "expected one document a file");
    started_ = true;
  }
  void OnDocumentEnd() override {}
  void OnNull(const YAML::Mark& mark, YAML::anchor_t) override {
    if (expects_key()) refuse(mark, "a key is empty", "expected a name before ':'");
    add(node(YamlNode::Kind::null, mark));
  }
  void OnAlias(const YAML::Mark& mark, YAML::anchor_t) override {
    refuse(mark, "aliases are not read", "expected the value itself");
  }
  void OnScalar(const YAML::Mark& mark, const std::string&, YAML::anchor_t,
                const std::string& value) override {
    if (expects_key()) {
      take_key(mark, value);
      return;
    }
    YamlNode scalar = node(YamlNode::Kind::scalar, mark);
    scalar.text = value;
    add(std::move(scalar));
  }
  void OnSequenceStart(const YAML::Mark& mark, const std::string&, YAML::anchor_t,
                       YAML::EmitterStyle::value) override {
    open(YamlNode::Kind::list, mark);
  }
  void OnSequenceEnd() override { close(); }
  void OnMapStart(const YAML::Mark& mark, const std::string&, YAML::anchor_t,
                  YAML::EmitterStyle::value) override {
    open(YamlNode::Kind::map, mark);
  }
  void OnMapEnd() override { close(); }

 private:
  struct Key {
    std::string name;
    YAML::Mark mark;
  };
  /// A list or map whose end has not come yet.
  struct Open {
    YamlNode node;
    std::optional<Key> key;                       ///< read, its value not yet
    std::unordered_map<std::string, int> seen{};  ///< lines of the keys before it
  };

  bool expects_key() const {
    return !open_.empty() && open_.back().node.kind == YamlNode::Kind::map && !open_.back().key;
  }

  YamlNode node(YamlNode::Kind kind, const YAML::Mark& mark) const {
    YamlNode made{.kind = kind, .place = place(mark)};
    made.key_place = made.place;
    if (!open_.empty() && open_.back().key) {
      made.key = open_.back().key->name;
      made.key_place = place(open_.back().key->mark);
    }
    return made;
  }

  void take_key(const YAML::Mark& mark, const std::string& name) {
    Open& map = open_.back();
    const auto [first, is_new] = map.seen.try_emplace(name, mark.line + 1);
    if (!is_new) {
      refuse(mark, fmt::format("duplicate key {}", in_quotes(name)),
             fmt::format("expected each key once; it stands on line {} too", first->second));
    }
    map.key = {name, mark};
  }

  void open(YamlNode::Kind kind, const YAML::Mark& mark) {
    if (expects_key())
      refuse(mark, "a list or map stands where a key belongs",
             "expected a name before ':', and every bracket closed");
    open_.push_back({node(kind, mark), {}});
  }

  void close() {
    YamlNode done = std::move(open_.back().node);
    open_.pop_back();
    add(std::move(done));
  }

  void add(YamlNode made) {
    if (open_.empty()) {
      root_ = std::move(made);
      return;
    }
    open_.back().node.children.push_back(std::move(made));
    open_.back().key.reset();
  }

  [[noreturn]] void refuse(const YAML::Mark& mark, std::string_view problem,
                           std::string_view expected) const {
    throw InputError(fmt::format("{}: {}; {}", place(mark), problem, expected));
  }

  std::string source_;
  bool with_marks_;
  bool started_ = false;
  std::vector<Open> open_;
  YamlNode root_;
};

YamlNode parse(std::istream& text, TreeBuilder builder) {
  try {
    YAML::Parser parser(text);
    while (parser.HandleNextDocument(builder)) {
    }
  } catch (const YAML::Exception& error) {
    throw InputError(
        fmt::format("{}: not valid YAML ({}); expected 'key: value', indented by spaces",
                    builder.place(error.mark), error.msg));
  }
  return builder.take();
}

/// Plain where YAML takes it as the same text wherever it stands, else between double quotes.
std::string scalar_text(const std::string& text) {
  constexpr const char* plain =
      "abcdefghijklmnopqrstuvwxyzABCDEFGHIJKLMNOPQRSTUVWXYZ0123456789_.+-/^*()% ";
  const bool starts_plainly =
      !text.empty() && (std::isalnum(static_cast<unsigned char>(text[0])) ||
                        (text[0] == '-' && text.size() > 1 && text[1] != ' '));
  const bool is_null = text == "null" || text == "Null" || text == "NULL";
  if (starts_plainly && !is_null && text.back() != ' ' &&
      text.find_first_not_of(plain) == std::string::npos) {
    return text;
  }
  std::string quoted = "\"";
  for (const char c : text) {
    if (c == '"' || c == '\\') quoted += '\\';
    quoted += c == '\n' ? std::string("\\n") : std::string(1, c);
  }
  return quoted + '"';
}

}  // namespace

const YamlNode* YamlNode::child(const std::string& name) const {
  for (const YamlNode& candidate : children) {
    if (candidate.key == name) return &candidate;
  }
  return nullptr;
}

std::string describe_kind(const YamlNode& node) {
  if (node.kind == YamlNode::Kind::null) return "has no value";
  if (node.kind == YamlNode::Kind::scalar) return in_quotes(node.text) + " is a single value";
  return node.kind == YamlNode::Kind::list ? "is a list" : "is a map";
}

std::string yaml_text(const YamlNode& node) {
  if (node.kind == YamlNode::Kind::null) return "";
  if (node.kind == YamlNode::Kind::scalar) return scalar_text(node.text);
  const bool map = node.kind == YamlNode::Kind::map;
  std::string text;
  for (const YamlNode& child : node.children) {
    if (!text.empty()) text += ", ";
    if (map) text += scalar_text(child.key) + ": ";
    text += yaml_text(child);
  }
  return map ? "{" + text + "}" : "[" + text + "]";
}

YamlNode parse_yaml_file(const std::string& path) {
  std::istringstream text(read_input_text(path, "a scene file"));
  return parse(text, TreeBuilder(path, true));
}

YamlNode parse_yaml_text(const std::string& text, const std::string& place) {
  std::istringstream stream(text);
  return parse(stream, TreeBuilder(place, false));
}

}  // namespace perifrac
