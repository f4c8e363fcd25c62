#pragma once

#include <string>
#include <vector>

#include "core/config/catalogue.hpp"

namespace perifrac {

/// One key as its reader meets it, all in words.
struct KeyReference {
  std::string section;  ///< empty: the top level
  std::string type;     ///< of the section; empty: whatever its type
  std::string path;     ///< within the section
  std::string kind;     ///< `number`, `word`, ...
  std::vector<std::string> words;
  std::string unit;
  std::string range;
  std::string fallback;  ///< empty: none
  bool required;
  std::string when;  ///< as Key::when
  std::string meaning;
};

/// Every key of the catalogue, sections together and in the order of their first entry.
std::vector<KeyReference> list_keys(const Catalogue& catalogue);

/// The page `docs/configuration.md`.
std::string reference_page(const Catalogue& catalogue);

/// Its tables alone, a heading a section.
std::string reference_tables(const Catalogue& catalogue);

}  // namespace perifrac
