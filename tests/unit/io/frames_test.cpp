#include "core/io/frames.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include "core/base/errors.hpp"
#include "core/io/hdf5.hpp"
#include "tests/unit/io/temporary_folder.hpp"

namespace perifrac {
namespace {

using testing::ElementsAre;
using testing::Pair;
using testing::UnorderedElementsAre;

const std::vector<double> x{0.0, 1.0, 2.0};
const std::vector<double> y{5.0, 6.0, 7.0};
const PointSet points{.name = "solid", .dimension = 2, .position = {x, y}, .count = 3};

std::vector<std::pair<std::string, double>> listed(const std::filesystem::path& series) {
  std::vector<std::pair<std::string, double>> frames;
  const auto json = nlohmann::json::parse(content_of(series));
  EXPECT_EQ(json.at("file-series-version"), "1.0");
  for (const auto& entry : json.at("files")) {
    frames.emplace_back(entry.at("name"), entry.at("time"));
  }
  return frames;
}

std::set<std::string> names_in(const std::filesystem::path& folder) {
  std::set<std::string> found;
  for (const auto& entry : std::filesystem::directory_iterator(folder)) {
    found.insert(entry.path().filename());
  }
  return found;
}

TEST(Frames, InterleavesComponentsAndFillsUpToThree) {
  const TemporaryFolder folder;
  const std::vector<double> pressure{1.5, 2.5, 3.5};
  const std::vector<double> displacement{10, 11, 12, 20, 21, 22};
  const std::vector<FrameField> fields{{"pressure", "Pa", 1, pressure},
                                       {"displacement", "m", 2, displacement}};
  FrameSeries(folder.path(), "solid").write(0.25, points, fields);

  const Hdf5Reader file(folder / "frames" / "solid_000000.hdf");
  EXPECT_THAT(file.read<double>("VTKHDF/Points"), ElementsAre(0, 5, 0, 1, 6, 0, 2, 7, 0));
  EXPECT_EQ(file.read<double>("VTKHDF/PointData/pressure"), pressure);
  EXPECT_THAT(file.read<double>("VTKHDF/PointData/displacement"),
              ElementsAre(10, 20, 0, 11, 21, 0, 12, 22, 0));
  EXPECT_EQ(file.read_text_attribute("VTKHDF/PointData/pressure", "units"), "Pa");
  EXPECT_THAT(file.read<double>("VTKHDF/FieldData/TimeValue"), ElementsAre(0.25));
}

TEST(Frames, ListsEveryFrameWithItsTime) {
  const TemporaryFolder folder;
  FrameSeries solid(folder.path(), "solid");
  FrameSeries fluid(folder.path(), "fluid");
  solid.write(0.0, points, {});
  fluid.write(0.0, points, {});
  solid.write(1.0 / 3.0, points, {});
  EXPECT_THAT(listed(folder / "frames" / "solid.hdf.series"),
              ElementsAre(Pair("solid_000000.hdf", 0.0), Pair("solid_000001.hdf", 1.0 / 3.0)));
  EXPECT_THAT(listed(folder / "frames" / "fluid.hdf.series"),
              ElementsAre(Pair("fluid_000000.hdf", 0.0)));
}

TEST(Frames, AreCutBackToTheRestartTime) {
  const TemporaryFolder folder;
  const double third = 1.0 / 3.0;
  {
    FrameSeries series(folder.path(), "solid");
    for (const double time : {0.0, third, 0.5, 0.75}) {
      series.write(time, points, {});
    }
  }
  FrameSeries restarted(folder.path(), "solid", third);
  EXPECT_THAT(listed(folder / "frames" / "solid.hdf.series"),
              ElementsAre(Pair("solid_000000.hdf", 0.0), Pair("solid_000001.hdf", third)));
  EXPECT_THAT(names_in(folder / "frames"),
              UnorderedElementsAre("solid.hdf.series", "solid_000000.hdf", "solid_000001.hdf"));
  restarted.write(0.5, points, {});
  EXPECT_THAT(listed(folder / "frames" / "solid.hdf.series").back(), Pair("solid_000002.hdf", 0.5));
}

TEST(Frames, RestartRefusesAListItCannotUnderstand) {
  const TemporaryFolder folder;
  std::filesystem::create_directory(folder / "frames");
  for (const char* content : {"", "{", "[1, 2]", R"({"files": [{"name": 3, "time": "x"}]})"}) {
    put(folder / "frames" / "solid.hdf.series", content);
    EXPECT_THROW(FrameSeries(folder.path(), "solid", 1.0), InputError) << content;
    EXPECT_EQ(content_of(folder / "frames" / "solid.hdf.series"), content);
  }
}

TEST(Frames, AFullDiskLeavesTheListOfWholeFrames) {
  const TemporaryFolder folder;
  FrameSeries series(folder.path(), "solid");
  series.write(0.0, points, {});
  {
    const FileSizeLimit limit(1000);
    EXPECT_THROW(series.write(1.0, points, {}), OutputError);
  }
  EXPECT_THAT(listed(folder / "frames" / "solid.hdf.series"),
              ElementsAre(Pair("solid_000000.hdf", 0.0)));
  EXPECT_THAT(names_in(folder / "frames"),
              UnorderedElementsAre("solid.hdf.series", "solid_000000.hdf"));
}

TEST(Frames, ReportAFolderThatIsGone) {
  const TemporaryFolder folder;
  FrameSeries series(folder.path(), "solid");
  std::filesystem::remove_all(folder / "frames");
  EXPECT_THROW(series.write(1.0, points, {}), OutputError);
}

}  // namespace
}  // namespace perifrac
