#pragma once

#include <cstdint>
#include <filesystem>
#include <fstream>
#include <span>
#include <string>
#include <unistd.h>

namespace perifrac {

/// A file in memory, in a folder of this process, that every input is written to in turn.
class ScratchFile {
 public:
  explicit ScratchFile(const std::string& name)
      : folder_("/dev/shm/perifrac_fuzz_" + std::to_string(::getpid())), file_(folder_ / name) {
    std::filesystem::create_directories(folder_);
  }
  ~ScratchFile() { std::filesystem::remove_all(folder_); }
  ScratchFile(const ScratchFile&) = delete;
  ScratchFile& operator=(const ScratchFile&) = delete;

  std::string hold(std::span<const std::uint8_t> bytes) const {
    std::ofstream(file_, std::ios::binary)
        .write(reinterpret_cast<const char*>(bytes.data()),
               static_cast<std::streamsize>(bytes.size()));
    return file_.string();
  }

 private:
  std::filesystem::path folder_;
  std::filesystem::path file_;
};

}  // namespace perifrac
