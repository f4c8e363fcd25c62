#include "core/geometry/cloud_points.hpp"

#include <algorithm>
#include <cmath>
#include <numeric>

#include <fmt/format.h>

#include "core/base/errors.hpp"
#include "core/geometry/cloud_file.hpp"
#include "core/geometry/space_filling_curve.hpp"
#include "core/geometry/voronoi.hpp"

namespace perifrac {

namespace {

/// A point on a face would coincide with its own mirror image.
template <int D>
void refuse_points_outside(const CloudFile<D>& file, const std::string& path,
                           const CloudPoints<D>& cloud) {
  for (Index i = 0; i < file.points.size(); ++i) {
    for (int a = 0; a < D; ++a) {
      const double x = file.points.position[a][i];
      if (x > cloud.low[a] && x < cloud.high[a]) continue;
      throw InputError(
          fmt::format("{}:{}: {} = {:g} m is outside of the body; expected a place "
                      "between {:g} and {:g} m, faces excluded",
                      path, file.line[i], "xyz"[a], x, cloud.low[a], cloud.high[a]));
    }
  }
}

template <int D>
void refuse_duplicates(const CloudFile<D>& file, const std::string& path) {
  std::vector<Index> order(file.line.size());
  std::iota(order.begin(), order.end(), 0);
  std::ranges::stable_sort(order, {}, [&](Index i) { return file.points.at(i); });
  for (std::size_t k = 1; k < order.size(); ++k) {
    if (file.points.at(order[k]) != file.points.at(order[k - 1])) continue;
    throw InputError(fmt::format("{}:{}: the point of line {} again; expected points that differ",
                                 path, file.line[order[k]], file.line[order[k - 1]]));
  }
}

}  // namespace

KeyTable cloud_keys() {
  return {
      {.path = "file",
       .type = KeyType::text,
       .required = true,
       .when = "shape=points",
       .meaning = "File of the points, beside the scene: `.vtk` (legacy, ASCII), or columns under "
                  "a first line `x,y[,z][,volume]`, in SI."},
      {.path = "from",
       .type = KeyType::vector,
       .unit = "m",
       .when = "shape=box|points",
       .meaning = "Lowest corner of the box; left out: the origin."},
      {.path = "spacing",
       .unit = "m",
       .range = "(0, inf)",
       .when = "shape=points",
       .meaning = "Distance between neighbouring points; left out: that of a lattice with as many "
                  "points."},
      {.path = "volumes",
       .type = KeyType::word,
       .words = {"file", "voronoi"},
       .when = "shape=points",
       .meaning = "Volumes of the points: those of the file, or of their Voronoi cells within the "
                  "box. Left out: the file's, if it has any."},
  };
}

template <int D>
CloudPoints<D> read_cloud_points(const Section& section) {
  const std::string path = section.file("file");
  CloudFile<D> file = read_cloud<D>(path);
  CloudPoints<D> cloud;
  const std::vector<double> size = section.numbers("size");
  cloud.low.fill(0.0);
  if (section.has("from")) std::ranges::copy(section.numbers("from"), cloud.low.begin());
  double box = 1.0;
  for (int a = 0; a < D; ++a) {
    cloud.high[a] = cloud.low[a] + size[a];
    box *= size[a];
  }
  refuse_points_outside(file, path, cloud);
  refuse_duplicates(file, path);
  cloud.spacing = section.has("spacing") ? section.number("spacing")
                                         : std::pow(box / file.points.size(), 1.0 / D);
  const bool from_file =
      section.has("volumes") ? section.word("volumes") == "file" : file.has_volumes;
  if (from_file && !file.has_volumes) {
    section.fail("volumes", "the file has no column 'volume'", "volumes: voronoi");
  }
  if (from_file) {
    const double sum = std::reduce(file.points.volume.begin(), file.points.volume.end());
    if (std::abs(sum / box - 1.0) > 0.01) {
      section.fail("file", fmt::format("its volumes add up to {:g} m^{}", sum, D),
                   fmt::format("those of the box, {:g} m^{}", box, D));
    }
  } else {
    set_voronoi_volumes<D>(file.points, cloud.low, cloud.high, cloud.spacing);
  }
  cloud.points = std::move(file.points);
  sort_along_curve(cloud.points, cloud.spacing);
  return cloud;
}

template CloudPoints<2> read_cloud_points<2>(const Section&);
template CloudPoints<3> read_cloud_points<3>(const Section&);

}  // namespace perifrac
