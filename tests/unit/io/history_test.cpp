#include "core/io/history.hpp"

#include <array>
#include <charconv>
#include <cmath>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "core/base/errors.hpp"
#include "tests/unit/io/temporary_folder.hpp"

namespace perifrac {
namespace {

using testing::HasSubstr;
using testing::ThrowsMessage;

const std::vector<HistoryColumn> columns{{"centre.pressure", "Pa"}, {"iterations", ""}};

void append_rows(History history, int first, int last) {
  for (int step = first; step <= last; ++step) {
    history.append(0.1 * step, step, std::array{std::sqrt(step) * 1e5, 1.0 / 3.0});
  }
}

TEST(History, HasUnitsInItsHeader) {
  const TemporaryFolder folder;
  History history(folder / "history.csv", columns);
  history.append(0.5, 3, std::array{1e5, 2.0});
  EXPECT_EQ(content_of(folder / "history.csv"),
            "time [s],step,centre.pressure [Pa],iterations\n0.5,3,100000,2\n");
}

TEST(History, QuotesNamesThatHoldASeparator) {
  const TemporaryFolder folder;
  History history(folder / "history.csv", {{"a, \"b\"", "m"}});
  EXPECT_EQ(content_of(folder / "history.csv"), "time [s],step,\"a, \"\"b\"\" [m]\"\n");
}

TEST(History, PrintsNumbersThatReadBackToTheSameBits) {
  const TemporaryFolder folder;
  History history(folder / "h.csv", {{"a", ""}});
  for (const double value : {0.1, 1.0 / 3.0, 1e-308, 5e-324, 1.7976931348623157e308, -0.0}) {
    history.append(0.0, 0, std::array{value});
    const std::string table = content_of(folder / "h.csv");
    double read = 1.0;
    std::from_chars(&table[table.rfind(',') + 1], &table.back(), read);
    EXPECT_EQ(read, value);
    EXPECT_EQ(std::signbit(read), std::signbit(value));
  }
}

TEST(History, StartsAnewWithoutARestart) {
  const TemporaryFolder folder;
  append_rows(History(folder / "h.csv", columns), 0, 5);
  append_rows(History(folder / "h.csv", {{"other", "m"}}), 0, -1);
  EXPECT_EQ(content_of(folder / "h.csv"), "time [s],step,other [m]\n");
}

TEST(History, GoesOnAfterARestartAsIfThereHadBeenNone) {
  const TemporaryFolder folder;
  append_rows(History(folder / "whole.csv", columns), 0, 30);
  for (const int restart : {0, 7, 29, 30}) {
    for (const int reached : {restart, std::min(restart + 5, 30), 30}) {
      append_rows(History(folder / "h.csv", columns), 0, reached);
      append_rows(History(folder / "h.csv", columns, restart), restart + 1, 30);
      EXPECT_EQ(content_of(folder / "h.csv"), content_of(folder / "whole.csv"));
    }
  }
}

TEST(History, DropsARowThatWasCutOff) {
  const TemporaryFolder folder;
  append_rows(History(folder / "h.csv", columns), 0, 4);
  const std::string whole = content_of(folder / "h.csv");
  for (const std::string half : {"0", "0.5,", "0.5,5", "0.5,5,1.2e"}) {
    put(folder / "h.csv", whole + half);
    History history(folder / "h.csv", columns, 100);
    EXPECT_EQ(content_of(folder / "h.csv"), whole);
  }
}

TEST(History, StartsATableWhereARestartFindsNone) {
  const TemporaryFolder folder;
  History history(folder / "h.csv", columns, 100);
  EXPECT_EQ(content_of(folder / "h.csv"), "time [s],step,centre.pressure [Pa],iterations\n");
}

TEST(History, RefusesToGoOnInATableOfOtherColumns) {
  const TemporaryFolder folder;
  append_rows(History(folder / "h.csv", columns), 0, 4);
  const std::string before = content_of(folder / "h.csv");
  EXPECT_THAT(
      [&] {
        History(folder / "h.csv", {{"other", "m"}}, 3);
      },
      ThrowsMessage<InputError>(HasSubstr("h.csv: has other columns")));
  EXPECT_EQ(content_of(folder / "h.csv"), before);
}

TEST(History, ReportsAFullDisk) {
  const TemporaryFolder folder;
  History history(folder / "h.csv", columns);
  append_rows(history, 0, 0);
  const std::string before = content_of(folder / "h.csv");
  {
    const FileSizeLimit limit(before.size() + 5);
    EXPECT_THROW(append_rows(history, 1, 1), OutputError);
  }
  History restarted(folder / "h.csv", columns, 0);
  EXPECT_EQ(content_of(folder / "h.csv"), before);
}

TEST(History, ReportsAFolderThatIsGone) {
  TemporaryFolder folder;
  History history(folder / "h.csv", columns);
  std::filesystem::remove(folder / "h.csv");
  EXPECT_THROW(append_rows(history, 0, 0), OutputError);
}

}  // namespace
}  // namespace perifrac
