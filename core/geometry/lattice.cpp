#include "core/geometry/lattice.hpp"

#include <cmath>
#include <limits>
#include <numbers>
#include <numeric>

#include "core/base/small_vector.hpp"

namespace perifrac {

namespace {

template <int D, class Use>
void for_each_cell(const std::array<int, D>& counts, Use&& use) {
  std::array<int, D> cell{};
  const long total = std::accumulate(counts.begin(), counts.end(), 1L, std::multiplies<long>());
  for (long n = 0; n < total; ++n) {
    use(cell);
    for (int a = 0; a < D && ++cell[a] == counts[a]; ++a) cell[a] = 0;
  }
}

/// The cells of a ball by their numbers along the axes; what they hold is found in an octant.
template <int D>
class BallCells {
 public:
  BallCells(double radius, double spacing)
      : radius_(radius), spacing_(spacing), along_(static_cast<int>(std::ceil(radius / spacing))) {
    number_.assign(static_cast<std::size_t>(std::pow(along_, D)), -1);
    for_each([&](const Cell& cell) {
      const Vector<D> x = place(cell, 0.5);
      if (!inside(x)) return;
      number_[flat(cell)] = points_.size();
      points_.add(x, 0.0);
    });
  }

  /// The points of the octant, or of the ball, row by row.
  Points<D> points(bool octant) {
    find_volumes();
    if (octant) return std::move(points_);
    Cell counts;
    counts.fill(2 * along_);
    Points<D> all;
    for_each_cell<D>(counts, [&](const Cell& cell) {
      Cell image;
      for (int a = 0; a < D; ++a) {
        image[a] = cell[a] < along_ ? along_ - 1 - cell[a] : cell[a] - along_;
      }
      const Index point = number_[flat(image)];
      if (point < 0) return;
      Vector<D> x = points_.at(point);
      for (int a = 0; a < D; ++a) x[a] = cell[a] < along_ ? -x[a] : x[a];
      all.add(x, points_.volume[point]);
    });
    return all;
  }

 private:
  using Cell = std::array<int, D>;

  /// A point has the part of the octant that is nearest to it, found by sampling the cells that the
  /// surface cuts.
  void find_volumes() {
    constexpr int samples = 10;  // along an axis of a cell
    Cell subcells;
    subcells.fill(samples);
    for_each([&](const Cell& cell) {
      if (inside(place(cell, 1.0))) {
        points_.volume[number_[flat(cell)]] = std::pow(samples, D);
        return;
      }
      for_each_cell<D>(subcells, [&](const Cell& sub) {
        Vector<D> x;
        for (int a = 0; a < D; ++a) x[a] = (cell[a] + (sub[a] + 0.5) / samples) * spacing_;
        if (inside(x)) give_to_nearest(cell, x);
      });
    });
    const double ball = (D == 2 ? 1.0 : 4.0 / 3.0) * std::numbers::pi * std::pow(radius_, D);
    const double sum = std::accumulate(points_.volume.begin(), points_.volume.end(), 0.0);
    for (double& volume : points_.volume) volume *= ball / (1 << D) / sum;
  }

  template <class Use>
  void for_each(Use&& use) const {
    Cell counts;
    counts.fill(along_);
    for_each_cell<D>(counts, use);
  }

  std::size_t flat(const Cell& cell) const {
    std::size_t index = 0;
    for (const int c : cell) index = index * along_ + c;
    return index;
  }

  Vector<D> place(const Cell& cell, double part) const {
    Vector<D> x;
    for (int a = 0; a < D; ++a) x[a] = (cell[a] + part) * spacing_;
    return x;
  }

  bool inside(const Vector<D>& x) const { return squared_norm(x) < radius_ * radius_; }

  /// Adds a sample of a cell to the nearest points, which are its own or next to it inwards; points
  /// at the same distance share it, so that the ball keeps the symmetry of the lattice.
  void give_to_nearest(const Cell& cell, const Vector<D>& x) {
    std::array<Index, 1 << D> nearest;
    int count = 0;
    double least = std::numeric_limits<double>::infinity();
    Cell two;
    two.fill(2);
    for_each_cell<D>(two, [&](Cell inwards) {
      for (int a = 0; a < D; ++a) {
        inwards[a] = cell[a] - inwards[a];
        if (inwards[a] < 0) return;
      }
      const Index point = number_[flat(inwards)];
      if (point < 0) return;
      const double r2 = squared_norm(points_.at(point) - x);
      if (r2 > least * (1.0 + 1e-9)) return;
      if (r2 < least * (1.0 - 1e-9)) count = 0;
      least = r2;
      nearest[count++] = point;
    });
    for (int k = 0; k < count; ++k) points_.volume[nearest[k]] += 1.0 / count;
  }

  double radius_;
  double spacing_;
  int along_;                  ///< cells along an axis
  std::vector<Index> number_;  ///< point of a cell, -1 where its centre lies outside
  Points<D> points_;
};

}  // namespace

template <int D>
Points<D> box_lattice(const std::array<int, D>& counts, double spacing,
                      const std::array<int, D>& first) {
  Points<D> points;
  const double volume = std::pow(spacing, D);
  for_each_cell<D>(counts, [&](const std::array<int, D>& cell) {
    Vector<D> x;
    for (int a = 0; a < D; ++a) x[a] = (first[a] + cell[a] + 0.5) * spacing;
    points.add(x, volume);
  });
  return points;
}

template <int D>
Points<D> ball_lattice(double radius, double spacing, bool octant) {
  return BallCells<D>(radius, spacing).points(octant);
}

template Points<2> box_lattice<2>(const std::array<int, 2>&, double, const std::array<int, 2>&);
template Points<3> box_lattice<3>(const std::array<int, 3>&, double, const std::array<int, 3>&);
template Points<2> ball_lattice<2>(double, double, bool);
template Points<3> ball_lattice<3>(double, double, bool);

}  // namespace perifrac
