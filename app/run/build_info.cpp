#include "app/run/build_info.hpp"

#include <fstream>
#include <string>
#include <unistd.h>

#include <fmt/format.h>
#include <nlohmann/json.hpp>
#include <omp.h>

#include "core/base/packet.hpp"
#include "core/solvers/sparse_cholesky.hpp"

namespace perifrac {

namespace {

std::string processor() {
  std::ifstream file("/proc/cpuinfo");
  for (std::string line; std::getline(file, line);) {
    if (const auto colon = line.find(": "); line.starts_with("model name") && colon != line.npos) {
      return line.substr(colon + 2);
    }
  }
  return "unknown";
}

std::string host() {
  char name[256] = {};
  return gethostname(name, sizeof name - 1) == 0 ? name : "unknown";
}

}  // namespace

std::string instruction_set() {
#if defined(__AVX512F__)
  constexpr const char* name = "AVX-512";
#elif defined(__AVX2__)
  constexpr const char* name = "AVX2";
#elif defined(__AVX__)
  constexpr const char* name = "AVX";
#elif defined(__SSE2__)
  constexpr const char* name = "SSE2";
#else
  constexpr const char* name = "plain";
#endif
  return fmt::format("{}, {} numbers at once", name, packet_size);
}

nlohmann::json build_info() {
  return {{"sparse factor", SparseCholesky::backend()},
          {"instructions", instruction_set()},
          {"compiler", __VERSION__},
          {"type", PERIFRAC_BUILD_TYPE},
          {"flags", PERIFRAC_FLAGS},
          {"commit", PERIFRAC_COMMIT}};
}

nlohmann::json machine_info() {
  const double memory =
      static_cast<double>(sysconf(_SC_PHYS_PAGES)) * static_cast<double>(sysconf(_SC_PAGESIZE));
  return {{"host", host()},
          {"processor", processor()},
          {"cores", omp_get_num_procs()},
          {"memory", memory}};
}

}  // namespace perifrac
