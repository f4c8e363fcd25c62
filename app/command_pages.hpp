#pragma once

#include <string>

#include <CLI/App.hpp>

namespace perifrac {

/// What an option takes, as it was named: DIR, KEY=VALUE; without what CLI11 adds of its range.
inline std::string type_of(const CLI::Option& option) {
  const std::string name = option.get_type_name();
  return name.substr(0, name.find(':'));
}

/// The page of the manual about a command line, in roff.
std::string man_page(const CLI::App& app);

/// A script by which a shell (`bash`, `zsh` or `fish`) completes the command line: verbs, options,
/// keys of scenes, names of examples and kinds of scenes.
std::string completion_script(const CLI::App& app, const std::string& shell);

}  // namespace perifrac
