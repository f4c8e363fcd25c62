#include "app/study/sentences.hpp"

#include <algorithm>
#include <map>

#include <fmt/format.h>
#include <fmt/ranges.h>

namespace perifrac {

namespace {

std::string takes(double factor) {
  if (factor < 1.05) return "takes as long";
  return factor < 9.95 ? fmt::format("takes {:.1f} times as long", factor)
                       : fmt::format("takes {:.0f} times as long", factor);
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
      text += fmt::format("; the next, {}, {}", name(next), longer(next, best));
    } else {
      text += "; no other one does";
    }
    return text + "." + by_value(entry, best);
  }

  std::string order(const ObservedOrder& order) const {
    std::vector<std::string> parts;
    if (order.error) parts.push_back(fmt::format("error by {:.1f}", *order.error));
    if (order.cost) parts.push_back(fmt::format("cost by {:.1f}", *order.cost));
    return fmt::format("Power of {}{}: {}.", order.axis, where(order.others),
                       fmt::join(parts, ", "));
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
  std::string longer(std::size_t i, std::size_t best) const { return takes(cost(i) / cost(best)); }

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
        parts.push_back(
            fmt::format("with {} it {} ({})", label, longer(*point, best), name(*point)));
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
  for (const ObservedOrder& order : results.orders) {
    if (order.error || order.cost) said.push_back(speaker.order(order));
  }
  std::ranges::move(speaker.failures(), std::back_inserter(said));
  if (!left_out.empty()) {
    said.push_back(fmt::format("Left out by the study: {}.", fmt::join(left_out, ", ")));
  }
  return said;
}

}  // namespace perifrac
