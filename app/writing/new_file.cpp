#include "app/writing/new_file.hpp"

#include <cerrno>
#include <cstdio>
#include <cstring>
#include <memory>

#include "core/base/errors.hpp"

namespace perifrac {

void write_new_file(const std::filesystem::path& path, const std::string& text) {
  const std::unique_ptr<std::FILE, int (*)(std::FILE*)> file(std::fopen(path.c_str(), "wxe"),
                                                             &std::fclose);
  if (!file) throw OutputError(path.string(), std::strerror(errno));
  if (std::fputs(text.c_str(), file.get()) < 0 || std::fflush(file.get()) != 0) {
    throw OutputError(path.string(), std::strerror(errno));
  }
}

}  // namespace perifrac
