// The program of an installed folder: PREFIX/bin/perifrac. It becomes the build of
// PREFIX/libexec/perifrac/SET/perifrac whose instruction set is the best that this processor has,
// or the one that PERIFRAC_INSTRUCTIONS names. So it needs no library itself, and is compiled for
// the least processor.
#include <array>
#include <cerrno>
#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <filesystem>
#include <string>
#include <unistd.h>

namespace {

namespace fs = std::filesystem;

struct Set {
  const char* name;
  bool is_there;  ///< in this processor
};

/// From the best to the least.
auto instruction_sets() {
  __builtin_cpu_init();
  return std::to_array<Set>({{"x86-64-v4", __builtin_cpu_supports("x86-64-v4") != 0},
                             {"x86-64-v3", __builtin_cpu_supports("x86-64-v3") != 0},
                             {"x86-64", true}});
}

constexpr int failure = 1, usage_error = 2;

[[noreturn]] void end(int code, const std::string& words) {
  std::fprintf(stderr, "perifrac: %s\n", words.c_str());
  std::exit(code);
}

}  // namespace

int main(int, char** arguments) {
  std::error_code error;
  const fs::path prefix = fs::read_symlink("/proc/self/exe", error).parent_path().parent_path();
  if (error) end(failure, "cannot find its own folder: " + error.message());
  const char* const chosen = std::getenv("PERIFRAC_INSTRUCTIONS");
  std::string have;
  for (const Set& set : instruction_sets()) {
    const fs::path program = prefix / "libexec" / "perifrac" / set.name / "perifrac";
    std::error_code missing;
    if (!set.is_there || !fs::exists(program, missing)) continue;
    have += (have.empty() ? "" : ", ") + std::string(set.name);
    if (chosen != nullptr && std::strcmp(chosen, set.name) != 0) continue;
    ::execv(program.c_str(), arguments);
    end(failure, program.string() + ": " + std::strerror(errno));
  }
  if (have.empty()) end(failure, prefix.string() + " holds no program for this processor");
  end(usage_error,
      "PERIFRAC_INSTRUCTIONS: '" + std::string(chosen) +
          "' is not what this machine and this package have; expected one of: " + have);
}
