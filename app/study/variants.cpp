#include "app/study/variants.hpp"

#include <algorithm>
#include <charconv>
#include <cmath>
#include <filesystem>
#include <set>

#include <fmt/format.h>

#include "app/run/scene_keys.hpp"
#include "app/simulation/outside_modules.hpp"
#include "core/base/errors.hpp"
#include "core/base/names.hpp"
#include "core/config/override.hpp"
#include "core/config/scene.hpp"

namespace perifrac {

namespace {

constexpr int most_threads = 1024;

int read_threads(const Override& override) {
  const std::string& text = override.value.text;
  int threads = 0;
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), threads);
  if (error == std::errc() && end == text.data() + text.size() && threads >= 1 &&
      threads <= most_threads) {
    return threads;
  }
  throw InputError(fmt::format("{}: threads: {} is no number of threads; expected 1 to {}",
                               override.value.place, in_quotes(text), most_threads));
}

/// Puts the overrides where they belong; a later one of a key takes the place of an earlier one.
void add(Variant& variant, const Overrides& overrides, const std::filesystem::path& folder) {
  for (const Override& override : overrides) {
    if (override.key == threads_word) {
      variant.threads = read_threads(override);
    } else if (override.key == scene_word) {
      variant.scene = (folder / override.value.text).lexically_normal().string();
    } else {
      std::erase_if(variant.overrides,
                    [&](const Override& one) { return one.key == override.key; });
      variant.overrides.push_back(override);
    }
  }
}

/// What the keys of scenes say against it.
std::string problem_of(const Variant& variant) {
  try {
    load_outside_modules(variant.scene);
    YamlNode written = parse_yaml_file(variant.scene);
    for (const Override& override : variant.overrides)
      set_key(written, override.key, override.value);
    check_tree(written, variant.scene, scene_catalogue());
  } catch (const InputError& error) {
    return error.what();
  }
  return "";
}

std::string name_of(const Study& study, const std::vector<std::size_t>& choice) {
  std::string name;
  for (std::size_t a = 0; a < study.axes.size(); ++a) {
    const StudyAxis& axis = study.axes[a];
    const AxisValue& value = axis.values[choice[a]];
    if (a > 0) name += "-";
    // A bare number says little without the name of its axis.
    if (std::isfinite(value.number)) name += file_name_part(axis.name) + "_";
    name += file_name_part(value.label);
  }
  return name;
}

bool is_skipped(const Study& study, const std::vector<std::size_t>& choice) {
  return std::ranges::any_of(study.skipped, [&](const AxisValues& combination) {
    for (std::size_t a = 0; a < study.axes.size(); ++a) {
      const auto entry = combination.find(study.axes[a].name);
      if (entry == combination.end()) continue;
      if (std::ranges::count(entry->second, study.axes[a].values[choice[a]].label) == 0)
        return false;
    }
    return true;
  });
}

/// The next combination, the last axis first; false after the last one.
bool next(const Study& study, std::vector<std::size_t>& choice) {
  for (std::size_t a = study.axes.size(); a-- > 0;) {
    if (++choice[a] < study.axes[a].values.size()) return true;
    choice[a] = 0;
  }
  return false;
}

Variant make_variant(const Study& study, std::string name, std::vector<std::size_t> choice) {
  const std::filesystem::path folder = std::filesystem::path(study.file).parent_path();
  Variant variant{
      .name = std::move(name), .choice = std::move(choice), .scene = study.scene, .overrides = {}};
  add(variant, study.common, folder);
  for (std::size_t a = 0; a < variant.choice.size(); ++a) {
    add(variant, study.axes[a].values[variant.choice[a]].overrides, folder);
  }
  if (variant.choice.empty()) add(variant, study.error.finer, folder);
  variant.problem = problem_of(variant);
  return variant;
}

}  // namespace

Matrix expand(const Study& study) {
  Matrix matrix;
  std::vector<std::size_t> choice(study.axes.size(), 0);
  std::set<std::string> names = {"finer"};
  do {
    std::string name = name_of(study, choice);
    if (is_skipped(study, choice)) {
      matrix.left_out.push_back(name);
      continue;
    }
    if (!names.insert(name).second) {
      study.section.fail("axes", fmt::format("two variants are called {}", in_quotes(name)),
                         "values whose names differ by more than blanks and signs");
    }
    matrix.variants.push_back(make_variant(study, std::move(name), choice));
  } while (next(study, choice));
  if (matrix.variants.empty()) study.section.fail("skip", "leaves nothing", "a variant to run");
  if (study.error.against == "finer") matrix.variants.push_back(make_variant(study, "finer", {}));
  const bool none =
      std::ranges::none_of(matrix.variants, [](const Variant& v) { return v.problem.empty(); });
  if (none) throw InputError(matrix.variants.front().problem);
  return matrix;
}

}  // namespace perifrac
