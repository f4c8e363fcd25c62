#pragma once

#include <string>

#include <CLI/App.hpp>

namespace perifrac {

/// The page of the manual about a command line, in roff.
std::string man_page(const CLI::App& app);

/// A script by which a shell (`bash`, `zsh` or `fish`) completes the command line: verbs, options,
/// keys of scenes, names of examples and kinds of scenes.
std::string completion_script(const CLI::App& app, const std::string& shell);

}  // namespace perifrac
