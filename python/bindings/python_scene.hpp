#pragma once

#include <pybind11/pybind11.h>
#include <string>
#include <vector>

#include "core/config/section.hpp"
#include "core/config/yaml_tree.hpp"

namespace perifrac {

/// A scene as an object: what a file or a dictionary says, and what was put in its place since. The
/// program's catalogue checks every key.
class PythonScene {
 public:
  /// Throws InputError.
  static PythonScene from_file(const std::string& path);
  static PythonScene from_values(const pybind11::dict& values);

  /// By the path that --set takes. What is wrong with it throws InputError, and leaves the scene as
  /// it is; keys that are still missing do not.
  void set(const std::string& path, const pybind11::object& value);
  /// As it is written: text, number, list or dictionary. Throws KeyError.
  pybind11::object get(const std::string& path) const;
  bool has(const std::string& path) const;
  void remove(const std::string& path);

  /// Checks it whole, and gives what the program reads: SI, defaults included.
  Section section() const;
  /// What a checkpoint belongs to: of a file that text, and `# --set key=value` of every key that
  /// was set, as the program has it; else YAML.
  std::string text() const;
  std::string yaml() const;
  /// Its file; without one `scene`.
  const std::string& name() const { return name_; }

 private:
  PythonScene(YamlNode tree, std::string name) : tree_(std::move(tree)), name_(std::move(name)) {}

  YamlNode tree_;
  std::string name_;
  std::string file_text_{};  ///< empty: from no file
  std::vector<std::string> assignments_{};
};

void bind_scene(pybind11::module_& module);

}  // namespace perifrac
