#include <set>

#include <fmt/format.h>
#include <fmt/ranges.h>

#include "app/command_pages.hpp"
#include "app/installation/examples.hpp"
#include "app/run/scene_keys.hpp"
#include "app/writing/new_scene.hpp"
#include "core/config/key_tree.hpp"
#include "core/config/reference_page.hpp"

namespace perifrac {

namespace {

using Words = std::vector<std::string>;

/// Of scenes, as they are written on the command line; none below a name of one's own.
Words scene_keys() {
  std::set<std::string> keys;
  for (const KeyReference& key : list_keys(scene_catalogue())) {
    std::string path = join_path(key.section, key.path);
    if (path.find('*') != std::string::npos) continue;
    for (auto at = path.find("[]"); at != std::string::npos; at = path.find("[]")) {
      path.replace(at, 2, "[0]");
    }
    keys.insert(path);
  }
  return {keys.begin(), keys.end()};
}

struct Verb {
  std::string name, description;
  std::vector<const CLI::Option*> options;  ///< those with names
};

std::vector<Verb> verbs_of(const CLI::App& app) {
  std::vector<Verb> verbs;
  for (const CLI::App* verb : app.get_subcommands({})) {
    Verb found{verb->get_name(), verb->get_description(), {}};
    for (const CLI::Option* option : verb->get_options({})) {
      if (!option->get_lnames().empty()) found.options.push_back(option);
    }
    verbs.push_back(std::move(found));
  }
  return verbs;
}

/// The word that stands for what an argument may be.
std::string values_of(const std::string& option) {
  if (option == "set") return "assignments";
  if (option == "example") return "examples";
  return "";
}

/// What stands right after a verb, where that is no file.
constexpr std::pair<const char*, const char*> arguments[] = {
    {"new", "kinds"}, {"explain", "keys"}, {"completion", "shells"}};

struct List {
  std::string name;
  Words words;
};

std::vector<List> lists() {
  Words assignments = scene_keys();
  for (std::string& key : assignments) key += '=';
  return {{"keys", scene_keys()},
          {"assignments", std::move(assignments)},
          {"examples", example_names()},
          {"kinds", scene_kinds()},
          {"shells", {"bash", "zsh", "fish"}}};
}

std::string bash(const CLI::App& app) {
  const std::vector<Verb> verbs = verbs_of(app);
  std::string text = "# Completion of perifrac by bash; written by `perifrac completion bash`.\n";
  for (const List& list : lists()) {
    text += fmt::format("_perifrac_{}='{}'\n", list.name, fmt::join(list.words, " "));
  }
  text += R"(_perifrac() {
  local cur=${COMP_WORDS[COMP_CWORD]} prev=${COMP_WORDS[COMP_CWORD-1]} verb= word words=
  for word in "${COMP_WORDS[@]:1:COMP_CWORD-1}"; do
    case $word in -*) ;; *) verb=$word; break ;; esac
  done
  case $prev in
    --set) words=$_perifrac_assignments; compopt -o nospace ;;
    --example) words=$_perifrac_examples ;;
    *) case $verb in
)";
  Words names;
  for (const Verb& verb : verbs) {
    names.push_back(verb.name);
    Words options;
    for (const CLI::Option* option : verb.options)
      options.push_back("--" + option->get_lnames()[0]);
    text += fmt::format("      {}) words='{}' ;;\n", verb.name, fmt::join(options, " "));
  }
  text +=
      fmt::format("      '') words='{} --help --version' ;;\n    esac\n", fmt::join(names, " "));
  text += "    [[ $cur == -* || -z $verb ]] || words= ;;\n  esac\n  case $prev in\n";
  for (const auto& [verb, list] : arguments) {
    text += fmt::format("    {}) [[ $cur == -* ]] || words=$_perifrac_{} ;;\n", verb, list);
  }
  text += R"(  esac
  if [[ -z $words ]]; then compopt -o default; COMPREPLY=(); return; fi
  mapfile -t COMPREPLY < <(compgen -W "$words" -- "$cur")
}
complete -F _perifrac perifrac
)";
  return text;
}

