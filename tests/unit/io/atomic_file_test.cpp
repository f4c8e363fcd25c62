#include "core/io/atomic_file.hpp"

#include <atomic>
#include <thread>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "core/base/errors.hpp"
#include "tests/unit/io/temporary_folder.hpp"

namespace perifrac {
namespace {

using testing::ElementsAre;
using testing::IsEmpty;

TEST(AtomicFile, WritesAndReplaces) {
  const TemporaryFolder folder;
  write_atomically(folder / "a", "first");
  EXPECT_EQ(content_of(folder / "a"), "first");
  write_atomically(folder / "a", "2");
  EXPECT_EQ(content_of(folder / "a"), "2");
  EXPECT_THAT(folder.names(), ElementsAre("a"));
}

TEST(AtomicFile, ShowsAReaderWholeFilesOnly) {
  const TemporaryFolder folder;
  const std::string contents[] = {std::string(300000, 'a'), std::string(500000, 'b')};
  write_atomically(folder / "a", contents[0]);
  std::atomic<bool> done = false;
  std::thread writer([&] {
    for (int i = 0; i < 30; ++i) {
      write_atomically(folder / "a", contents[i % 2]);
    }
    done = true;
  });
  while (!done) {
    const std::string read = content_of(folder / "a");
    EXPECT_TRUE(read == contents[0] || read == contents[1]) << read.size() << " bytes";
  }
  writer.join();
}

TEST(AtomicFile, LeavesTheOldFileWhereTheDiskIsFull) {
  const TemporaryFolder folder;
  write_atomically(folder / "a", "old");
  const FileSizeLimit limit(10);
  EXPECT_THROW(write_atomically(folder / "a", std::string(100, 'x')), OutputError);
  EXPECT_EQ(content_of(folder / "a"), "old");
  EXPECT_THAT(folder.names(), ElementsAre("a"));
}

TEST(AtomicFile, TellsWhereAndWhyItFails) {
  const TemporaryFolder folder;
  const auto gone = folder / "gone" / "a";
  EXPECT_THAT([&] { write_atomically(gone, "text"); },
              testing::ThrowsMessage<OutputError>(
                  gone.string() + ": cannot be written: No such file or directory"));
  std::filesystem::create_directory(folder / "b");
  put(folder / "b" / "inside", "");
  EXPECT_THROW(write_atomically(folder / "b", "text"), OutputError);
  EXPECT_THAT(folder.names(), ElementsAre("b"));
}

TEST(AtomicFile, WritesIntoTheCurrentFolder) {
  const TemporaryFolder folder;
  const auto before = std::filesystem::current_path();
  std::filesystem::current_path(folder.path());
  EXPECT_NO_THROW(write_atomically("a", ""));
  std::filesystem::current_path(before);
  EXPECT_THAT(content_of(folder / "a"), IsEmpty());
  EXPECT_THAT(folder.names(), ElementsAre("a"));
}

}  // namespace
}  // namespace perifrac
