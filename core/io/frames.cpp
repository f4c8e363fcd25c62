#include "core/io/frames.hpp"

#include <algorithm>
#include <array>
#include <numeric>

#include <fmt/format.h>
#include <fmt/ranges.h>
#include <nlohmann/json.hpp>

#include "core/base/errors.hpp"
#include "core/io/atomic_file.hpp"
#include "core/io/hdf5.hpp"
#include "core/io/input_file.hpp"

namespace perifrac {
namespace {

void write_geometry(Hdf5Writer& file, const PointSet& points) {
  constexpr std::uint8_t vtk_vertex = 1;
  const auto count = static_cast<std::int64_t>(points.count);
  const std::array one_count{count};
  file.write<std::int64_t>("VTKHDF/NumberOfPoints", one_count);
  file.write<std::int64_t>("VTKHDF/NumberOfCells", one_count);
  file.write<std::int64_t>("VTKHDF/NumberOfConnectivityIds", one_count);

  const auto axes = std::span(points.position).first(static_cast<std::size_t>(points.dimension));
  file.write_columns("VTKHDF/Points", axes, 3);

  std::vector<std::int64_t> ids(points.count + 1);
  std::iota(ids.begin(), ids.end(), 0);
  file.write<std::int64_t>("VTKHDF/Connectivity", std::span(ids).first(points.count));
  file.write<std::int64_t>("VTKHDF/Offsets", ids);
  file.write<std::uint8_t>("VTKHDF/Types", std::vector<std::uint8_t>(points.count, vtk_vertex));
}

void write_field(Hdf5Writer& file, const FrameField& field, std::size_t count) {
  const std::string name = "VTKHDF/PointData/" + field.name;
  if (field.components == 1) {
    file.write(name, field.values);
  } else {
    std::vector<std::span<const double>> components;
    for (int c = 0; c < field.components; ++c) {
      components.push_back(field.values.subspan(static_cast<std::size_t>(c) * count, count));
    }
    // A vector has three components for VTK.
    const std::size_t columns = std::max<std::size_t>(3, components.size());
    file.write_columns(name, components, columns);
  }
  file.write_attribute(name, "units", field.unit);
}

void write_what_points_are(Hdf5Writer& file, const PointSet& points,
                           const FrameGeometry& geometry) {
  file.create_group("geometry");
  const std::array dimension{static_cast<std::int64_t>(points.dimension)};
  file.write_attribute("geometry", "dimension", dimension);
  if (!geometry.volume.empty()) {
    file.write<double>("geometry/volume", geometry.volume);
    file.write_attribute("geometry/volume", "units", points.dimension == 2 ? "m^2" : "m^3");
  }
  if (!geometry.region.empty()) {
    file.write<std::uint8_t>("geometry/region", geometry.region);
    file.write_attribute("geometry/region", "names",
                         fmt::format("{}", fmt::join(geometry.regions, "\n")));
  }
  if (!geometry.corners.empty()) {
    file.write<double>("geometry/corners", geometry.corners, 3 * geometry.corners_a_facet);
    file.write_attribute("geometry/corners", "units", "m");
  }
}

void write_frame(Hdf5Writer& file, double time, const PointSet& points,
                 std::span<const FrameField> fields, const FrameGeometry& geometry) {
  write_geometry(file, points);
  const std::array version{std::int64_t{1}, std::int64_t{0}};
  file.write_attribute("VTKHDF", "Version", version);
  file.write_attribute("VTKHDF", "Type", "UnstructuredGrid");
  const std::array one_time{time};
  file.write<double>("VTKHDF/FieldData/TimeValue", one_time);
  for (const FrameField& field : fields) {
    write_field(file, field, points.count);
  }
  write_what_points_are(file, points, geometry);
}

}  // namespace

FrameSeries::FrameSeries(const std::filesystem::path& output_folder, std::string point_set,
                         std::optional<double> restart_time)
    : folder_(output_folder / "frames"), point_set_(std::move(point_set)) {
  std::error_code error;
  std::filesystem::create_directories(folder_, error);
  if (error) {
    throw OutputError(folder_.string(), error.message());
  }
  if (restart_time && std::filesystem::exists(series_file())) {
    read_series();
    cut_back(*restart_time);
  }
}

std::filesystem::path FrameSeries::series_file() const {
  return folder_ / (point_set_ + ".hdf.series");
}

void FrameSeries::cut_back(double restart_time) {
  const auto late = std::find_if(frames_.begin(), frames_.end(),
                                 [&](const Frame& frame) { return frame.time > restart_time; });
  const std::vector<Frame> dropped(late, frames_.end());
  frames_.erase(late, frames_.end());
  write_series();  // first: the list must never name a file that is gone
  for (const Frame& frame : dropped) {
    std::error_code ignored;  // a file that nobody names does no harm
    std::filesystem::remove(folder_ / frame.file, ignored);
  }
}

void FrameSeries::write(double time, const PointSet& points, std::span<const FrameField> fields,
                        const FrameGeometry& geometry) {
  const std::string name = fmt::format("{}_{:06}.hdf", point_set_, frames_.size());
  Hdf5Writer file;
  write_frame(file, time, points, fields, geometry);
  write_atomically(folder_ / name, file.bytes());
  frames_.push_back({name, time});
  write_series();
}

void FrameSeries::check_kept() const {
  for (const Frame& frame : frames_) {
    std::error_code error;
    if (!std::filesystem::is_regular_file(folder_ / frame.file, error)) {
      throw OutputError((folder_ / frame.file).string(),
                        "it was written, and is gone; other runs and tidying keep away from the "
                        "folder of a run");
    }
  }
}

void FrameSeries::read_series() {
  try {
    const auto series =
        nlohmann::json::parse(read_input_text(series_file(), "the list of frames of this run"));
    for (const auto& entry : series.at("files")) {
      frames_.push_back({entry.at("name"), entry.at("time")});
    }
  } catch (const nlohmann::json::exception&) {
    throw InputError(series_file().string() +
                     ": not a list of frames as a run writes it; expected the file of the run to "
                     "go on from; remove it to start the list anew");
  }
}

void FrameSeries::write_series() const {
  nlohmann::ordered_json series{{"file-series-version", "1.0"},
                                {"files", nlohmann::ordered_json::array()}};
  for (const Frame& frame : frames_) {
    series["files"].push_back({{"name", frame.file}, {"time", frame.time}});
  }
  write_atomically(series_file(), series.dump(1) + "\n");
}

}  // namespace perifrac
