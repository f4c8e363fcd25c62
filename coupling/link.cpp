#include "coupling/link.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <stdexcept>

#include <fmt/format.h>

namespace perifrac {
namespace {

// Plain left-to-right sums: the same bits wherever the array lies and however many threads run.
double norm(std::span<const double> values) {
  double sum = 0.0;
  for (const double value : values) sum += value * value;
  return std::sqrt(sum);
}

/// slope x, where slope has one value a point or is a matrix (PortView).
double slope_times(const std::vector<double>& slope, const std::vector<double>& x, std::size_t i) {
  if (slope.size() == x.size()) return slope[i] * x[i];
  double sum = 0.0;
  for (std::size_t j = 0; j < x.size(); ++j) sum += slope[i * x.size() + j] * x[j];
  return sum;
}

double over(double part, double whole) {
  if (part == 0.0) return 0.0;
  return whole > 0.0 ? part / whole : std::numeric_limits<double>::infinity();
}

}  // namespace

double Link::Mismatch::relative() const { return over(absolute, scale); }

double Link::Mismatch::of_output() const { return over(absolute, output); }

Link::Link(LinkEnd source, LinkEnd target, bool lagged)
    : name_(source.module->ports()[source.port].name),
      kind_(source.module->ports()[source.port].kind),
      source_(std::move(source)),
      target_(std::move(target)),
      lagged_(lagged),
      mapping_(kind_) {}

std::string Link::path() const {
  return fmt::format("{}.{} -> {}", source_.module_name, name_, target_.module_name);
}

void Link::join(std::shared_ptr<SummedInput> sum) {
  share_.sum = std::move(sum);
  share_.place = share_.sum->add(source_.module_name);
}

void Link::use_slope_of(const Link& total) {
  use_slope(total.target_.port);
  counter_share_ = total.share_;
}

void Link::start() {
  const PortView out = source_.module->port(source_.port);
  read_source(out, reached_);
  find_rates(0.0);
  accept();
  is_foretold_ = !out.forecast.empty();
  const bool is_property = source_.module->ports()[source_.port].role == PortRole::property;
  if (is_property && !uses_slope() && out.slope.empty()) extrapolates_ = false;
}

void Link::predict(double length) {
  length_ = length;
  // The source stands where the last window left it, though its points may have a new version.
  const PortView out = source_.module->port(source_.port);
  if (is_foretold_) {
    sent_.points = freeze(*out.points, sent_.points);
    sent_.value.assign(out.forecast.begin(), out.forecast.end());
    sent_.rate.assign(sent_.value.size(), 0.0);
    sent_.slope.assign(out.slope.begin(), out.slope.end());
    return;
  }
  if (out.value.size() == accepted_.output.size()) {
    accepted_.points = freeze(*out.points, accepted_.points);
  } else {  // points came or went at the window's end
    read_source(out, accepted_);
    accepted_.output_rate.assign(accepted_.output.size(), 0.0);
    accepted_.counter_rate.assign(accepted_.counter.size(), 0.0);
  }
  start_counter();
  read_slope(out);
  form_value(accepted_);
  if (kind_ == PortKind::extensive) {
    for (std::size_t i = 0; i < sent_.value.size(); ++i) {
      sent_.rate[i] = length > 0.0 ? sent_.value[i] / length : 0.0;
    }
  } else if (hold_ || !extrapolates_) {
    std::ranges::fill(sent_.rate, 0.0);
  } else {
    for (std::size_t i = 0; i < sent_.value.size(); ++i) sent_.value[i] += sent_.rate[i] * length;
  }
}

/// A total over the window grows from nothing.
void Link::start_counter() {
  if (counter_ && source_.module->ports()[*counter_].kind == PortKind::extensive) {
    std::ranges::fill(accepted_.counter, 0.0);
  }
}

void Link::accept() {
  if (!is_foretold_) std::swap(accepted_, reached_);
  if (share_.sum) share_.sum->accept(share_.place);
  start_counter();
}

void Link::deliver() {
  const PortView input = target_.module->port(target_.port);
  const std::size_t components = target_.module->ports()[target_.port].components;
  if (sent_.value.size() != components * sent_.points->set().count ||
      input.value.size() != components * input.points->count) {
    throw std::logic_error(fmt::format("{}: values and points differ in number", path()));
  }
  if (share_.sum) return deliver_sum();
  mapping_.update(sent_.points->set(), *input.points);
  const bool has_earlier = counter_share_.sum && counter_share_.place > 0;
  if (has_earlier) add_earlier_shares();
  mapping_.apply(has_earlier ? told_.value : sent_.value, input.value);
  if (!input.rate.empty()) mapping_.apply(has_earlier ? told_.rate : sent_.rate, input.rate);
  if (uses_slope() && sent_.slope.size() != sent_.value.size()) {
    if (!mapping_.is_identity()) throw std::logic_error(path() + ": a slope between other points");
    std::ranges::copy(sent_.slope, input.slope.begin());
  } else if (uses_slope()) {
    mapping_.apply(sent_.slope, input.slope);
  } else {
    std::fill(input.slope.begin(), input.slope.end(), 0.0);
  }
}

/// Maps what is handed over to the target's present points.
void Link::find_share() {
  const PortView input = target_.module->port(target_.port);
  mapping_.update(sent_.points->set(), *input.points);
  share_.sum->share(share_.place).resize(input.value.size());
  mapping_.apply(sent_.value, share_.sum->share(share_.place));
}

/// The last of the links to an in-port makes it whole.
void Link::deliver_sum() {
  find_share();
  const PortView input = target_.module->port(target_.port);
  share_.sum->add_up(0, share_.place + 1, input.value);
  for (std::size_t i = 0; i < input.rate.size(); ++i) {
    input.rate[i] = length_ > 0.0 ? input.value[i] / length_ : 0.0;
  }
  std::ranges::fill(input.slope, 0.0);
}

/// What modules before the target have handed over in this window, its source will answer.
void Link::add_earlier_shares() {
  told_.value = sent_.value;
  told_.rate = sent_.rate;
  told_.earlier.resize(sent_.value.size());
  counter_share_.sum->add_up(0, counter_share_.place, told_.earlier);
  for (std::size_t i = 0; i < sent_.value.size(); ++i) {
    const double answer = sent_.slope[i] * told_.earlier[i];
    told_.value[i] += answer;
    if (length_ > 0.0) told_.rate[i] += answer / length_;
  }
}

void Link::collect(double length) {
  if (is_foretold_) return;
  std::swap(used_, sent_.value);
  const PortView out = source_.module->port(source_.port);
  read_source(out, reached_);
  find_rates(length);
  read_slope(out);
  if (lagged_ && !sent_.points->set().same_points(reached_.points->set())) {
    Mapping moved(kind_);
    moved.update(sent_.points->set(), reached_.points->set());
    std::vector<double> mapped(reached_.output.size());
    moved.apply(used_, mapped);
    used_ = std::move(mapped);
  }
  form_value(reached_);
  if (share_.sum && !lagged_) find_share();
  if (lagged_) compare();
}

void Link::relax(std::span<const double> value, double length) {
  for (std::size_t i = 0; i < sent_.value.size(); ++i) {
    if (length > 0.0) sent_.rate[i] += (value[i] - sent_.value[i]) / length;
    sent_.value[i] = value[i];
  }
}

std::string Link::state_name() const {
  return fmt::format("{}.{}.{}", source_.module_name, name_, target_.module_name);
}

void Link::visit_state(StateVisitor& visitor) {
  visitor.enter(state_name());
  visitor.visit("output", accepted_.output);
  visitor.visit("output_rate", accepted_.output_rate);
  visitor.visit("counter", accepted_.counter);
  visitor.visit("counter_rate", accepted_.counter_rate);
  if (share_.sum) share_.sum->visit_state(visitor, share_.place);
  visitor.leave();
}

void Link::read_source(const PortView& out, Sample& sample) {
  sample.points = freeze(*out.points, sample.points);
  sample.output.assign(out.value.begin(), out.value.end());
  if (uses_slope()) read_counter(sample);
}

void Link::read_counter(Sample& sample) const {
  if (counter_share_.sum) {
    sample.counter.resize(sample.output.size());
    return counter_share_.sum->add_up(0, counter_share_.place + 1, sample.counter);
  }
  const PortView in = source_.module->port(*counter_);
  sample.counter.assign(in.value.begin(), in.value.end());
  if (sample.counter.size() != sample.output.size()) {
    throw std::logic_error(fmt::format("{}: the slope's two ports differ in size", path()));
  }
  for (std::size_t i = 0; i < in.slope.size(); ++i) {
    sample.counter[i] += in.slope[i] * sample.output[i];
  }
}

void Link::read_slope(const PortView& out) {
  if (uses_slope()) sent_.slope.assign(out.slope.begin(), out.slope.end());
}

void Link::find_rates(double length) {
  rate_since(reached_.output, accepted_.output, length, reached_.output_rate);
  rate_since(reached_.counter, accepted_.counter, length, reached_.counter_rate);
}

void Link::rate_since(const std::vector<double>& now, const std::vector<double>& before,
                      double length, std::vector<double>& rate) const {
  rate.assign(now.size(), 0.0);
  if (length <= 0.0 || now.empty()) return;
  std::vector<double> mapped;
  const std::vector<double>* begin = &before;
  if (kind_ == PortKind::extensive) {
    mapped.assign(now.size(), 0.0);  // a total over the window grows from nothing
    begin = &mapped;
  } else if (!accepted_.points->set().same_points(reached_.points->set())) {
    mapped.resize(now.size());
    Mapping moved(kind_);
    moved.update(accepted_.points->set(), reached_.points->set());
    moved.apply(before, mapped);
    begin = &mapped;
  }
  for (std::size_t i = 0; i < now.size(); ++i) rate[i] = (now[i] - (*begin)[i]) / length;
}

void Link::form_value(const Sample& sample) {
  sent_.points = sample.points;
  sent_.value = sample.output;
  sent_.rate = sample.output_rate;
  for (std::size_t i = 0; i < sample.counter.size(); ++i) {
    sent_.value[i] -= slope_times(sent_.slope, sample.counter, i);
    sent_.rate[i] -= slope_times(sent_.slope, sample.counter_rate, i);
  }
}

void Link::compare() {
  std::vector<double> difference(sent_.value.size());
  for (std::size_t i = 0; i < sent_.value.size(); ++i) difference[i] = sent_.value[i] - used_[i];
  mismatch_.absolute = norm(difference);
  const double negligible = source_.module->ports()[source_.port].negligible;
  const double root = std::sqrt(static_cast<double>(sent_.value.size()));
  if (mismatch_.absolute <= root * negligible) mismatch_.absolute = 0.0;
  mismatch_.scale = mismatch_.output = norm(reached_.output);
  if (!uses_slope()) return;
  for (std::size_t i = 0; i < sent_.value.size(); ++i) {
    difference[i] = slope_times(sent_.slope, reached_.counter, i);
  }
  mismatch_.scale = std::max(mismatch_.scale, norm(difference));
}

}  // namespace perifrac
