#pragma once

#include <cstdint>
#include <filesystem>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "core/base/point_set.hpp"

namespace perifrac {

/// A quantity to be shown on points: components * points values, component by component.
struct FrameField {
  std::string name;
  std::string unit;
  int components = 1;
  std::span<const double> values;
};

/// What points stand for. It lies beside VTK's own groups, in `geometry`, for who shows points as
/// the cells and facets that they are.
struct FrameGeometry {
  std::vector<double> volume{};        ///< [m^D] of every point, or one of all; empty: unknown
  std::vector<std::uint8_t> region{};  ///< of every point: 1 + place in `regions`; 0: in none
  std::vector<std::string> regions{};  ///< names
  std::vector<double> corners{};       ///< of every facet, going round [m], three coordinates
  std::size_t corners_a_facet = 0;
};

/// The frames of one point set, one file a time (VTKHDF 1.0, an UnstructuredGrid of vertices), and
/// the list of their times that ParaView opens: DIR/frames/NAME_000000.hdf, ... and
/// DIR/frames/NAME.hdf.series. At any moment the list names whole files only.
class FrameSeries {
 public:
  /// Starts a new list; with a `restart_time` [s], goes on after the frames up to that time that
  /// are there, and removes the later ones. Throws OutputError, and InputError where the list that
  /// is there cannot be understood.
  FrameSeries(const std::filesystem::path& output_folder, std::string point_set,
              std::optional<double> restart_time = {});

  /// Writes the frame of `time` [s]. In 2D the third coordinate, and the third component of a
  /// vector, is 0. The number of points may change between frames. Throws OutputError.
  void write(double time, const PointSet& points, std::span<const FrameField> fields,
             const FrameGeometry& geometry = {});

  /// Throws OutputError where a frame of the list is not there any more.
  void check_kept() const;

 private:
  struct Frame {
    std::string file;
    double time;
  };

  std::filesystem::path series_file() const;
  void cut_back(double restart_time);
  void read_series();
  void write_series() const;

  std::filesystem::path folder_;
  std::string point_set_;
  std::vector<Frame> frames_;
};

}  // namespace perifrac
