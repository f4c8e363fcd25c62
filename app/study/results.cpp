#include "app/study/results.hpp"

#include <algorithm>
#include <functional>
#include <map>

#include "app/study/orders.hpp"

namespace perifrac {

namespace {

// Wall times nearer to each other than this factor are taken for equal.
constexpr double blur = 1.25;
// Errors below it come from rounding: they have no order.
constexpr double error_rounding = 1e-11;

class Conclusion {
 public:
  Conclusion(const Study& study, StudyResults& results) : study_(study), results_(results) {}

  void rank() {
    const auto groups = grouped([&](std::size_t a) { return study_.axes[a].problem; });
    for (const auto& [problem, members] : groups) {
      Ranking ranking{.problem = problem, .ranked = {}, .front = {}, .cheapest = {}};
      std::vector<ErrorAndCost> points;
      for (const std::size_t i : members) {
        const StudyPoint& point = results_.points[i];
        if (!point.is_ranked()) continue;
        ranking.ranked.push_back(i);
        points.push_back({*point.error.error, point.cost.median});
      }
      for (const std::size_t k : pareto_front(points)) ranking.front.push_back(ranking.ranked[k]);
      for (const double accuracy : study_.accuracies) {
        ranking.cheapest.push_back(cheapest_for(accuracy, ranking.ranked, points));
      }
      results_.rankings.push_back(std::move(ranking));
    }
  }

  void observe_orders() {
    for (std::size_t along = 0; along < study_.axes.size(); ++along) {
      if (!study_.axes[along].is_numeric()) continue;
      for (const auto& [others, members] : grouped([&](std::size_t a) { return a != along; })) {
        observe(along, others, members);
      }
    }
  }

  /// Of each pair of values of one axis along each axis of numbers.
  void find_crossings() {
    for (const ObservedOrder& one : results_.orders) {
      for (const ObservedOrder& other : results_.orders) {
        if (one.axis == other.axis && &one < &other) cross(one, other);
      }
    }
  }

 private:
  std::size_t value_of(std::size_t point, std::size_t axis) const {
    return results_.points[point].variant->choice[axis];
  }

  /// Points by their values on the axes that `of` names, in the order of the axes.
  std::vector<std::pair<Choice, std::vector<std::size_t>>> grouped(
      const std::function<bool(std::size_t)>& of) const {
    std::map<std::vector<std::size_t>, std::vector<std::size_t>> groups;
    for (std::size_t i = 0; i < results_.points.size(); ++i) {
      if (results_.points[i].variant->choice.empty()) continue;  // the finer run
      std::vector<std::size_t> key;
      for (std::size_t a = 0; a < study_.axes.size(); ++a) {
        if (of(a)) key.push_back(value_of(i, a));
      }
      groups[key].push_back(i);
    }
    std::vector<std::pair<Choice, std::vector<std::size_t>>> result;
    for (const auto& [key, members] : groups) {
      Choice choice;
      std::size_t k = 0;
      for (std::size_t a = 0; a < study_.axes.size(); ++a) {
        if (of(a)) choice.emplace_back(study_.axes[a].name, study_.axes[a].values[key[k++]].label);
      }
      result.emplace_back(choice, members);
    }
    return result;
  }

  CheapestFor cheapest_for(double accuracy, const std::vector<std::size_t>& ranked,
                           const std::vector<ErrorAndCost>& points) const {
    CheapestFor result{.accuracy = accuracy, .reaching = {}, .by_value = {}};
    for (const std::size_t k : cheapest(points, accuracy)) result.reaching.push_back(ranked[k]);
    const auto axis = static_cast<std::size_t>(
        std::ranges::find(study_.axes, study_.compared, &StudyAxis::name) - study_.axes.begin());
    for (std::size_t v = 0; v < study_.axes[axis].values.size(); ++v) {
      const bool has_any =
          std::ranges::any_of(ranked, [&](std::size_t i) { return value_of(i, axis) == v; });
      if (!has_any) continue;  // nothing to compare: what failed is told of elsewhere
      const auto first = std::ranges::find_if(
          result.reaching, [&](std::size_t i) { return value_of(i, axis) == v; });
      result.by_value.emplace_back(study_.axes[axis].values[v].label, first == result.reaching.end()
                                                                          ? std::nullopt
                                                                          : std::optional(*first));
    }
    return result;
  }

  void observe(std::size_t along, const Choice& others, std::vector<std::size_t> members) {
    const auto number = [&](std::size_t i) {
      return study_.axes[along].values[value_of(i, along)].number;
    };
    std::erase_if(members, [&](std::size_t i) { return !results_.points[i].is_ranked(); });
    std::ranges::sort(members, {}, number);
    ObservedOrder order{.axis = study_.axes[along].name,
                        .others = others,
                        .points = members,
                        .numbers = {},
                        .error = {},
                        .cost = {}};
    std::vector<double> errors, costs;
    for (const std::size_t i : members) {
      order.numbers.push_back(number(i));
      const double error = *results_.points[i].error.error;
      errors.push_back(error > error_rounding ? error : 0.0);
      costs.push_back(results_.points[i].cost.median);
    }
    if (!study_.axes[along].problem) order.error = power(order.numbers, errors);
    order.cost = power(order.numbers, costs);
    if (members.size() > 1) results_.orders.push_back(std::move(order));
  }

  void cross(const ObservedOrder& one, const ObservedOrder& other) {
    std::vector<std::size_t> differing;
    for (std::size_t k = 0; k < one.others.size(); ++k) {
      if (one.others[k] != other.others[k]) differing.push_back(k);
    }
    if (differing.size() != 1) return;
    const std::size_t k = differing.front();
    if (study_.axis(one.others[k].first).problem) return;
    std::vector<double> places, first, second;
    for (std::size_t i = 0; i < one.points.size(); ++i) {
      const auto at = std::ranges::find(other.numbers, one.numbers[i]);
      if (at == other.numbers.end()) continue;
      places.push_back(one.numbers[i]);
      first.push_back(results_.points[one.points[i]].cost.median);
      second.push_back(results_.points[other.points[at - other.numbers.begin()]].cost.median);
    }
    Choice same = one.others;
    same.erase(same.begin() + static_cast<std::ptrdiff_t>(k));
    CostCrossing crossing{one.axis,
                          one.others[k].first,
                          {one.others[k].second, other.others[k].second},
                          same,
                          crossings(places, first, second, blur)};
    if (crossing.places.empty()) return;
    // The one that costs less below comes first.
    for (std::size_t i = 0; i < first.size(); ++i) {
      if (first[i] < second[i] * blur && second[i] < first[i] * blur) continue;
      if (first[i] > second[i]) std::swap(crossing.values.first, crossing.values.second);
      break;
    }
    results_.crossings.push_back(std::move(crossing));
  }

  const Study& study_;
  StudyResults& results_;
};

}  // namespace

StudyResults conclude(const Study& study, std::vector<StudyPoint> points) {
  StudyResults results{.points = std::move(points), .rankings = {}, .orders = {}, .crossings = {}};
  Conclusion conclusion(study, results);
  conclusion.rank();
  conclusion.observe_orders();
  conclusion.find_crossings();
  return results;
}

std::string text_of(const Choice& choice) {
  std::string text;
  for (const auto& [axis, value] : choice) {
    text += (text.empty() ? "" : ", ") + axis + " " + value;
  }
  return text;
}

}  // namespace perifrac
