#include "app/simulation/outside_modules.hpp"

#include <algorithm>
#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <dlfcn.h>
#include <exception>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <optional>
#include <set>

#include <fmt/format.h>

#include "app/simulation/register_modules.hpp"
#include "core/base/errors.hpp"
#include "core/base/names.hpp"
#include "core/config/override.hpp"
#include "core/config/yaml_tree.hpp"
#include "core/module/build_stamp.hpp"

namespace perifrac {

namespace {

namespace fs = std::filesystem;

bool allowed = false;

/// In two parts, so that the program itself does not hold what it looks for.
const std::string stamp_mark = std::string("perifrac-module-") + "built-as:";

/// Words of others on one line.
std::string one_line(std::string text) {
  std::ranges::replace(text, '\n', ' ');
  return text;
}

/// One library that a scene names.
class Library {
 public:
  Library(const YamlNode& node, std::size_t item, const fs::path& folder)
      : node_(node), item_(item), file_(folder / node.text) {
    // A package for several instruction sets has a library for each (perifrac_add_module).
    const fs::path own = file_.parent_path() / PERIFRAC_INSTRUCTION_SET_NAME / file_.filename();
    std::error_code missing;
    if (fs::exists(own, missing)) file_ = own;
  }

  void load() const {
    check_stamp();
    try {
      take(open());
    } catch (const InputError&) {
      throw;
    } catch (const std::exception& error) {
      fail_in_it(one_line(error.what()));
    } catch (...) {
      fail_in_it("of a kind that is no std::exception");
    }
  }

  std::string file() const {
    std::error_code missing;
    return fs::weakly_canonical(file_, missing).string();
  }

 private:
  void* open() const {
    opened = this;
    const auto before = std::set_terminate(end_in_opened);
    void* const handle = ::dlopen(fs::absolute(file_).c_str(), RTLD_NOW | RTLD_LOCAL);
    std::set_terminate(before);
    if (handle == nullptr) {
      fail(fmt::format("cannot be loaded ({})", one_line(::dlerror())),
           "a library that needs nothing but this program and what it is linked with");
    }
    return handle;
  }

  /// What a library throws while it is opened cannot pass the loader, which is C.
  [[noreturn]] static void end_in_opened() {
    std::string what = "of a kind that is no std::exception";
    try {
      if (const auto thrown = std::current_exception()) std::rethrow_exception(thrown);
    } catch (const std::exception& error) {
      what = one_line(error.what());
    } catch (...) {  // said already
    }
    try {
      opened->fail_in_it(what);
    } catch (const InputError& error) {
      fmt::print(stderr, "{}\n", error.what());
    }
    std::_Exit(2);
  }

  [[noreturn]] void fail(const std::string& problem, const std::string& expected) const {
    throw InputError(fmt::format("{}: modules[{}]: {} {}; expected {}", node_.place, item_,
                                 in_quotes(node_.text), problem, expected));
  }
  [[noreturn]] void fail_in_it(const std::string& what) const {
    fail(fmt::format("threw an exception while it was loaded: {}", what),
         "a library that loads without one");
  }

  void check_stamp() const {
    std::error_code missing;
    if (!fs::exists(file_, missing)) {
      fail(fmt::format("is not there ({})", file_.lexically_normal().string()),
           "a shared library, its path seen from the scene's folder");
    }
    std::string bytes;
    if (fs::is_regular_file(file_, missing)) {
      std::ifstream stream(file_, std::ios::binary);
      bytes.assign(std::istreambuf_iterator<char>(stream), {});
    }
    const auto mark = bytes.find(stamp_mark);
    if (mark == std::string::npos) {
      fail("is no library of modules",
           "one made by perifrac_add_module, with PERIFRAC_MODULES in a source "
           "(perifrac new module NAME)");
    }
    const std::string built_as = bytes.c_str() + mark + stamp_mark.size();
    if (built_as == PERIFRAC_STAMP) return;
    fail(fmt::format("was built as {}", in_quotes(one_line(built_as))),
         fmt::format("{}; build it anew against this program", in_quotes(PERIFRAC_STAMP)));
  }

  void take(void* handle) const {
    std::vector<ModuleType> types;
    if (const auto show = function<void(std::vector<ModuleType>&)>(handle, "perifrac_modules")) {
      show(types);
    }
    std::vector<MaterialType> materials;
    if (const auto show =
            function<void(std::vector<MaterialType>&)>(handle, "perifrac_materials")) {
      show(materials);
    }
    if (types.empty() && materials.empty()) {
      fail("shows nothing", "PERIFRAC_MODULES(...) or PERIFRAC_MATERIALS(...) in a source of it");
    }
    for (ModuleType& type : types) {
      const auto same = [&](const ModuleType& known) {
        return known.section == type.section && known.name == type.name;
      };
      if (std::ranges::any_of(module_types(), same)) fail_twice(type.section + ".type", type.name);
      add_module_type(std::move(type));
    }
    for (MaterialType& type : materials) {
      if (std::ranges::count(material_types(), type.name, &MaterialType::name) > 0) {
        fail_twice("solid.material.type", type.name);
      }
      add_material(std::move(type));
    }
  }

  [[noreturn]] void fail_twice(const std::string& key, const std::string& name) const {
    fail(fmt::format("has a '{}: {}', of which there is one already", key, name), "another name");
  }

  template <class Function>
  static Function* function(void* handle, const char* name) {
    void* const symbol = ::dlsym(handle, name);
    Function* result = nullptr;
    static_assert(sizeof symbol == sizeof result);
    std::memcpy(&result, &symbol, sizeof result);
    return result;
  }

  inline static const Library* opened = nullptr;

  const YamlNode& node_;
  std::size_t item_;
  fs::path file_;
};

/// The scene's list with what --set makes of it; whatever else is wrong, its reader says.
std::optional<YamlNode> modules_of(const std::string& path,
                                   const std::vector<std::string>& overrides) {
  YamlNode scene = parse_yaml_file(path);
  for (const std::string& assignment : overrides) {
    try {
      apply_override(scene, assignment);
    } catch (const InputError&) {  // said when the scene is read
    }
  }
  const YamlNode* const list = scene.child("modules");
  if (list == nullptr) return {};
  const bool is_list = list->kind == YamlNode::Kind::list;
  if (!is_list || list->children.empty()) {
    throw InputError(fmt::format("{}: modules: {}; expected a list of texts, as in [./libmine.so]",
                                 list->kind == YamlNode::Kind::null ? list->key_place : list->place,
                                 is_list ? "has no items" : describe_kind(*list)));
  }
  return *list;
}

}  // namespace

void allow_outside_modules() { allowed = true; }

bool outside_modules_are_allowed() { return allowed; }

void load_outside_modules(const std::string& path, const std::vector<std::string>& overrides) {
  static std::set<std::string> loaded;
  const auto list = modules_of(path, overrides);
  if (!list) return;
  if (!allowed) {
    throw InputError(fmt::format(
        "{}: modules: libraries would be loaded, whose code may do all that you may; expected "
        "--allow-modules on the command line, where you trust them",
        list->place));
  }
  for (std::size_t k = 0; k < list->children.size(); ++k) {
    const YamlNode& item = list->children[k];
    if (item.kind != YamlNode::Kind::scalar) {
      throw InputError(fmt::format("{}: modules[{}]: {}; expected a text, the path of a library",
                                   item.place, k, describe_kind(item)));
    }
    const Library library(item, k, fs::path(path).parent_path());
    if (loaded.contains(library.file())) continue;
    library.load();
    loaded.insert(library.file());
  }
}

}  // namespace perifrac
