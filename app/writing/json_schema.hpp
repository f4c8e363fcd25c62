#pragma once

#include <string>

#include <nlohmann/json.hpp>

#include "core/config/catalogue.hpp"

namespace perifrac {

/// JSON Schema (draft 7) of the files that a catalogue allows: names, kinds, words, ranges of bare
/// numbers, what holds only beside what, what must be there, with meanings and units for whoever
/// writes. Left to the reader: whether a unit fits, ranges of quantities with units, how many
/// components the scene's dimension asks for, names that differ, geometry.
nlohmann::ordered_json json_schema(const Catalogue& catalogue);

/// That of scenes, as `perifrac schema` prints it and configs/perifrac.schema.json holds it.
std::string json_schema_of_scenes();

}  // namespace perifrac
