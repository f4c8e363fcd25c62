#include "core/io/checkpoint.hpp"

#include <numeric>
#include <signal.h>
#include <sys/wait.h>
#include <unistd.h>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "core/base/errors.hpp"
#include "tests/unit/io/temporary_folder.hpp"

namespace perifrac {
namespace {

using testing::ElementsAre;
using testing::HasSubstr;
using testing::ThrowsMessage;

Checkpoint sample(std::int64_t step, std::size_t points = 40) {
  std::vector<double> displacement(2 * points);
  std::iota(displacement.begin(), displacement.end(), 0.1);
  return {.time = 0.1 * static_cast<double>(step),
          .step = step,
          .scene = "title: a\n",
          .version = "0.1.0",
          .state = Snapshot({{"solid/displacement", displacement},
                             {"solid/empty", std::vector<double>{}},
                             {"fluid/ids", std::vector<std::int64_t>{-1, 1LL << 60}}})};
}

TEST(Checkpoint, ReadsBackWhatWasWritten) {
  const TemporaryFolder folder;
  const Checkpoint written = sample(12);
  const auto path = write_checkpoint(folder.path(), written);
  EXPECT_EQ(path, folder / "checkpoint_000012.h5");
  const Checkpoint read = read_checkpoint(path);
  EXPECT_EQ(read.time, written.time);
  EXPECT_EQ(read.step, written.step);
  EXPECT_EQ(read.scene, written.scene);
  EXPECT_EQ(read.version, written.version);
  EXPECT_EQ(read.state.fields(), written.state.fields());
}

TEST(Checkpoint, HoldsAStateWithoutFields) {
  const TemporaryFolder folder;
  const auto path = write_checkpoint(folder.path(), Checkpoint{});
  EXPECT_TRUE(read_checkpoint(path).state.fields().empty());
}

TEST(Checkpoint, KeepsTheLastTwo) {
  const TemporaryFolder folder;
  for (const int step : {0, 5, 20, 1000000}) {
    write_checkpoint(folder.path(), sample(step));
  }
  EXPECT_THAT(folder.names(), ElementsAre("checkpoint_000020.h5", "checkpoint_1000000.h5"));
}

TEST(Checkpoint, DropsLaterOnesOfTheCourseThatARestartHasLeft) {
  const TemporaryFolder folder;
  write_checkpoint(folder.path(), sample(10));
  write_checkpoint(folder.path(), sample(20));
  write_checkpoint(folder.path(), sample(15));  // after a restart from step 10
  EXPECT_THAT(folder.names(), ElementsAre("checkpoint_000010.h5", "checkpoint_000015.h5"));
}

TEST(Checkpoint, MayBeWrittenTwiceAtOneStep) {
  const TemporaryFolder folder;
  for (const int step : {10, 20, 20}) {
    write_checkpoint(folder.path(), sample(step));
  }
  EXPECT_THAT(folder.names(), ElementsAre("checkpoint_000010.h5", "checkpoint_000020.h5"));
}

TEST(Checkpoint, TouchesNoOtherFiles) {
  const TemporaryFolder folder;
  const auto others = {"checkpoint_.h5", "checkpoint_1x.h5", "checkpoint_1.h5.bak", "mine.h5"};
  for (const char* name : others) {
    put(folder / name, "x");
  }
  for (const int step : {1, 2, 3}) {
    write_checkpoint(folder.path(), sample(step));
  }
  EXPECT_EQ(folder.names().size(), others.size() + 2);
}

TEST(Checkpoint, RefusesAFileCutShortOrWithMoreAtItsEnd) {
  const TemporaryFolder folder;
  const std::string whole = content_of(write_checkpoint(folder.path(), sample(1)));
  const auto damaged = folder / "damaged.h5";
  for (const std::size_t length :
       {std::size_t{0}, std::size_t{1}, std::size_t{100}, std::size_t{511}, std::size_t{512},
        std::size_t{513}, whole.size() / 2, whole.size() - 1}) {
    put(damaged, whole.substr(0, length));
    EXPECT_THROW(read_checkpoint(damaged), InputError) << length << " bytes";
  }
  put(damaged, whole + '\0');
  EXPECT_THROW(read_checkpoint(damaged), InputError);
  put(damaged, whole);
  EXPECT_NO_THROW(read_checkpoint(damaged));
}

TEST(Checkpoint, RefusesAFlippedBitAnywhere) {
  const TemporaryFolder folder;
  const std::string whole = content_of(write_checkpoint(folder.path(), sample(1)));
  const auto damaged = folder / "damaged.h5";
  put(damaged, whole);
  // In place: a file that is cut to nothing and written anew makes ext4 wait for the disk each
  // time.
  std::fstream file(damaged, std::ios::binary | std::ios::in | std::ios::out);
  const auto set = [&file](std::size_t byte, char value) {
    file.seekp(static_cast<std::streamoff>(byte));
    file.put(value).flush();
  };
  for (std::size_t byte = 0; byte < whole.size(); ++byte) {
    set(byte, static_cast<char>(whole[byte] ^ (1 << byte % 8)));
    ASSERT_THROW(read_checkpoint(damaged), InputError) << "in byte " << byte;
    set(byte, whole[byte]);
  }
  EXPECT_NO_THROW(read_checkpoint(damaged));
}

TEST(Checkpoint, SaysInOneLineWhatIsWrong) {
  const TemporaryFolder folder;
  const auto expect = [&](const char* name, const char* problem) {
    EXPECT_THAT([&] { read_checkpoint(folder / name); },
                ThrowsMessage<InputError>(testing::AllOf(
                    HasSubstr(folder / name), HasSubstr(problem), testing::Not(HasSubstr("\n")))));
  };
  expect("none.h5", "No such file or directory");
  put(folder / "text.h5", "title: a scene, not a checkpoint");
  expect("text.h5", "not a checkpoint");
  expect("", "Is a directory");  // a folder
  const std::string whole = content_of(write_checkpoint(folder.path(), sample(1)));
  put(folder / "cut.h5", whole.substr(0, whole.size() - 10));
  expect("cut.h5", "damaged or cut short");
}

TEST(Checkpoint, AFullDiskLeavesTheLastGoodOne) {
  const TemporaryFolder folder;
  const auto good = write_checkpoint(folder.path(), sample(1));
  const auto size = std::filesystem::file_size(good);
  for (std::uintmax_t bytes = 0; bytes < size; bytes += 499) {
    const FileSizeLimit limit(bytes);
    EXPECT_THROW(write_checkpoint(folder.path(), sample(2)), OutputError) << bytes << " bytes";
    EXPECT_THAT(folder.names(), ElementsAre("checkpoint_000001.h5"));
  }
  EXPECT_EQ(read_checkpoint(good).step, 1);
  EXPECT_EQ(read_checkpoint(write_checkpoint(folder.path(), sample(2))).step, 2);
}

TEST(Checkpoint, KillingTheWriterLeavesWholeFiles) {
  for (int round = 0; round < 12; ++round) {
    const TemporaryFolder folder;
    write_checkpoint(folder.path(), sample(0, 20000));
    const pid_t writer = fork();
    if (writer == 0) {
      for (std::int64_t step = 1;; ++step) {
        write_checkpoint(folder.path(), sample(step, 20000));
      }
    }
    usleep(static_cast<useconds_t>(1000 + 3700 * round));
    kill(writer, SIGKILL);
    waitpid(writer, nullptr, 0);
    int whole = 0;
    for (const std::string& name : folder.names()) {
      if (name.ends_with(".h5")) {
        EXPECT_NO_THROW(read_checkpoint(folder / name)) << name;
        ++whole;
      }
    }
    EXPECT_GE(whole, 1);
  }
}

}  // namespace
}  // namespace perifrac
