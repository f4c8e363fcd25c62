#pragma once

#include <filesystem>
#include <string_view>

namespace perifrac {

/// An open file of the operating system, closed at the end of its life. Failures are reported as
/// false with the reason in errno, since only the caller knows whether to blame input or output.
class FileDescriptor {
 public:
  /// As open(2); a file it creates can be read by all and written by its owner.
  FileDescriptor(const std::filesystem::path& file, int flags);
  ~FileDescriptor();
  FileDescriptor(const FileDescriptor&) = delete;
  FileDescriptor& operator=(const FileDescriptor&) = delete;

  bool is_open() const { return descriptor_ >= 0; }
  int get() const { return descriptor_; }

  /// Writes all of `text`, also where the system takes it in pieces.
  bool write(std::string_view text) const;

  /// Writes all of `text` at the end, or leaves the file as it was.
  bool append(std::string_view text) const;

  /// Returns once what was written lies on the disk.
  bool sync() const;

 private:
  int descriptor_;
};

}  // namespace perifrac
