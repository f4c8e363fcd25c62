#include "core/config/section.hpp"

#include <filesystem>
#include <stdexcept>

#include <fmt/format.h>

#include "core/base/errors.hpp"
#include "core/base/names.hpp"
#include "core/config/scene_tree.hpp"

namespace perifrac {

Section::Section(std::shared_ptr<const SceneTree> tree, std::string prefix)
    : tree_(std::move(tree)), prefix_(std::move(prefix)) {}

std::string Section::full_path(std::string_view path) const {
  std::string full = join_path(prefix_, path);
  if (tree_->keys.find(full) == nullptr) {
    throw std::logic_error(fmt::format("no key '{}' is declared", full));
  }
  return full;
}

template <class T>
const T& Section::value(std::string_view path, std::string_view wanted) const {
  const std::string full = full_path(path);
  const auto entry = tree_->entries.find(full);
  if (entry == tree_->entries.end()) {
    throw std::logic_error(fmt::format("key '{}' was left out and has no default", full));
  }
  const T* held = std::get_if<T>(&entry->second.value);
  if (held == nullptr) throw std::logic_error(fmt::format("key '{}' is not {}", full, wanted));
  return *held;
}

bool Section::has(std::string_view path) const { return tree_->entries.contains(full_path(path)); }

double Section::number(std::string_view path) const { return value<double>(path, "a number"); }
int Section::integer(std::string_view path) const { return value<int>(path, "an integer"); }
bool Section::boolean(std::string_view path) const { return value<bool>(path, "a boolean"); }
std::string Section::word(std::string_view path) const {
  return value<std::string>(path, "a word");
}
std::string Section::text(std::string_view path) const {
  return value<std::string>(path, "a text");
}
std::string Section::file(std::string_view path) const {
  const auto file = std::filesystem::path(tree_->folder) / text(path);
  std::error_code missing;  // whoever opens it will say so
  if (std::filesystem::exists(file, missing) && !std::filesystem::is_regular_file(file, missing)) {
    fail(path, fmt::format("{} is a folder or a device", in_quotes(text(path))), "a file");
  }
  return file.string();
}
std::vector<double> Section::numbers(std::string_view path) const {
  return value<std::vector<double>>(path, "a list of numbers");
}

const YamlNode& Section::tree(std::string_view path) const {
  return value<YamlNode>(path, "a tree");
}

std::vector<std::string> Section::names(std::string_view path) const {
  const auto entry = tree_->entries.find(full_path(path));
  return entry == tree_->entries.end() ? std::vector<std::string>{} : entry->second.children;
}

std::size_t Section::count(std::string_view path) const {
  const auto entry = tree_->entries.find(full_path(path));
  return entry == tree_->entries.end() ? 0 : entry->second.children.size();
}

Section Section::at(std::string_view path) const { return {tree_, full_path(path)}; }

Section Section::with_given(GivenFactors factors) const {
  auto tree = std::make_shared<SceneTree>(*tree_);
  tree->given = std::move(factors);
  return {std::move(tree), prefix_};
}

std::shared_ptr<const double> Section::given(std::string_view path) const {
  const auto factor = tree_->given.find(full_path(path));
  return factor == tree_->given.end() ? nullptr : factor->second;
}

std::string Section::place(std::string path) const {
  for (;;) {
    const auto entry = tree_->entries.find(path);
    if (entry != tree_->entries.end() && !entry->second.place.empty()) return entry->second.place;
    const auto last = path.find_last_of(".[");
    path = last == std::string::npos ? "" : path.substr(0, last);
  }
}

void Section::fail(std::string_view path, std::string_view problem,
                   std::string_view expected) const {
  refuse(path, fmt::format("{}; expected {}", problem, expected));
}

void Section::fail_unknown(std::string_view path, std::string_view name,
                           const std::vector<std::string>& known) const {
  refuse(path, fmt::format("unknown name {}; {}", in_quotes(name), expected_one_of(known, name)));
}

void Section::refuse(std::string_view path, const std::string& message) const {
  const std::string full = full_path(path);
  throw InputError(fmt::format("{}: {}{}{}", place(full), full, full.empty() ? "" : ": ", message));
}

}  // namespace perifrac