std::string replaced(const std::string& text, char what, const std::string& by) {
  std::string result;
  for (const char c : text) {
    if (c == what) {
      result += by;
    } else {
      result += c;
    }
  }
  return result;
}

std::string zsh(const CLI::App& app) {
  const std::vector<Verb> verbs = verbs_of(app);
  std::string text =
      "#compdef perifrac\n# Completion of perifrac by zsh; written by `perifrac completion zsh`.\n";
  for (const List& list : lists()) {
    text += fmt::format("_perifrac_{}() {{ compadd {}-- '{}' }}\n", list.name,
                        list.name == "assignments" ? "-S '' " : "", fmt::join(list.words, "' '"));
  }
  text += "_perifrac() {\n  local -a verbs\n  verbs=(\n";
  const auto plain = [](const std::string& words) { return replaced(words, '\'', "'\\''"); };
  for (const Verb& verb : verbs)
    text += fmt::format("    '{}:{}'\n", verb.name, plain(verb.description));
  text +=
      "  )\n  if (( CURRENT == 2 )); then _describe verb verbs; return; fi\n"
      "  local verb=$words[2]\n  shift words\n  (( CURRENT-- ))\n  case $verb in\n";
  for (const Verb& verb : verbs) {
    text += fmt::format("    {}) _arguments", verb.name);
    for (const CLI::Option* option : verb.options) {
      std::string said = plain(option->get_description());
      said = replaced(replaced(replaced(said, '[', "("), ']', ")"), ':', ";");
      text += fmt::format(" '*--{}[{}]", option->get_lnames()[0], said);
      const std::string values = values_of(option->get_lnames()[0]);
      if (option->get_type_size() > 0) {
        text += fmt::format(":{}:{}", type_of(*option),
                            values.empty() ? "_files" : "_perifrac_" + values);
      }
      text += '\'';
    }
    std::string argument = "_files";
    for (const auto& [name, list] : arguments) {
      if (verb.name == name) argument = std::string("_perifrac_") + list;
    }
    text += fmt::format(" '*:argument:{}' ;;\n", argument);
  }
  return text + "  esac\n}\n_perifrac \"$@\"\n";
}

std::string fish(const CLI::App& app) {
  const std::vector<Verb> verbs = verbs_of(app);
  std::string text = "# Completion of perifrac by fish; written by `perifrac completion fish`.\n";
  const auto plain = [](const std::string& words) { return replaced(words, '\'', "\\'"); };
  for (const List& list : lists()) {
    text += fmt::format("set -g __perifrac_{} '{}'\n", list.name, fmt::join(list.words, "' '"));
  }
  for (const Verb& verb : verbs) {
    text += fmt::format("complete -c perifrac -n __fish_use_subcommand -f -a {} -d '{}'\n",
                        verb.name, plain(verb.description));
    const std::string after = fmt::format("-n '__fish_seen_subcommand_from {}'", verb.name);
    for (const CLI::Option* option : verb.options) {
      const std::string name = option->get_lnames()[0], values = values_of(name);
      text += fmt::format("complete -c perifrac {} -l {} -d '{}'", after, name,
                          plain(option->get_description()));
      if (!values.empty())
        text += fmt::format(" -x -a '$__perifrac_{}'", values);
      else if (option->get_type_size() > 0)
        text += " -r";
      text += '\n';
    }
    for (const auto& [name, list] : arguments) {
      if (verb.name != name) continue;
      text += fmt::format("complete -c perifrac {} -f -a '$__perifrac_{}'\n", after, list);
    }
  }
  return text;
}

}  // namespace

std::string completion_script(const CLI::App& app, const std::string& shell) {
  if (shell == "bash") return bash(app);
  return shell == "zsh" ? zsh(app) : fish(app);
}

}  // namespace perifrac
