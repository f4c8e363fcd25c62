#include "app/run/profile_report.hpp"

#include <algorithm>
#include <map>

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include "app/run/array_list.hpp"
#include "app/run/build_info.hpp"
#include "app/run/memory.hpp"

namespace perifrac {

namespace {

using SortedJson = nlohmann::json;

/// Each part with all that lies within it.
std::vector<Profile::Part> with_parts_within(std::vector<Profile::Part> parts) {
  for (std::size_t k = parts.size(); k-- > 1;) {  // a part comes after the one around it
    Profile::Part& around = parts[parts[k].within];
    around.seconds += parts[k].seconds;
    around.cpu_seconds += parts[k].cpu_seconds;
    around.bytes += parts[k].bytes;
  }
  return parts;
}

/// Bytes of evolving fields by the first word of their names: the modules', `coupling`.
std::map<std::string, std::size_t> field_bytes(const Simulation& simulation) {
  ArrayList list;
  simulation.manager->visit_state(list);
  std::map<std::string, std::size_t> bytes;
  for (const SortedJson& array : list.arrays) {
    const std::string name = array["name"];
    bytes[name.substr(0, name.find('/'))] += array["bytes"].get<std::size_t>();
  }
  return bytes;
}

double share_of(double part, double whole) { return whole > 0.0 ? part / whole : 0.0; }

/// The parts within one, in the order in which they were met.
SortedJson parts_json(const std::vector<Profile::Part>& parts, int within) {
  SortedJson result = SortedJson::array();
  for (std::size_t k = 1; k < parts.size(); ++k) {
    const Profile::Part& part = parts[k];
    if (part.within != within) continue;
    SortedJson json = {{"name", part.name},
                       {"calls", part.calls},
                       {"seconds", part.seconds},
                       {"share", share_of(part.seconds, parts[0].seconds)},
                       {"cpu_seconds", part.cpu_seconds},
                       {"heap_bytes", part.bytes}};
    SortedJson inner = parts_json(parts, static_cast<int>(k));
    if (!inner.empty()) json["parts"] = std::move(inner);
    result.push_back(std::move(json));
  }
  return result;
}

double sum_of(const SortedJson& parts, const char* key) {
  double sum = 0.0;
  for (const SortedJson& part : parts) sum += part[key].get<double>();
  return sum;
}

void append_rows(const SortedJson& parts, int depth, std::string& text) {
  const int indent = 2 * depth;
  for (const SortedJson& part : parts) {
    text +=
        fmt::format("  {:{}}{:<{}} {:>9} {:>10.3f} {:>10.3f} {:>6.1f} {:>10.3f}", "", indent,
                    part["name"].get<std::string>(), 32 - indent, part["calls"].get<long>(),
                    part["seconds"].get<double>(), part["cpu_seconds"].get<double>(),
                    100.0 * part["share"].get<double>(), part["heap_bytes"].get<double>() / 1e6);
    if (part.contains("field_bytes")) {
      text += fmt::format(" {:>10.3f}", part["field_bytes"].get<double>() / 1e6);
    }
    text += '\n';
    if (part.contains("parts")) append_rows(part["parts"], depth + 1, text);
  }
}

}  // namespace

SortedJson profile_json(Profile& profile, const Simulation& simulation) {
  const std::vector<Profile::Part> parts = with_parts_within(profile.parts());
  SortedJson named = parts_json(parts, 0);
  std::map<std::string, std::size_t> fields = field_bytes(simulation);
  fields["exchange"] = fields["coupling"];
  const auto set_up =
      std::ranges::find(named, "set-up", [](const SortedJson& part) { return part["name"]; });
  for (SortedJson& part : (*set_up)["parts"]) {
    const auto found = fields.find(part["name"].get<std::string>());
    if (found != fields.end() && found->second > 0) part["field_bytes"] = found->second;
  }
  const double named_seconds = sum_of(named, "seconds");
  const double held = sum_of(named, "heap_bytes");
  const auto at_start = static_cast<double>(profile.resident_at_start());
  const auto resident = static_cast<double>(resident_bytes());
  const Profile::Part& whole = parts[0];
  SortedJson loops = SortedJson::object();
  for (const ModuleSlot& slot : simulation.manager->modules()) {
    if (const std::string path = slot.module->path(); !path.empty()) loops[slot.name] = path;
  }
  return {{"seconds", whole.seconds},
          {"cpu_seconds", whole.cpu_seconds},
          {"parts", named},
          {"bond_loops", loops},
          {"instructions", instruction_set()},
          {"unaccounted",
           {{"seconds", whole.seconds - named_seconds},
            {"share", share_of(whole.seconds - named_seconds, whole.seconds)}}},
          {"memory",
           {{"at_start", at_start},
            {"parts", held},
            {"families", family_bytes(simulation.body)},
            {"resident", resident},
            {"unaccounted", resident - at_start - held},
            {"peak", peak_memory()}}}};
}

std::string profile_text(const SortedJson& profile) {
  std::string text = fmt::format("\n  {:<32} {:>9} {:>10} {:>10} {:>6} {:>10} {:>10}\n", "part",
                                 "calls", "wall [s]", "cpu [s]", "%", "heap [MB]", "fields[MB]");
  append_rows(profile["parts"], 0, text);
  const SortedJson& rest = profile["unaccounted"];
  text += fmt::format("  {:<32} {:>9} {:>10.3f} {:>10} {:>6.1f}\n", "in none of them", "",
                      rest["seconds"].get<double>(), "", 100.0 * rest["share"].get<double>());
  text +=
      fmt::format("  {:<32} {:>9} {:>10.3f} {:>10.3f} {:>6.1f}\n", "all", "",
                  profile["seconds"].get<double>(), profile["cpu_seconds"].get<double>(), 100.0);
  for (const auto& [name, path] : profile["bond_loops"].items()) {
    text += fmt::format("  bonds of {}: {}\n", name, path.get<std::string>());
  }
  text += fmt::format("  instructions: {}\n", profile["instructions"].get<std::string>());
  const SortedJson& memory = profile["memory"];
  const auto mb = [&](const char* key) { return memory[key].get<double>() / 1e6; };
  text += fmt::format(
      "  memory [MB]: {:.1f} before the scene, {:.1f} held by parts, {:.1f} by none, {:.1f} in the "
      "end; {:.1f} at most\n",
      mb("at_start"), mb("parts"), mb("unaccounted"), mb("resident"), mb("peak"));
  return text;
}

}  // namespace perifrac
