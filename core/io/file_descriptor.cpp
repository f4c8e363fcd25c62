#include "core/io/file_descriptor.hpp"

#include <cerrno>
#include <fcntl.h>
#include <unistd.h>

namespace perifrac {

FileDescriptor::FileDescriptor(const std::filesystem::path& file, int flags)
    : descriptor_(::open(file.c_str(), flags | O_CLOEXEC, 0644)) {}

FileDescriptor::~FileDescriptor() {
  if (is_open()) {
    ::close(descriptor_);
  }
}

bool FileDescriptor::write(std::string_view text) const {
  while (!text.empty()) {
    const ssize_t written = ::write(descriptor_, text.data(), text.size());
    if (written >= 0) {
      text.remove_prefix(static_cast<std::size_t>(written));
    } else if (errno != EINTR) {
      return false;
    }
  }
  return true;
}

bool FileDescriptor::append(std::string_view text) const {
  const off_t size = ::lseek(descriptor_, 0, SEEK_END);
  if (size < 0) return false;
  if (write(text)) return true;
  const int why = errno;
  [[maybe_unused]] const int cut = ::ftruncate(descriptor_, size);
  errno = why;
  return false;
}

bool FileDescriptor::sync() const { return ::fsync(descriptor_) == 0; }

}  // namespace perifrac
