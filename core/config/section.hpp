#pragma once

#include <map>
#include <memory>
#include <string>
#include <string_view>
#include <vector>

namespace perifrac {

struct SceneTree;
struct YamlNode;

/// Factors that somebody may change while a scene runs, by the path of the schedule that each
/// multiplies (`solid.boundary.top.schedule`).
using GivenFactors = std::map<std::string, std::shared_ptr<const double>, std::less<>>;

/// A read-only view of a part of a validated scene: units are SI, defaults are filled in, ranges
/// hold. Paths are relative to the section (`material.youngs_modulus`, `probes[0].at`). Asking for
/// a path that no key declares, as another type, or for the value of a key that was left out and
/// has no default is a programming error (std::logic_error).
class Section {
 public:
  Section(std::shared_ptr<const SceneTree> tree, std::string prefix);

  /// The key was written or has a default. Also true for a parent that was written.
  bool has(std::string_view path) const;
  double number(std::string_view path) const;
  int integer(std::string_view path) const;
  bool boolean(std::string_view path) const;
  std::string word(std::string_view path) const;
  std::string text(std::string_view path) const;
  /// A text that names a file, taken from the folder of the scene.
  std::string file(std::string_view path) const;
  std::vector<double> numbers(std::string_view path) const;     ///< vector and numbers
  const YamlNode& tree(std::string_view path) const;            ///< as written
  std::vector<std::string> names(std::string_view path) const;  ///< children, in the file's order
  std::size_t count(std::string_view path) const;               ///< items of a list; 0 if absent
  Section at(std::string_view path) const;
  Section scene() const { return {tree_, ""}; }  ///< the whole scene, for what all physics share

  /// The same with factors that its schedules follow (core/time/schedule.hpp).
  Section with_given(GivenFactors factors) const;
  /// The one for the schedule at `path`, null where there is none.
  std::shared_ptr<const double> given(std::string_view path) const;

  /// The scene is wrong in a way that only the reader of this key can know.
  /// Throws InputError `file:line:column: path: problem; expected <expected>`.
  [[noreturn]] void fail(std::string_view path, std::string_view problem,
                         std::string_view expected) const;

  /// As `fail`, for a name the user chose: adds the nearest of the names that would do.
  [[noreturn]] void fail_unknown(std::string_view path, std::string_view name,
                                 const std::vector<std::string>& known) const;

 private:
  template <class T>
  const T& value(std::string_view path, std::string_view wanted) const;
  [[noreturn]] void refuse(std::string_view path, const std::string& message) const;
  std::string full_path(std::string_view path) const;
  std::string place(std::string path) const;

  std::shared_ptr<const SceneTree> tree_;
  std::string prefix_;
};

}  // namespace perifrac
