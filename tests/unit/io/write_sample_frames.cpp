// Writes the frames that frames_in_vtk.py reads back: write_sample_frames DIR

#include <cmath>

#include "core/io/frames.hpp"

using namespace perifrac;

namespace {

/// `count` points; every number in the frame follows from the point's index, as in the script.
void write_set(const char* folder, const char* name, int dimension, std::size_t count) {
  std::vector<double> position[3];
  std::vector<double> pressure;
  for (std::size_t i = 0; i < count; ++i) {
    for (int axis = 0; axis < dimension; ++axis) {
      position[axis].push_back(static_cast<double>(i) + 0.25 * axis);
    }
    pressure.push_back(1.0 / (1.0 + static_cast<double>(i)));
  }
  std::vector<double> velocity;  // component by component
  for (int axis = 0; axis < dimension; ++axis) {
    for (std::size_t i = 0; i < count; ++i) {
      velocity.push_back(std::sqrt(static_cast<double>(i)) - axis);
    }
  }
  const PointSet points{.name = name,
                        .dimension = dimension,
                        .position = {position[0], position[1], position[2]},
                        .count = count};
  const std::vector<FrameField> fields{{"pressure", "Pa", 1, pressure},
                                       {"velocity", "m/s", dimension, velocity}};
  FrameSeries series(folder, name);
  series.write(0.0, points, fields);
  series.write(0.125, points, fields);
}

}  // namespace

int main(int, char** arguments) {
  write_set(arguments[1], "solid", 2, 5);
  write_set(arguments[1], "fluid", 3, 300);
  write_set(arguments[1], "empty", 2, 0);
}
