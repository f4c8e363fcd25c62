#pragma once

#include <cstddef>
#include <filesystem>
#include <string>
#include <string_view>

#include "core/io/file_descriptor.hpp"

namespace perifrac {

/// A file that we are given to read. Only a plain file will do: a pipe may wait for ever, and a
/// device has no end. What cannot be used throws InputError `PATH: problem; expected EXPECTED`.
class InputFile {
 public:
  InputFile(const std::filesystem::path& path, std::string_view expected);

  std::size_t size() const { return size_; }  ///< [bytes]

  /// What is left of it, or as many bytes as `most`.
  std::string read(std::size_t most);

 private:
  [[noreturn]] void refuse(std::string_view problem) const;

  std::string shown_;  ///< the path, for messages
  std::string expected_;
  FileDescriptor file_;
  std::size_t size_ = 0;
};

/// All of a file that is no larger than a scene can be of use.
std::string read_input_text(const std::filesystem::path& path, std::string_view expected);

}  // namespace perifrac
