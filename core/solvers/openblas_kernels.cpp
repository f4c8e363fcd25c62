#include "core/solvers/openblas_kernels.hpp"

#include <cblas.h>
#include <cstdlib>
#include <string_view>

// What OpenBLAS calls as it is loaded and unloaded; not in every build of it.
extern "C" {
[[gnu::weak]] void gotoblas_dynamic_init();
[[gnu::weak]] void gotoblas_dynamic_quit();
}

namespace perifrac {
namespace {

/// OpenBLAS's name for the best kernels that this processor runs; none if they are the oldest.
const char* best_kernels() {
#if defined(__x86_64__)
  if (__builtin_cpu_supports("avx512f") && __builtin_cpu_supports("avx512dq") &&
      __builtin_cpu_supports("avx512bw") && __builtin_cpu_supports("avx512vl"))
    return "SkylakeX";
  if (__builtin_cpu_supports("avx2") && __builtin_cpu_supports("fma")) return "Haswell";
#endif
  return nullptr;
}

/// False where OpenBLAS keeps those that it took.
bool choose() {
  constexpr const char* variable = "OPENBLAS_CORETYPE";
  if (gotoblas_dynamic_init == nullptr || gotoblas_dynamic_quit == nullptr) return false;
  if (std::string_view(openblas_get_corename()) != "Prescott") return false;  // its last resort
  const char* const best = best_kernels();
  if (best == nullptr || ::getenv(variable) != nullptr) return false;
  ::setenv(variable, best, 1);
  gotoblas_dynamic_quit();
  gotoblas_dynamic_init();
  ::unsetenv(variable);
  return true;
}

}  // namespace

void choose_openblas_kernels() { [[maybe_unused]] static const bool chosen = choose(); }

}  // namespace perifrac
