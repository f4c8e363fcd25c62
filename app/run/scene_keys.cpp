#include "app/run/scene_keys.hpp"

#include <utility>

#include "app/references/reference_types.hpp"
#include "app/simulation/outside_modules.hpp"
#include "app/simulation/register_modules.hpp"
#include "core/body/crack_seeds.hpp"
#include "coupling/coupling_keys.hpp"
#include "modules/fluid/fluid_type.hpp"
#include "modules/solid/fracture/damage_keys.hpp"

namespace perifrac {

namespace {

KeyTable top_level_keys() {
  KeyTable keys = {
      {.path = "title", .type = KeyType::text, .meaning = "Name for reports."},
      {.path = "dimension",
       .type = KeyType::integer,
       .range = "[2, 3]",
       .required = true,
       .meaning = "2: plane strain, totals per metre of thickness. 3."},
      {.path = "gravity",
       .type = KeyType::vector,
       .unit = "m/s^2",
       .meaning = "Acceleration of gravity, for all physics; none where left out."},
  };
  const KeyTable seeds = crack_seed_keys();
  keys.insert(keys.end(), seeds.begin(), seeds.end());
  keys.push_back({.path = "modules",
                  .type = KeyType::tree,
                  .meaning = "Libraries with modules and materials from outside the program, their "
                             "paths seen from the scene's folder. Loaded with --allow-modules "
                             "alone."});
  return keys;
}

KeyTable time_keys() {
  return {{.path = "end",
           .unit = "s",
           .range = "(0, inf)",
           .required = true,
           .meaning = "Time to simulate, from 0."}};
}

KeyTable ledger_keys() {
  return {{.path = "mass_error",
           .range = "(0, inf)",
           .fallback = "1e-6",
           .meaning = "Largest error of the fluid mass over what is stored or has passed; a run "
                      "beyond it stops at the next output or restart point."}};
}

KeyTable output_keys() {
  return {
      {.path = "times",
       .type = KeyType::numbers,
       .unit = "s",
       .range = "[0, inf)",
       .meaning = "Times of frames."},
      {.path = "interval",
       .unit = "s",
       .range = "(0, inf)",
       .meaning = "Time between further frames. Start and end always get one."},
      {.path = "history_interval",
       .unit = "s",
       .range = "[0, inf)",
       .fallback = "0 s",
       .meaning = "Least time between rows of history.csv; 0: a row a window."},
      {.path = "checkpoint_interval",
       .unit = "s",
       .range = "[0, inf)",
       .fallback = "60 s",
       .meaning = "Least wall time between checkpoints, which are written with frames 10 windows "
                  "or more after the one before, and every 50 windows."},
      {.path = "probes[].name",
       .type = KeyType::text,
       .required = true,
       .meaning = "Name of the probe in history.csv."},
      {.path = "probes[].at",
       .type = KeyType::vector,
       .unit = "m",
       .required = true,
       .meaning =
           "Place of the probe. Fields are interpolated there to second order, never across a "
           "crack, a cut-out or a border of regions; history.csv says from how many points."},
      {.path = "probes[].field",
       .type = KeyType::text,
       .meaning = "Field to record; all fields where left out."},
  };
}

KeyTable reference_keys() {
  std::vector<std::string> words;
  for (const ReferenceType& type : reference_types()) words.push_back(type.name);
  return {
      {.path = "type",
       .type = KeyType::word,
       .required = true,
       .words = words,
       .meaning = "What the run is compared with: an analytic solution, or a table of numbers."},
      {.path = "file",
       .type = KeyType::text,
       .required = true,
       .when = "type=table",
       .meaning = "Columns with commas, `time [s]` first, then scalars as history.csv names "
                  "them. Lines `# KEY = VALUE` before them, in SI, say which scene they are for; "
                  "another one is not compared."}};
}

constexpr const char* body_meaning =
    "The porous rock that solid and pore flow share. A scene without them needs none.";

constexpr const char* damage_meaning =
    "How bonds break and cracks grow. A scene without it may have cracks, but none grows.";

constexpr const char* interface_meaning =
    "What free fluid and a body do to each other. Needed where a scene has both.";

}  // namespace

const Catalogue& scene_catalogue() {
  // Modules from outside come while a scene is read.
  static Catalogue catalogue;
  static std::size_t types = 0;
  if (catalogue.empty() || types != added_types()) {
    Catalogue all = {{"", "", top_level_keys()},
                     {"body", "", body_keys(), body_meaning, true},
                     {"time", "", time_keys()},
                     {"output", "", output_keys()},
                     {"coupling", "", coupling_keys()},
                     {"ledger", "", ledger_keys()},
                     {"reference", "", reference_keys()},
                     {"damage", "", damage_keys(), damage_meaning, true},
                     {"interface", "", interface_keys(), interface_meaning, true}};
    for (const ModuleType& type : module_types()) {
      all.push_back({type.section, type.name, type.keys, type.meaning});
    }
    catalogue = std::move(all);
    types = added_types();
  }
  return catalogue;
}

}  // namespace perifrac
