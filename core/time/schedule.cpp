#include "core/time/schedule.hpp"

#include <algorithm>

#include <fmt/format.h>

namespace perifrac {

Schedule Schedule::ramp(double duration) { return table({0.0, duration}, {0.0, 1.0}); }

Schedule Schedule::table(std::vector<double> times, std::vector<double> factors) {
  Schedule schedule;
  schedule.times_ = std::move(times);
  schedule.factors_ = std::move(factors);
  return schedule;
}

Schedule Schedule::growth(double rate) {
  Schedule schedule = table({0.0}, {0.0});
  schedule.rate_ = rate;
  return schedule;
}

double Schedule::factor(double t) const {
  return given_ ? *given_ * written_factor(t) : written_factor(t);
}

double Schedule::written_factor(double t) const {
  if (times_.empty()) return 1.0;
  const double growth = rate_ * t;
  const auto later = std::ranges::upper_bound(times_, t);
  if (later == times_.begin()) return factors_.front() + growth;
  if (later == times_.end()) return factors_.back() + growth;
  const std::size_t n = later - times_.begin();
  const double part = (t - times_[n - 1]) / (times_[n] - times_[n - 1]);
  return factors_[n - 1] + part * (factors_[n] - factors_[n - 1]) + growth;
}

double Schedule::integral(double begin, double end) const {
  double sum = 0.0;
  const auto up_to = [&](double t) {
    sum += 0.5 * (factor(begin) + factor(t)) * (t - begin);
    begin = t;
  };
  for (const double t : times_) {
    if (t > begin && t < end) up_to(t);
  }
  up_to(end);
  return sum;
}

KeyTable schedule_keys(const std::string& prefix) {
  return {
      {.path = prefix + "schedule.ramp",
       .unit = "s",
       .range = "(0, inf)",
       .meaning = "The value rises in proportion to time, from 0 to its full size at this time."},
      {.path = prefix + "schedule.times",
       .type = KeyType::numbers,
       .unit = "s",
       .meaning = "Times of a table, rising; constant beyond its ends."},
      {.path = prefix + "schedule.factors",
       .type = KeyType::numbers,
       .meaning = "What the value is multiplied by at these times; linear in between."},
  };
}

namespace {

Schedule read_written_schedule(const Section& section, const std::string& at) {
  if (!section.has(at)) return {};
  const bool ramp = section.has(at + ".ramp");
  const bool times = section.has(at + ".times");
  const bool factors = section.has(at + ".factors");
  const char* const expected = "either ramp, or times and factors";
  if (ramp && (times || factors)) section.fail(at, "a ramp and a table at once", expected);
  if (ramp) return Schedule::ramp(section.number(at + ".ramp"));
  if (!times || !factors) section.fail(at, "no whole schedule", expected);
  std::vector<double> t = section.numbers(at + ".times");
  std::vector<double> f = section.numbers(at + ".factors");
  if (t.empty() || t.size() != f.size()) {
    section.fail(at, fmt::format("{} times and {} factors", t.size(), f.size()),
                 "as many of one as of the other, at least one");
  }
  const auto not_rising = std::ranges::adjacent_find(t, std::greater_equal{});
  if (not_rising != t.end()) {
    section.fail(at + ".times",
                 fmt::format("{:g} s does not come after {:g} s", not_rising[1], not_rising[0]),
                 "times that rise");
  }
  return Schedule::table(std::move(t), std::move(f));
}

}  // namespace

Schedule read_schedule(const Section& section, const std::string& path) {
  return read_schedule_at(section, path.empty() ? "schedule" : path + ".schedule");
}

Schedule read_schedule_at(const Section& section, const std::string& at) {
  Schedule schedule = read_written_schedule(section, at);
  schedule.follow(section.given(at));
  return schedule;
}

}  // namespace perifrac
