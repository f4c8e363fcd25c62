#pragma once

#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "app/study/evaluation.hpp"

namespace perifrac {

/// Values of some axes: (axis, value).
using Choice = std::vector<std::pair<std::string, std::string>>;

/// Who reaches an accuracy at which cost. Numbers are places among the points.
struct CheapestFor {
  double accuracy;
  std::vector<std::size_t> reaching;  ///< the cheapest first
  /// By value of the compared axis, in its order; nothing where none of them reaches it.
  std::vector<std::pair<std::string, std::optional<std::size_t>>> by_value;
};

/// Variants that solve the same problem, and so may be ranked.
struct Ranking {
  Choice problem;
  std::vector<std::size_t> ranked;  ///< those with an error
  std::vector<std::size_t> front;
  std::vector<CheapestFor> cheapest;
};

/// How error and cost follow an axis of numbers, all else equal.
struct ObservedOrder {
  std::string axis;
  Choice others;
  std::vector<std::size_t> points;  ///< by rising number
  std::vector<double> numbers;
  std::optional<double> error;  ///< power of the number
  std::optional<double> cost;
};

/// Where on an axis of numbers two values of another axis cost the same.
struct CostCrossing {
  std::string axis;
  std::string compared;
  std::pair<std::string, std::string> values;
  Choice others;
  std::vector<double> places;
};

struct StudyResults {
  std::vector<StudyPoint> points;
  std::vector<Ranking> rankings;
  std::vector<ObservedOrder> orders;
  std::vector<CostCrossing> crossings;
};

StudyResults conclude(const Study& study, std::vector<StudyPoint> points);

/// `a 1, b 2`; empty for none.
std::string text_of(const Choice& choice);

}  // namespace perifrac
