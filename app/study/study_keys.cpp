#include "app/study/study_keys.hpp"

namespace perifrac {

namespace {

KeyTable top_level_keys() {
  return {
      {.path = "title", .type = KeyType::text, .meaning = "Name for the page."},
      {.path = "scene",
       .type = KeyType::text,
       .required = true,
       .meaning = "Scene that all variants start from; its file is beside the study's."},
      {.path = "set",
       .type = KeyType::tree,
       .meaning = "Keys of the scene, and `threads`, and what all variants have there, as in "
                  "`{time.end: 10 s}`. A run has one thread unless told."},
      {.path = "axes[].name",
       .type = KeyType::text,
       .required = true,
       .meaning = "Name of the axis."},
      {.path = "axes[].key",
       .type = KeyType::text,
       .meaning = "Key of the scene that takes each of a list of values; also `threads`, `scene`."},
      {.path = "axes[].values",
       .type = KeyType::tree,
       .required = true,
       .meaning = "A list of values of `key`; or a map of names, each with the keys that it sets, "
                  "as in `{implicit: {}, explicit: {pore_flow.integrator.type: explicit}}`."},
      {.path = "axes[].unit",
       .type = KeyType::text,
       .meaning =
           "The names of the map are quantities in this unit (`1` if they are bare numbers)."},
      {.path = "axes[].problem",
       .type = KeyType::boolean,
       .fallback = "false",
       .meaning = "The axis is no choice but another problem: its values are not ranked among "
                  "each other."},
      {.path = "skip",
       .type = KeyType::tree,
       .meaning = "Combinations left out: a list of maps from axis to value or list of values."},
      {.path = "compare",
       .type = KeyType::text,
       .meaning = "Axis by whose values costs are compared; the first where left out."},
      {.path = "accuracies",
       .type = KeyType::numbers,
       .range = "(0, inf)",
       .meaning = "Errors for which the cheapest variant is named."},
      {.path = "repetitions",
       .type = KeyType::integer,
       .range = "[1, 1000]",
       .fallback = "1",
       .meaning = "Runs of each variant; the first of several warms up and does not count."},
      {.path = "repeat_up_to",
       .unit = "s",
       .range = "(0, inf)",
       .fallback = "10 s",
       .meaning = "A variant whose first run takes longer is not repeated: that run counts."},
  };
}

KeyTable error_keys() {
  return {
      {.path = "against",
       .type = KeyType::word,
       .required = true,
       .words = {"reference", "finer", "richardson"},
       .meaning = "The reference of the scene; a finer run, made for it; or what the variants "
                  "along an axis tend to."},
      {.path = "quantity",
       .type = KeyType::text,
       .required = true,
       .when = "against=reference",
       .meaning = "Which error, as the table or the list at the end of a run names it, such as "
                  "`pressure_error`."},
      {.path = "columns",
       .type = KeyType::tree,
       .required = true,
       .when = "against=finer|richardson",
       .meaning = "Columns of history.csv, without their unit; errors are over the largest value "
                  "of each."},
      {.path = "finer",
       .type = KeyType::tree,
       .required = true,
       .when = "against=finer",
       .meaning = "What the finer run sets beyond `set`."},
      {.path = "axis",
       .type = KeyType::text,
       .required = true,
       .when = "against=richardson",
       .meaning = "Axis of numbers; the three finest fix the order and the limit."},
      {.path = "norm",
       .type = KeyType::word,
       .fallback = "largest",
       .words = {"largest", "rms"},
       .meaning = "Over the times compared: the largest, or the root mean square."},
      {.path = "from",
       .unit = "s",
       .range = "[0, inf)",
       .fallback = "0 s",
       .meaning = "First time compared."},
      {.path = "to",
       .unit = "s",
       .range = "(0, inf)",
       .meaning = "Last time compared; else the end."},
  };
}

KeyTable cost_keys() {
  return {{.path = "of",
           .type = KeyType::word,
           .fallback = "run",
           .words = {"run", "fluid", "crack_fluid", "pore_flow", "solid"},
           .meaning = "Whose time is the cost: the whole run's, or one module's."},
          {.path = "time",
           .type = KeyType::word,
           .fallback = "wall",
           .words = {"wall", "cpu"},
           .meaning = "wall: as it passes; of the whole run without output. cpu: of all threads, "
                      "output included; for machines that do other things meanwhile."}};
}

KeyTable budget_keys() {
  return {
      {.path = "each",
       .unit = "s",
       .range = "(0, inf)",
       .meaning = "Wall time of a run beyond which it is stopped."},
      {.path = "total",
       .unit = "s",
       .range = "(0, inf)",
       .meaning = "Wall time of the study beyond which no further variant is begun."},
  };
}

}  // namespace

const Catalogue& study_catalogue() {
  static const Catalogue catalogue = {{"", "", top_level_keys()},
                                      {"error", "", error_keys()},
                                      {"cost", "", cost_keys()},
                                      {"budget", "", budget_keys()}};
  return catalogue;
}

}  // namespace perifrac
