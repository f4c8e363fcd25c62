#include "core/io/hdf5.hpp"

#include <ctime>
#include <limits>
#include <numeric>
#include <stdexcept>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "core/base/errors.hpp"
#include "tests/unit/io/temporary_folder.hpp"

namespace perifrac {
namespace {

using testing::ElementsAre;
using testing::HasSubstr;
using testing::IsEmpty;
using testing::ThrowsMessage;

template <class Number>
void expect_round_trip(const std::vector<Number>& values) {
  const TemporaryFolder folder;
  Hdf5Writer out;
  out.write<Number>("deep/down/values", values);
  put(folder / "a.h5", out.bytes());
  const Hdf5Reader in(folder / "a.h5");
  EXPECT_EQ(in.read<Number>("deep/down/values"), values);
  EXPECT_EQ(in.holds_integers("deep/down/values"), std::numeric_limits<Number>::is_integer);
}

TEST(Hdf5, RoundTripsEveryType) {
  using Double = std::numeric_limits<double>;
  expect_round_trip<double>({0.1, -0.0, Double::max(), Double::denorm_min(), Double::infinity()});
  expect_round_trip<std::int64_t>({std::numeric_limits<std::int64_t>::min(), 0, 1LL << 53 | 1});
  expect_round_trip<std::int32_t>({std::numeric_limits<std::int32_t>::min(), 7});
  expect_round_trip<std::uint8_t>({0, 255});
}

TEST(Hdf5, RoundTripsAnEmptyArray) { expect_round_trip<double>({}); }

TEST(Hdf5, RoundTripsText) {
  const TemporaryFolder folder;
  const std::string scene = "title: Mandel's problem, 40 °C\n" + std::string(200000, '#');
  Hdf5Writer out;
  out.write_text("scene", scene);
  out.write_text("empty", "");
  out.write_attribute("scene", "units", "m^2");
  put(folder / "a.h5", out.bytes());
  const Hdf5Reader in(folder / "a.h5");
  EXPECT_EQ(in.read_text("scene"), scene);
  EXPECT_EQ(in.read_text("empty"), "");
  EXPECT_EQ(in.read_text_attribute("scene", "units"), "m^2");
}

TEST(Hdf5, ListsDatasetsOfAllDepths) {
  const TemporaryFolder folder;
  const std::vector<double> values{1.0};
  Hdf5Writer out;
  out.write<double>("state/solid/u", values);
  out.write<double>("state/flow", values);
  out.write<double>("other", values);
  out.create_group("nothing");
  put(folder / "a.h5", out.bytes());
  const Hdf5Reader in(folder / "a.h5");
  EXPECT_THAT(in.datasets("state"), ElementsAre("flow", "solid/u"));
  EXPECT_THAT(in.datasets("nothing"), IsEmpty());
}

TEST(Hdf5, GivesTheSameBytesForTheSameContent) {
  std::vector<double> values(1000);
  std::iota(values.begin(), values.end(), 0.5);
  const auto write = [&] {
    Hdf5Writer out;
    out.write<double>("group/values", values, 10);
    return std::string(out.bytes());
  };
  const std::string first = write();
  const timespec a_second{1, 100000000};  // dates in HDF5 have a resolution of a second
  nanosleep(&a_second, nullptr);
  EXPECT_TRUE(write() == first);
}

TEST(Hdf5, TurnsFailuresIntoExceptionsWithoutPrinting) {
  const TemporaryFolder folder;
  const std::vector<double> values{1.0};
  testing::internal::CaptureStderr();
  EXPECT_THAT([&] { Hdf5Reader(folder / "none.h5"); },
              ThrowsMessage<InputError>(HasSubstr("none.h5: cannot be read: No such file")));
  put(folder / "text.h5", "no HDF5 file");
  EXPECT_THROW(Hdf5Reader(folder / "text.h5"), InputError);
  Hdf5Writer out;
  out.write<double>("values", values);
  EXPECT_THAT([&] { out.write<double>("values", values); },
              ThrowsMessage<std::logic_error>(HasSubstr("values")));
  EXPECT_THROW(out.write_attribute("missing", "units", "m"), std::logic_error);
  put(folder / "a.h5", out.bytes());
  const Hdf5Reader in(folder / "a.h5");
  EXPECT_THROW(in.read<double>("missing"), InputError);
  EXPECT_THROW(in.read_text("missing"), InputError);
  EXPECT_THROW(in.read_text_attribute("values", "missing"), InputError);
  EXPECT_THROW(in.datasets("missing"), InputError);
  EXPECT_EQ(testing::internal::GetCapturedStderr(), "");
}

}  // namespace
}  // namespace perifrac
