#include "app/study/sentences.hpp"

#include <algorithm>
#include <map>

#include <fmt/format.h>
#include <fmt/ranges.h>

namespace perifrac {

namespace {

std::string factor_text(double factor) {
  return factor < 9.95 ? fmt::format("{:.1f}", factor) : fmt::format("{:.0f}", factor);
}

std::string where(const Choice& choice) {
  return choice.empty() ? "" : " (" + text_of(choice) + ")";
}

class Speaker {
 public:
  Speaker(const Study& study, const StudyResults& results) : study_(study), results_(results) {}

  std::string cheapest(const Ranking& ranking, const CheapestFor& entry) const {
    const std::string accuracy = fmt::format("{:g}", entry.accuracy);
    const std::string problem = where(ranking.problem);
    if (entry.reaching.empty()) return none(ranking, accuracy, problem);
    const std::size_t best = entry.reaching.front();
    std::string text = fmt::format("To reach {}{} the cheapest is {}: {}", accuracy, problem,
                                   name(best), time_text(cost(best)));
    if (entry.reaching.size() > 1) {
      const std::size_t next = entry.reaching[1];
      text += fmt::format("; the next, {}, takes {} times as long", name(next), times(next, best));
    } else {
      text += "; no other one does";
    }
    return text + "." + by_value(entry, best);
  }

  std::string order(const ObservedOrder& order) const {
    std::string text = order.axis + where(order.others) + ":";
    if (order.error) text += fmt::format(" the error goes with its power {:.1f}", *order.error);
    if (order.cost) {
      text += fmt::format("{} the cost with {:.1f}", order.error ? "," : "", *order.cost);
    }
    return text + ".";
  }

  std::string crossing(const CostCrossing& crossing) const {
    const std::string& unit = study_.axis(crossing.axis).unit;
    std::vector<std::string> places;
    for (const double place : crossing.places) places.push_back(number_text(place, unit));
    return fmt::format("Along {}{}, {} costs less below {}, {} above.", crossing.axis,
                       where(crossing.others), crossing.values.first,
                       places.size() == 1 ? places.front()
                                          : places.front() + " and in parts up to " + places.back(),
                       crossing.values.second);
  }

  /// One sentence a reason, so that a matrix of many failures stays readable.
  std::vector<std::string> failures() const {
    std::map<std::pair<std::string, std::string>, std::vector<std::string>> by_reason;
    std::vector<std::string> result;
    for (const StudyPoint& point : results_.points) {
      const bool done = point.record->status == VariantStatus::done;
      if (!done) {
        by_reason[{word(point.record->status), point.record->message}].push_back(
            point.variant->name);
      } else if (!point.is_ranked() && !point.variant->choice.empty()) {
        by_reason[{"without an error", point.error.why}].push_back(point.variant->name);
      }
    }
    for (const auto& [reason, names] : by_reason) {
      const auto& [status, message] = reason;
      result.push_back(fmt::format("{} {}: {}{}.", names.size(), status, fmt::join(names, ", "),
                                   message.empty() ? "" : " (" + message + ")"));
    }
    return result;
  }

 private:
  const std::string& name(std::size_t i) const { return results_.points[i].variant->name; }
  double cost(std::size_t i) const { return results_.points[i].cost.median; }
  std::string times(std::size_t i, std::size_t best) const {
    return factor_text(cost(i) / cost(best));
  }

  std::string none(const Ranking& ranking, const std::string& accuracy,
                   const std::string& problem) const {
    if (ranking.front.empty()) return fmt::format("No variant reaches {}{}.", accuracy, problem);
    const std::size_t nearest = ranking.front.back();
    return fmt::format("No variant reaches {}{}; the best, {}, has {} in {}.", accuracy, problem,
                       name(nearest), error_text(*results_.points[nearest].error.error),
                       time_text(cost(nearest)));
  }

  /// How much longer the best of every other value of the compared axis takes.
  std::string by_value(const CheapestFor& entry, std::size_t best) const {
    std::vector<std::string> parts;
    for (const auto& [label, point] : entry.by_value) {
      if (!point) {
        parts.push_back(label + " does not reach it");
      } else if (*point != best && (entry.reaching.size() < 2 || *point != entry.reaching[1])) {
        parts.push_back(fmt::format("with {} it takes {} times as long ({})", label,
                                    times(*point, best), name(*point)));
      }
    }
    return parts.empty() ? "" : fmt::format(" Of {}: {}.", study_.compared, fmt::join(parts, "; "));
  }

  const Study& study_;
  const StudyResults& results_;
};

}  // namespace

std::string error_text(double error) { return fmt::format("{:.1e}", error); }

std::string time_text(double seconds) {
  return seconds < 100.0 ? fmt::format("{:.2g} s", seconds) : fmt::format("{:.0f} s", seconds);
}

std::string number_text(double number, const std::string& unit) {
  return fmt::format("{:.2g}{}{}", number, unit.empty() ? "" : " ", unit);
}

std::vector<std::string> sentences(const Study& study, const StudyResults& results,
                                   const std::vector<std::string>& left_out) {
  const Speaker speaker(study, results);
  std::vector<std::string> said;
  for (const Ranking& ranking : results.rankings) {
    for (const CheapestFor& entry : ranking.cheapest) {
      said.push_back(speaker.cheapest(ranking, entry));
    }
  }
  for (const CostCrossing& crossing : results.crossings) said.push_back(speaker.crossing(crossing));
  for (const ObservedOrder& order : results.orders) said.push_back(speaker.order(order));
  std::ranges::move(speaker.failures(), std::back_inserter(said));
  if (!left_out.empty()) {
    said.push_back(fmt::format("Left out by the study: {}.", fmt::join(left_out, ", ")));
  }
  return said;
}

}  // namespace perifrac
