#include "core/config/reference_page.hpp"

#include <algorithm>

#include <fmt/format.h>
#include <fmt/ranges.h>

namespace perifrac {
namespace {

std::string kind_name(KeyType type) {
  switch (type) {
    case KeyType::number:
      return "number";
    case KeyType::integer:
      return "integer";
    case KeyType::boolean:
      return "boolean";
    case KeyType::word:
      return "word";
    case KeyType::text:
      return "text";
    case KeyType::vector:
      return "vector";
    case KeyType::numbers:
      return "numbers";
    case KeyType::tree:
      return "list or map";
  }
  return {};
}

/// The catalogue with the entries of one section side by side.
std::vector<SectionKeys> grouped(const Catalogue& catalogue) {
  std::vector<SectionKeys> entries;
  for (const SectionKeys& entry : catalogue) {
    const auto last = std::find_if(entries.rbegin(), entries.rend(), [&](const SectionKeys& other) {
      return other.section == entry.section;
    });
    entries.insert(last == entries.rend() ? entries.end() : last.base(), entry);
  }
  return entries;
}

std::string code(const std::string& text) { return text.empty() ? "" : fmt::format("`{}`", text); }

/// A cell of a Markdown table: a bare `|` would end it.
std::string cell(const std::string& text) {
  std::string escaped;
  for (const char c : text) {
    if (c == '|') escaped += '\\';
    escaped += c;
  }
  return escaped;
}

std::string table_row(const KeyReference& key) {
  const std::string value =
      key.words.empty() ? key.kind : fmt::format("`{}`", fmt::join(key.words, "`, `"));
  std::string meaning = key.meaning;
  if (!key.when.empty()) meaning += fmt::format(" Only where {}.", code(key.when));
  return fmt::format("| {} | {} | {} | {} | {} | {} |\n", cell(code(key.path)), cell(value),
                     cell(code(key.unit)), cell(code(key.range)),
                     key.required ? "required" : cell(code(key.fallback)), cell(meaning));
}

}  // namespace

std::vector<KeyReference> list_keys(const Catalogue& catalogue) {
  std::vector<KeyReference> keys;
  for (const SectionKeys& entry : grouped(catalogue)) {
    for (const Key& key : entry.keys) {
      keys.push_back({entry.section, entry.type, key.path, kind_name(key.type), key.words, key.unit,
                      key.range, key.fallback, key.required, key.when, key.meaning});
    }
  }
  return keys;
}

std::string reference_page(const Catalogue& catalogue) {
  std::string page =
      "# Configuration reference\n\n"
      "Written by `perifrac list --page` from the tables that the reader itself uses.\n"
      "A quantity may carry a unit (`0.21 MPa`); a bare number is in the unit given here. "
      "`N/m|N` means the first in 2D, the second in 3D. In a key, `*` stands for a name of your "
      "choice and `[]` for the items of a list.\n";
  return page + reference_tables(catalogue);
}

std::string reference_tables(const Catalogue& catalogue) {
  std::string page;
  for (const SectionKeys& entry : grouped(catalogue)) {
    const std::string title = entry.section.empty() ? "Top level" : code(entry.section);
    page += fmt::format("\n## {}{}\n\n", title,
                        entry.type.empty() ? "" : fmt::format(" with `type: {}`", entry.type));
    if (!entry.meaning.empty()) page += entry.meaning + "\n\n";
    if (entry.keys.empty()) {
      page += "No further keys.\n";
      continue;
    }
    page += "| key | value | unit | range | default | meaning |\n|---|---|---|---|---|---|\n";
    for (const KeyReference& key : list_keys({entry})) page += table_row(key);
  }
  return page;
}

}  // namespace perifrac
