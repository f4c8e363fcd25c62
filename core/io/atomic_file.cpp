#include "core/io/atomic_file.hpp"

#include <algorithm>
#include <cerrno>
#include <cstdio>
#include <cstring>
#include <fcntl.h>
#include <unistd.h>

#include "core/base/errors.hpp"
#include "core/io/file_descriptor.hpp"

namespace perifrac {
namespace {

/// Returns 0 or the system's error number.
int write_and_sync(const std::filesystem::path& path,
                   std::initializer_list<std::string_view> parts) {
  const FileDescriptor file(path, O_WRONLY | O_CREAT | O_TRUNC);
  const auto write = [&](std::string_view part) { return file.write(part); };
  return file.is_open() && std::ranges::all_of(parts, write) && file.sync() ? 0 : errno;
}

int sync_folder(const std::filesystem::path& path) {
  const FileDescriptor folder(path, O_RDONLY | O_DIRECTORY);
  const bool done = folder.is_open() && folder.sync();
  return done || errno == EINVAL ? 0 : errno;  // EINVAL: a file system that cannot sync folders
}

}  // namespace

void write_atomically(const std::filesystem::path& target,
                      std::initializer_list<std::string_view> parts) {
  std::filesystem::path temporary = target;
  temporary += temporary_suffix;
  int error = write_and_sync(temporary, parts);
  if (error == 0 && std::rename(temporary.c_str(), target.c_str()) != 0) {
    error = errno;
  }
  if (error != 0) {
    ::unlink(temporary.c_str());
  } else {
    // The new name is safe only once its folder lies on the disk too.
    error = sync_folder(target.has_parent_path() ? target.parent_path() : ".");
  }
  if (error != 0) {
    throw OutputError(target.string(), std::strerror(error));
  }
}

bool replace_at_once(const std::filesystem::path& target, std::string_view content) {
  std::filesystem::path temporary = target;
  temporary += temporary_suffix;
  {
    const FileDescriptor file(temporary, O_WRONLY | O_CREAT | O_TRUNC);
    if (!file.is_open() || !file.write(content)) return false;
  }
  return std::rename(temporary.c_str(), target.c_str()) == 0;
}

}  // namespace perifrac
