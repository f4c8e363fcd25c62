#pragma once

#include <cstddef>
#include <span>
#include <string>
#include <vector>

#include "core/base/point_set.hpp"
#include "core/module/port.hpp"

namespace perifrac {

/// Carries the values of an out-port to the points of an in-port. Which mapping suits what:
/// - on the same set and version of points, each value goes to its own point;
/// - an intensive quantity (pressure, dilatation) between two sets is mapped consistently: each
///   target point takes the value of the nearest source, so a constant stays that constant;
/// - an extensive quantity (impulse, mass) between two sets is mapped conservatively: each source
///   gives its total to the nearest target, so the sum stays;
/// - one intensive value without a place goes to every target; extensive values go to one place
///   without points as their sum.
///
/// The conservative mapping is the transpose of the consistent one from target to source. Of
/// points equally near, the one of lowest index is taken.
class Mapping {
 public:
  explicit Mapping(PortKind kind) : kind_(kind) {}

  /// Rebuilds where either set, or its version, is another than last time.
  /// Throws std::logic_error where none of these applies or the dimensions differ.
  void update(const PointSet& source, const PointSet& target);

  /// `source` and `target` hold components * count values, component by component.
  void apply(std::span<const double> source, std::span<double> target) const;

  bool is_identity() const { return identity_; }

 private:
  struct Key {
    std::string name;
    std::uint64_t version = 0;
    std::size_t count = 0;
    bool operator==(const Key&) const = default;
  };
  static Key key(const PointSet& points) { return {points.name, points.version, points.count}; }

  PortKind kind_;
  bool identity_ = true;
  Key source_;
  Key target_;
  /// Intensive: the source point that each target point reads; extensive: the target point that
  /// each source point adds to.
  std::vector<std::size_t> nearest_;
};

}  // namespace perifrac
