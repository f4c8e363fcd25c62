#include "core/io/output_folder.hpp"

#include <cstdlib>
#include <signal.h>
#include <sys/wait.h>
#include <unistd.h>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "core/base/errors.hpp"
#include "tests/unit/io/temporary_folder.hpp"

namespace perifrac {
namespace {

using testing::AllOf;
using testing::ElementsAre;
using testing::HasSubstr;
using testing::Not;
using testing::ThrowsMessage;

void expect_refused(const std::filesystem::path& folder, const char* reason) {
  EXPECT_THAT([&] { OutputFolder{folder}; },
              ThrowsMessage<InputError>(AllOf(testing::StartsWith(folder.string() + ": "),
                                              HasSubstr(reason), Not(HasSubstr("\n")))));
}

TEST(OutputFolder, IsMadeWithItsParents) {
  const TemporaryFolder folder;
  const OutputFolder output(folder / "a" / "b");
  EXPECT_TRUE(std::filesystem::is_directory(folder / "a" / "b"));
  EXPECT_EQ(output.path(), folder / "a" / "b");
}

TEST(OutputFolder, IsRefusedToASecondRun) {
  const TemporaryFolder folder;
  {
    const OutputFolder first(folder.path());
    expect_refused(folder.path(), "another run is writing into it");
  }
  EXPECT_NO_THROW(OutputFolder{folder.path()});
}

TEST(OutputFolder, IsFreeAfterItsRunWasKilled) {
  const TemporaryFolder folder;
  int ready[2];
  ASSERT_EQ(pipe(ready), 0);
  const pid_t run = fork();
  if (run == 0) {
    const OutputFolder output(folder.path());
    if (write(ready[1], "x", 1) == 1) {
      pause();
    }
    _exit(1);
  }
  char x = 0;
  ASSERT_EQ(read(ready[0], &x, 1), 1);
  expect_refused(folder.path(), "another run");
  kill(run, SIGKILL);
  waitpid(run, nullptr, 0);
  EXPECT_NO_THROW(OutputFolder{folder.path()});
  close(ready[0]);
  close(ready[1]);
}

TEST(OutputFolder, IsRefusedWhereItCannotBeMade) {
  const TemporaryFolder folder;
  put(folder / "file", "");
  expect_refused(folder / "file" / "below", "Not a directory");
  expect_refused(folder / "file", "Not a directory");
  expect_refused("/proc/perifrac", "cannot be used as the output folder");
}

TEST(OutputFolder, IsRefusedWhereItIsReadOnly) {
  const TemporaryFolder folder;
  namespace fs = std::filesystem;
  fs::permissions(folder.path(), fs::perms::owner_read | fs::perms::owner_exec |
                                     fs::perms::others_read | fs::perms::others_exec);
  // The superuser may write anywhere, so be somebody else. A forked process leaves by _Exit: what
  // was allocated before the fork is the parent's to free.
  const auto refused = [&] {
    if (geteuid() == 0 && (setgid(65534) != 0 || setuid(65534) != 0)) {
      std::_Exit(3);
    }
    try {
      OutputFolder{folder.path()};
    } catch (const InputError& error) {
      std::_Exit(std::string(error.what()).find("Permission denied") != std::string::npos ? 0 : 2);
    }
    std::_Exit(1);
  };
  EXPECT_EXIT(refused(), testing::ExitedWithCode(0), "");
  EXPECT_TRUE(folder.names().empty());
  fs::permissions(folder.path(), fs::perms::owner_all);
}

TEST(OutputFolder, LosesOnlyWhatRunsWroteWhenARunStartsAnew) {
  const TemporaryFolder folder;
  std::filesystem::create_directories(folder / "frames" / "fluid_000009.hdf");  // a folder
  for (const char* name :
       {".lock", "history.csv", "summary.json", "checkpoint_000012.h5", "frames/solid_000000.hdf",
        "frames/solid.hdf.series", "frames/solid_1234567.hdf"}) {
    put(folder / name, "old");
  }
  for (const char* name : {"notes.txt", "history.csv.bak", "my_summary.json", "checkpoint_a.h5",
                           "checkpoint_1.h5.txt", "frames/picture.png", "frames/mesh.hdf"}) {
    put(folder / name, "mine");
  }
  const OutputFolder output(folder.path());
  EXPECT_EQ(output.remove_earlier_results(), 6);
  EXPECT_THAT(folder.names(),
              ElementsAre(".lock", "checkpoint_1.h5.txt", "checkpoint_a.h5", "frames",
                          "history.csv.bak", "my_summary.json", "notes.txt"));
  std::set<std::string> frames;
  for (const auto& entry : std::filesystem::directory_iterator(folder / "frames")) {
    frames.insert(entry.path().filename());
  }
  EXPECT_THAT(frames, ElementsAre("fluid_000009.hdf", "mesh.hdf", "picture.png"));
}

TEST(OutputFolder, LosesHalfWrittenFilesOfAKilledRunOnly) {
  const TemporaryFolder folder;
  std::filesystem::create_directory(folder / "frames");
  for (const char* name : {".lock", "checkpoint_000012.h5", "checkpoint_000013.h5.tmp",
                           "history.csv", "frames/solid_000003.hdf.tmp", "mine.tmp"}) {
    put(folder / name, "");
  }
  const OutputFolder output(folder.path());
  EXPECT_THAT(folder.names(),
              ElementsAre(".lock", "checkpoint_000012.h5", "frames", "history.csv", "mine.tmp"));
  EXPECT_TRUE(std::filesystem::is_empty(folder / "frames"));
}

TEST(OutputFolder, TakesFilesWithoutALockForSomebodyElses) {
  const TemporaryFolder folder;
  put(folder / "history.csv", "mine");
  EXPECT_THAT([&] { OutputFolder{folder.path()}; },
              ThrowsMessage<InputError>(testing::StartsWith((folder / "history.csv").string())));
  EXPECT_THAT(folder.names(), ElementsAre("history.csv"));
  EXPECT_NO_THROW(OutputFolder(folder.path(), Overwrite::any));
}

TEST(OutputFolder, HoldsWhateverElseThereIs) {
  const TemporaryFolder folder;
  std::filesystem::create_symlink("loop", folder / "loop");
  const OutputFolder output(folder.path());
  EXPECT_EQ(output.remove_earlier_results(), 0);
}

TEST(OutputFolder, KnowsFurtherNamesOfResults) {
  const TemporaryFolder folder;
  put(folder / "table.md", "mine");
  constexpr std::string_view names[] = {"study.csv", "table.md"};
  EXPECT_THROW(OutputFolder(folder.path(), Overwrite::own, names), InputError);
  EXPECT_NO_THROW(OutputFolder{folder.path()});
  EXPECT_NO_THROW(OutputFolder(folder.path(), Overwrite::own, names));  // a run was there now
}

}  // namespace
}  // namespace perifrac
