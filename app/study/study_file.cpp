#include "app/study/study_file.hpp"

#include <algorithm>
#include <cmath>
#include <filesystem>

#include <fmt/format.h>

#include "app/simulation/outside_modules.hpp"
#include "app/study/study_keys.hpp"
#include "core/base/errors.hpp"
#include "core/base/names.hpp"
#include "core/config/scene.hpp"
#include "core/config/units.hpp"

namespace perifrac {

namespace {

std::vector<std::string> names_of(const std::vector<StudyAxis>& axes) {
  std::vector<std::string> names;
  for (const StudyAxis& axis : axes) names.push_back(axis.name);
  return names;
}

[[noreturn]] void refuse(const std::string& place, const std::string& problem,
                         const std::string& expected) {
  throw InputError(fmt::format("{}: {}; expected {}", place, problem, expected));
}

std::string scalar(const YamlNode& node) {
  if (node.kind != YamlNode::Kind::scalar) refuse(node.place, describe_kind(node), "a name");
  return node.text;
}

double labelled_number(const YamlNode& node, const std::string& unit) {
  try {
    return to_si(node.key, unit == "1" ? "" : unit);
  } catch (const QuantityError& error) {
    throw InputError(fmt::format("{}: {}", node.key_place, error.what()));
  }
}

/// A map of labels, each with what it sets.
std::vector<AxisValue> labelled_values(const Section& axis, const YamlNode& values,
                                       const SceneKeys& keys) {
  std::vector<AxisValue> result;
  for (const YamlNode& child : values.children) {
    const bool sets = child.kind == YamlNode::Kind::map;
    if (!sets && child.kind != YamlNode::Kind::null) keys.read(child);  // says what is wrong
    result.push_back({.label = child.key,
                      .number = axis.has("unit") ? labelled_number(child, axis.text("unit")) : NAN,
                      .overrides = sets ? keys.read(child) : Overrides{}});
  }
  return result;
}

/// A list of values of one key.
std::vector<AxisValue> listed_values(const Section& axis, const YamlNode& values,
                                     const SceneKeys& keys) {
  if (!axis.has("key")) axis.fail("values", "is a list", "a key beside it that takes these values");
  const std::string key = axis.text("key");
  std::vector<AxisValue> result;
  for (YamlNode value : values.children) {
    value.key_place = value.place;
    const std::string text = yaml_text(value);
    const std::string label = value.kind == YamlNode::Kind::scalar ? value.text : text;
    result.push_back({label, keys.number(key, label), {{key, value}}});
  }
  return result;
}

StudyAxis read_axis(const Section& axis, const SceneKeys& keys) {
  StudyAxis result{
      .name = axis.text("name"), .unit = "", .problem = axis.boolean("problem"), .values = {}};
  const YamlNode& values = axis.tree("values");
  if (axis.has("key")) {
    if (const auto wrong = keys.unknown(axis.text("key")))
      axis.fail_unknown("key", wrong->name, wrong->known);
    if (values.kind == YamlNode::Kind::map)
      axis.fail("values", "is a map", "a list of values of the key");
  }
  const bool listed = values.kind == YamlNode::Kind::list;
  result.values = listed ? listed_values(axis, values, keys) : labelled_values(axis, values, keys);
  if (axis.has("unit")) result.unit = axis.text("unit") == "1" ? "" : axis.text("unit");
  if (axis.has("key")) result.unit = keys.unit(axis.text("key"));
  for (const AxisValue& value : result.values) {
    if (std::ranges::count(result.values, value.label, &AxisValue::label) > 1) {
      axis.fail("values", fmt::format("{} comes twice", in_quotes(value.label)),
                "values that differ");
    }
  }
  return result;
}

std::vector<std::string> skipped_labels(const StudyAxis& axis, const YamlNode& node) {
  std::vector<std::string> known, labels;
  for (const AxisValue& value : axis.values) known.push_back(value.label);
  const bool list = node.kind == YamlNode::Kind::list;
  for (const YamlNode& label : list ? node.children : std::vector<YamlNode>{node}) {
    labels.push_back(scalar(label));
    if (std::ranges::count(known, labels.back()) > 0) continue;
    throw InputError(fmt::format("{}: axis {} has no value {}; {}", label.place,
                                 in_quotes(axis.name), in_quotes(labels.back()),
                                 expected_one_of(known, labels.back())));
  }
  return labels;
}

std::vector<AxisValues> read_skipped(const Study& study) {
  std::vector<AxisValues> result;
  if (!study.section.has("skip")) return result;
  const YamlNode& list = study.section.tree("skip");
  for (const YamlNode& entry : list.children) {
    if (list.kind != YamlNode::Kind::list || entry.kind != YamlNode::Kind::map) {
      refuse(entry.place, describe_kind(entry), "a list of maps, such as [{AXIS: VALUE}]");
    }
    AxisValues& combination = result.emplace_back();
    for (const YamlNode& axis : entry.children) {
      const auto names = names_of(study.axes);
      if (std::ranges::count(names, axis.key) == 0) {
        throw InputError(fmt::format("{}: no axis {}; {}", axis.key_place, in_quotes(axis.key),
                                     expected_one_of(names, axis.key)));
      }
      combination[axis.key] = skipped_labels(study.axis(axis.key), axis);
    }
  }
  return result;
}

ErrorMeasure read_error(const Section& error, const SceneKeys& keys,
                        const std::vector<StudyAxis>& axes) {
  ErrorMeasure result{.against = error.word("against")};
  if (error.has("quantity")) result.quantity = error.text("quantity");
  if (error.has("columns")) {
    for (const YamlNode& column : error.tree("columns").children) {
      result.columns.push_back(scalar(column));
    }
  }
  if (error.has("finer")) result.finer = keys.read(error.tree("finer"));
  if (error.has("axis")) {
    result.axis = error.text("axis");
    const auto names = names_of(axes);
    if (std::ranges::count(names, result.axis) == 0) error.fail_unknown("axis", result.axis, names);
    const auto axis = std::ranges::find(axes, result.axis, &StudyAxis::name);
    if (!axis->is_numeric() || axis->values.size() < 3) {
      error.fail("axis", fmt::format("{} has no three numbers", in_quotes(result.axis)),
                 "an axis of three or more numbers");
    }
  }
  result.largest = error.word("norm") == "largest";
  result.from = error.number("from");
  if (error.has("to")) result.to = error.number("to");
  return result;
}

}  // namespace

bool StudyAxis::is_numeric() const {
  return values.size() > 1 &&
         std::ranges::all_of(values, [](const AxisValue& value) { return value.number > 0.0; });
}

const StudyAxis& Study::axis(const std::string& name) const {
  return *std::ranges::find(axes, name, &StudyAxis::name);
}

Study read_study(const std::string& file) {
  const Section section = check_tree(parse_yaml_file(file), file, study_catalogue());
  const std::string scene =
      std::filesystem::path(section.file("scene")).lexically_normal().string();
  if (std::filesystem::exists(scene)) load_outside_modules(scene);
  const SceneKeys keys;
  Study study{.file = file,
              .title = section.has("title") ? section.text("title")
                                            : std::filesystem::path(file).stem().string(),
              .scene = scene,
              .common = section.has("set") ? keys.read(section.tree("set")) : Overrides{},
              .axes = {},
              .skipped = {},
              .error = {},
              .cost_of = section.word("cost.of"),
              .cpu_cost = section.word("cost.time") == "cpu",
              .compared = {},
              .accuracies = {},
              .repetitions = section.integer("repetitions"),
              .repeat_up_to = section.number("repeat_up_to"),
              .section = section};
  for (std::size_t i = 0; i < section.count("axes"); ++i) {
    study.axes.push_back(read_axis(section.at(fmt::format("axes[{}]", i)), keys));
  }
  if (study.axes.empty()) section.fail("", "no axes", "a list 'axes' of what is varied");
  study.skipped = read_skipped(study);
  study.error = read_error(section.at("error"), keys, study.axes);
  if (section.has("accuracies")) study.accuracies = section.numbers("accuracies");
  std::ranges::sort(study.accuracies, std::greater());
  study.compared = section.has("compare") ? section.text("compare") : study.axes.front().name;
  const auto names = names_of(study.axes);
  if (std::ranges::count(names, study.compared) == 0)
    section.fail_unknown("compare", study.compared, names);
  if (section.has("budget.each")) study.budget_each = section.number("budget.each");
  if (section.has("budget.total")) study.budget_total = section.number("budget.total");
  return study;
}

}  // namespace perifrac
