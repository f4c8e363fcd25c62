#include "app/command_line.hpp"

#include <algorithm>
#include <cerrno>
#include <charconv>
#include <cstdio>
#include <cstring>
#include <filesystem>
#include <new>
#include <type_traits>

#include <CLI/CLI.hpp>
#include <fmt/format.h>
#include <fmt/ranges.h>
#include <omp.h>

#include "app/command_pages.hpp"
#include "app/info/info.hpp"
#include "app/installation/data_folder.hpp"
#include "app/installation/examples.hpp"
#include "app/list.hpp"
#include "app/report/export.hpp"
#include "app/report/report.hpp"
#include "app/report/watch.hpp"
#include "app/run/check.hpp"
#include "app/run/run.hpp"
#include "app/run/version.hpp"
#include "app/simulation/outside_modules.hpp"
#include "app/study/study.hpp"
#include "app/writing/explain.hpp"
#include "app/writing/json_schema.hpp"
#include "app/writing/new_code.hpp"
#include "app/writing/new_scene.hpp"
#include "core/base/errors.hpp"
#include "core/base/names.hpp"
#include "core/base/ranks.hpp"

namespace perifrac {

namespace {

constexpr int usage_error = 2;
constexpr int failure = 1;
constexpr const char* named_by_scene = "SCENE.png";  ///< a picture without a name

struct Request {
  RunRequest run;
  StudyRequest study;
  int threads = 0;
  std::vector<std::string> folders;
  WatchRequest watch;
  ExportRequest exported;
  bool page = false;
  double trial = 4.0;  ///< [s]
  std::string key, kind, name, new_scene;
  std::string example, file, shell, picture;
  bool arrays = false;
};

void add_allow_modules(CLI::App& verb) {
  verb.add_flag_callback("--allow-modules", allow_outside_modules,
                         "load the libraries that the scene names; their code may do all you may");
}

/// Numbers as people write them: CLI11 takes `nan` as being in any range, and 0x1 for 1.
template <class Number>
CLI::Validator decimal(Number least, Number largest) {
  const auto check = [least, largest](const std::string& text) {
    Number value{};
    const char* const end = text.data() + text.size();
    const auto [rest, error] = std::from_chars(text.data(), end, value);
    const bool is_right = error == std::errc{} && rest == end && value >= least && value <= largest;
    return is_right ? std::string()
                    : fmt::format("'{}' is no {} from {} to {}", text,
                                  std::is_integral_v<Number> ? "whole number" : "number", least,
                                  largest);
  };
  return {check, fmt::format("{} to {}", least, largest), "decimal"};
}

void add_scene_options(CLI::App& verb, Request& request) {
  CLI::Option* const scene = verb.add_option("scene", request.run.scene, "scene file (YAML)");
  verb.add_option("--example", request.example, "a scene that comes with the program, as in mandel")
      ->type_name("NAME")
      ->excludes(scene);
  verb.add_option("--set", request.run.overrides,
                  "replace a key of the scene, as in pore_flow.porosity=0.2")
      ->type_name("KEY=VALUE")
      ->expected(1)
      ->multi_option_policy(CLI::MultiOptionPolicy::TakeAll);
  verb.add_flag("--json", request.run.json, "machine-readable output");
  add_allow_modules(verb);
}

void add_overwrite(CLI::App& verb, Overwrite& overwrite) {
  verb.add_flag_callback(
      "--overwrite", [&overwrite] { overwrite = Overwrite::any; },
      "replace files that no run wrote, where they have the names of results");
}

void add_run_options(CLI::App& verb, Request& request) {
  add_scene_options(verb, request);
  verb.add_option("--output", request.run.output,
                  "folder for results; the checkpoint's, or runs/<scene>")
      ->type_name("DIR");
  add_overwrite(verb, request.run.overwrite);
  verb.add_option("--threads", request.threads, "threads; results do not depend on it")
      ->type_name("N")
      ->check(decimal(1, 1024));
  verb.add_option("--restart", request.run.restart, "checkpoint to go on from")->type_name("FILE");
  verb.add_option("--until", request.run.until, "another end than the scene's, as in '20 s'")
      ->type_name("TIME");
  verb.add_flag("--profile", request.run.profile,
                "say what time and memory every part of the run took");
  verb.add_flag("!--no-report", request.run.report, "make no picture and no page");
  verb.add_flag("--watch", request.run.watch, "serve a page on this machine to watch the run on");
}

void add_check_options(CLI::App& verb, Request& request) {
  add_scene_options(verb, request);
  verb.add_option("--trial", request.trial,
                  "try the first windows for so long, to foretell the run's time; 0: do not")
      ->type_name("SECONDS")
      ->check(decimal(0.0, 1e6));
  verb.add_flag("--arrays", request.arrays, "print links and every evolving array too");
  verb.add_option("--picture", request.picture,
                  "draw the set-up; a .png or .svg, SCENE.png where no name is given")
      ->type_name("FILE")
      ->expected(0, 1)
      ->default_str(named_by_scene);
  verb.add_option("--threads", request.threads, "threads that the run will have")
      ->type_name("N")
      ->check(decimal(1, 1024));
}

void add_study_options(CLI::App& verb, StudyRequest& study) {
  verb.add_option("study", study.file, "study file (YAML)")->required();
  verb.add_option("--output", study.output, "folder for results; runs/<study>")->type_name("DIR");
  add_overwrite(verb, study.overwrite);
  verb.add_option("--jobs", study.jobs, "variants at a time; those that run together are slower")
      ->type_name("N")
      ->check(decimal(1, 1024));
  verb.add_option("--launcher", study.launcher,
                  "words before the command of every run, as in 'srun -n1'")
      ->type_name("WORDS");
  verb.add_flag("--retry", study.retry, "run again what did not end well");
  verb.add_flag("--fresh", study.fresh, "run everything again");
  verb.add_flag("!--no-report", study.report, "make no picture and no page");
  verb.add_flag("--json", study.json, "machine-readable output");
  add_allow_modules(verb);
}

void add_report_options(CLI::App& verb, std::vector<std::string>& folders) {
  verb.add_option("folder", folders, "folder of a run; of two, a page with both side by side")
      ->required()
      ->expected(1, 2)
      ->type_name("DIR");
}

void add_watch_options(CLI::App& verb, WatchRequest& watch) {
  verb.add_option("folder", watch.folder, "folder of a run")->required()->type_name("DIR");
  verb.add_option("--port", watch.port, "of 127.0.0.1; 0: one that is free")
      ->type_name("N")
      ->check(decimal(0, 65535));
}

void add_export_options(CLI::App& verb, ExportRequest& request) {
  verb.add_option("folder", request.folder, "folder of a run")->required()->type_name("DIR");
  verb.add_option("--frame", request.frame,
                  "first, last, all, a number from 0, or the one nearest to a time, as in '5 ms'")
      ->capture_default_str();
  verb.add_option("--to", request.to,
                  "vtu: cells, facets and a state for ParaView; csv: a row a point")
      ->check(CLI::IsMember({"vtu", "csv"}))
      ->capture_default_str();
  verb.add_option("--output", request.output, "folder to write into; DIR/export")
      ->type_name("FOLDER");
}

/// Of verbs that help to write a scene.
void add_writing_verbs(CLI::App& app, Request& request) {
  CLI::App& fresh =
      *app.add_subcommand("new", "write a commented scene, a module or a material to begin with");
  fresh.add_option("kind", request.kind,
                   "what it is of; left out, they are listed; module or material: code");
  fresh.add_option("name", request.name, "of a module or material of your own, as in my_rock");
  fresh.add_option("--output", request.new_scene, "its file, KIND.yaml; of code its folder, NAME")
      ->type_name("PATH");
  CLI::App& explained = *app.add_subcommand("explain", "what is known of a key");
  explained.add_option("key", request.key, "as in pore_flow.porosity, porosity or pore_flow")
      ->required();
  app.add_subcommand("schema", "JSON Schema of scenes, for editors that complete and check");
}

/// Of verbs about files, and about the command line itself.
void add_helping_verbs(CLI::App& app, Request& request) {
  CLI::App& info = *app.add_subcommand("info", "what a file that the program wrote holds");
  info.add_option("file", request.file, "a file of a run or a study, or its folder")->required();
  info.add_flag("--json", request.run.json, "machine-readable output");
  CLI::App& completion =
      *app.add_subcommand("completion", "a script by which a shell completes the command line");
  completion.add_option("shell", request.shell, "bash, zsh or fish")
      ->required()
      ->check(CLI::IsMember({"bash", "zsh", "fish"}));
  app.add_subcommand("man", "the page of the manual, as man reads it");
}

/// The scene's file, from its name where that was given.
void find_scene(const CLI::App& app, Request& request) {
  if (!app.got_subcommand("run") && !app.got_subcommand("check")) return;
  if (!request.example.empty()) request.run.scene = example_scene(request.example);
  if (request.run.scene.empty()) {
    throw InputError("perifrac: scene is required; expected a file, or --example NAME");
  }
}

int write_new(const std::string& kind, const std::string& name, const std::string& output) {
  const std::vector<std::string> code = code_kinds();
  if (kind.empty() && output.empty()) {
    fmt::print("perifrac new KIND writes a scene:\n{}or code:\n  {} NAME\n", scene_kinds_by_line(),
               fmt::join(code, " NAME\n  "));
    return 0;
  }
  if (std::ranges::find(code, kind) != code.end()) return write_new_code(kind, name, output);
  if (name.empty()) return write_new_scene(kind, output);
  throw InputError(
      fmt::format("perifrac new: {} stands beside a scene; expected KIND alone, or {} NAME",
                  in_quotes(name), fmt::join(code, " NAME or ")));
}

int print(const std::string& text) {
  std::fputs(text.c_str(), stdout);
  return 0;
}

/// Beside whoever asks for it, as the scene is called.
std::string picture_file(const Request& request) {
  if (request.picture != named_by_scene) return request.picture;
  return std::filesystem::path(request.run.scene).stem().string() + ".png";
}

int dispatch(const CLI::App& app, const Request& request) {
  if (ranks::count() > 1 && !app.got_subcommand("run") && !app.got_subcommand("check")) {
    throw InputError(
        fmt::format("perifrac: {} processes were started; expected one, or the verbs run and "
                    "check, which alone "
                    "have a use for more",
                    ranks::count()));
  }
  if (request.threads > 0) omp_set_num_threads(request.threads);
  if (app.got_subcommand("run")) return run_scene(request.run);
  if (app.got_subcommand("check")) {
    return check_scene({.scene = request.run.scene,
                        .overrides = request.run.overrides,
                        .json = request.run.json,
                        .arrays = request.arrays,
                        .picture = picture_file(request),
                        .trial_seconds = request.trial});
  }
  if (app.got_subcommand("study")) return run_study(request.study);
  if (app.got_subcommand("report")) return make_report(request.folders, false);
  if (app.got_subcommand("watch")) return watch(request.watch);
  if (app.got_subcommand("export")) return export_frames(request.exported);
  if (app.got_subcommand("new")) return write_new(request.kind, request.name, request.new_scene);
  if (app.got_subcommand("explain")) return explain(request.key);
  if (app.got_subcommand("schema")) return print(json_schema_of_scenes());
  if (app.got_subcommand("info")) return print_info(request.file, request.run.json);
  if (app.got_subcommand("man")) return print(man_page(app));
  if (app.got_subcommand("completion")) return print(completion_script(app, request.shell));
  return request.page ? print_reference_page() : list_modules(request.run.json);
}

int parse_and_dispatch(int argc, char** argv) {
  CLI::App app{"Fluid-driven fracture in porous rock", "perifrac"};
  app.set_version_flag("--version", std::string("perifrac ") + version);
  app.require_subcommand(0, 1);  // with (1) a wrong verb would be called a missing one
  Request request;
  add_run_options(*app.add_subcommand("run", "run a scene"), request);
  add_check_options(*app.add_subcommand("check", "say what a scene calls for, and will take"),
                    request);
  add_study_options(
      *app.add_subcommand("study", "run the variants of a scene; what accuracy costs"),
      request.study);
  add_report_options(*app.add_subcommand("report", "make the picture and the page of a run"),
                     request.folders);
  add_watch_options(*app.add_subcommand("watch", "serve a page to watch a run on"), request.watch);
  add_export_options(*app.add_subcommand("export", "write frames of a run as VTU or CSV"),
                     request.exported);
  CLI::App& list = *app.add_subcommand("list", "modules and keys");
  list.add_flag("--json", request.run.json, "machine-readable output");
  list.add_flag("--page", request.page, "the reference page, in Markdown");
  add_writing_verbs(app, request);
  add_helping_verbs(app, request);
  try {
    app.parse(argc, argv);
  } catch (const CLI::ParseError& error) {
    if (error.get_exit_code() == 0) return app.exit(error);  // prints help or version
    throw InputError(std::string("perifrac: ") + error.what() + "; see perifrac --help");
  }
  if (app.get_subcommands().empty()) {
    throw InputError(
        "perifrac: a verb is missing; expected run, check, study, report, export, watch, info, "
        "list, new, "
        "explain, schema, completion or man");
  }
  find_scene(app, request);
  return dispatch(app, request);
}

}  // namespace

int run_command_line(int argc, char** argv) {
  name_own_unit_database();
  try {
    const int code = parse_and_dispatch(argc, argv);
    if (std::fflush(stdout) != 0 || std::ferror(stdout))
      throw OutputError("standard output", std::strerror(errno));
    return code;
  } catch (const InputError& error) {
    std::fprintf(stderr, "%s\n", error.what());
    return usage_error;
  } catch (const std::bad_alloc&) {
    std::fputs(
        "perifrac: out of memory; `perifrac check` says how much a run takes; what was written "
        "stays, and the last checkpoint can be gone on from\n",
        stderr);
    return failure;
  } catch (const std::exception& error) {
    std::fprintf(stderr, "perifrac: %s\n", error.what());
    return failure;
  }
}

}  // namespace perifrac
