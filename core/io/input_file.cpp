#include "core/io/input_file.hpp"

#include <algorithm>
#include <cerrno>
#include <cstring>
#include <fcntl.h>
#include <sys/stat.h>
#include <unistd.h>

#include <fmt/format.h>

#include "core/base/errors.hpp"
#include "core/base/names.hpp"

namespace perifrac {
namespace {

constexpr std::size_t largest_text = 64 << 20;  // [bytes]

/// What is in the place of a file; null where it is one.
const char* kind_of(mode_t mode) {
  if (S_ISREG(mode)) return nullptr;
  if (S_ISDIR(mode)) return "Is a directory";
  return S_ISFIFO(mode) ? "it is a pipe" : "it is a device";
}

}  // namespace

InputFile::InputFile(const std::filesystem::path& path, std::string_view expected)
    : shown_(path.string()), expected_(expected), file_(path, O_RDONLY | O_NONBLOCK) {
  if (!file_.is_open()) {
    const int why = errno;
    if (why == ENAMETOOLONG) shown_ = printable(shown_);
    refuse(why == ENXIO ? "it is a socket" : std::strerror(why));  // or a device that is not there
  }
  struct stat status {};
  if (::fstat(file_.get(), &status) != 0) refuse(std::strerror(errno));
  if (const char* const other = kind_of(status.st_mode)) refuse(other);
  size_ = static_cast<std::size_t>(status.st_size);
}

void InputFile::refuse(std::string_view problem) const {
  throw InputError(fmt::format("{}: cannot be read ({}); expected {}", shown_, problem, expected_));
}

std::string InputFile::read(std::size_t most) {
  constexpr std::size_t piece = 1 << 16;
  std::string content;
  for (;;) {
    const std::size_t before = content.size();
    const std::size_t wanted = std::min(most - before, std::max(piece, before));
    if (wanted == 0) return content;
    content.resize(before + wanted);
    const ssize_t came = ::read(file_.get(), content.data() + before, wanted);
    content.resize(before + static_cast<std::size_t>(std::max<ssize_t>(came, 0)));
    if (came < 0 && errno != EINTR) refuse(std::strerror(errno));
    if (came == 0) return content;
  }
}

std::string read_input_text(const std::filesystem::path& path, std::string_view expected) {
  InputFile file(path, expected);
  std::string text = file.read(largest_text + 1);
  if (text.size() > largest_text) {
    throw InputError(fmt::format("{}: cannot be read (it is larger than {} MB); expected {}",
                                 path.string(), largest_text >> 20, expected));
  }
  return text;
}

}  // namespace perifrac
