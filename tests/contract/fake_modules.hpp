#pragma once

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <functional>
#include <limits>
#include <memory>
#include <span>
#include <stdexcept>
#include <string>
#include <utility>
#include <vector>

#include "core/module/physics_module.hpp"
#include "coupling/manager.hpp"

/// Physics small enough to be solved with a pencil, for tests of what modules and manager owe each
/// other.
namespace perifrac::fake {

/// n points on the x axis, one metre apart, that all fakes on `body` share.
class Line {
 public:
  explicit Line(std::size_t n, std::string name = "body") : x_(n), y_(n, 0.0) {
    for (std::size_t i = 0; i < n; ++i) x_[i] = static_cast<double>(i);
    set_ = {.name = std::move(name), .dimension = 2, .position = {x_, y_, {}}, .count = n};
  }
  Line(const Line&) = delete;
  Line& operator=(const Line&) = delete;
  const PointSet* set() const { return &set_; }

 private:
  std::vector<double> x_;
  std::vector<double> y_;
  PointSet set_;
};

/// Values of an in-port.
struct Input {
  explicit Input(std::size_t n) : value(n, 0.0), rate(n, 0.0), slope(n, 0.0) {}
  std::vector<double> value, rate, slope;
};

/// Ports whose values a test reads and writes by hand, and a response of its choice.
class Socket final : public PhysicsModule {
 public:
  struct Values {
    const PointSet* points;
    std::vector<double> value, rate, slope;
  };

  /// Each port starts as zeros on `points`, of `count` values; with slopes, if any, of 1.
  Socket(std::vector<Port> ports, const PointSet* points, bool sloped = false)
      : ports_(std::move(ports)) {
    for (const Port& port : ports_) {
      const std::size_t count = port.components * points->count;
      at.push_back({points, std::vector<double>(count, 0.0), std::vector<double>(count, 0.0),
                    std::vector<double>(sloped ? count : 0, 1.0)});
    }
  }

  std::span<const Port> ports() const override { return ports_; }
  PortView port(PortId id) override {
    return {at[id].points, at[id].value, at[id].rate, at[id].slope};
  }
  void initialize(double) override {}
  double stable_time_step() const override { return std::numeric_limits<double>::infinity(); }
  double advance(const TimeWindow& window) override {
    if (respond) respond(window);
    return window.end;
  }
  void visit_state(StateVisitor&) override {}
  void on_restored(double) override {}

  std::vector<Values> at;  ///< one a port
  std::function<void(const TimeWindow&)> respond;

 private:
  std::vector<Port> ports_;
};

/// Load on the springs, sigma(t) = size (1 + sin(frequency t)); smooth, and there from the start.
struct Load {
  double size = 1.0;
  double frequency = 2.0;
  double at(double t) const { return size * (1.0 + std::sin(frequency * t)); }
};

/// A solid without inertia: dilatation = (pore_stress - load(t)) / stiffness at every point.
class Springs final : public PhysicsModule {
 public:
  Springs(std::vector<double> stiffness, double announced_stiffness, Load load = {})
      : stiffness_(std::move(stiffness)),
        announced_(stiffness_.size(), 1.0 / announced_stiffness),
        load_(load),
        line_(stiffness_.size()),
        pore_stress_(stiffness_.size()),
        dilatation_(stiffness_.size(), 0.0) {}

  std::span<const Port> ports() const override { return ports_; }
  PortView port(PortId id) override {
    if (id == 0) return {.points = line_.set(), .value = pore_stress_.value};
    return {.points = line_.set(), .value = dilatation_, .slope = announced_};
  }
  void initialize(double t) override { respond(t); }
  double stable_time_step() const override { return std::numeric_limits<double>::infinity(); }
  double advance(const TimeWindow& window) override {
    respond(window.end);
    return window.end;
  }
  void visit_state(StateVisitor& visitor) override { visitor.visit("dilatation", dilatation_); }
  void on_restored(double) override {}

  const std::vector<double>& dilatation() const { return dilatation_; }

 private:
  void respond(double t) {
    for (std::size_t i = 0; i < stiffness_.size(); ++i) {
      dilatation_[i] = (pore_stress_.value[i] - load_.at(t)) / stiffness_[i];
    }
  }

  std::vector<Port> ports_ = {{"pore_stress", "Pa", PortDirection::in},
                              {"dilatation", "1", PortDirection::out}};
  std::vector<double> stiffness_;
  std::vector<double> announced_;
  Load load_;
  Line line_;
  Input pore_stress_;
  std::vector<double> dilatation_;
};

/// Pore fluid that drains at every point by itself: d(content)/dt = -conductance p, with content =
/// storage p + dilatation (Biot coefficient 1), integrated exactly for an input that is linear in
/// time: what error a run has is the coupling's.
class DrainingPores final : public PhysicsModule {
 public:
  DrainingPores(std::size_t n, double storage, double conductance, double leak = 0.0)
      : storage_(storage),
        conductance_(conductance),
        leak_(leak),
        line_(n),
        dilatation_(n),
        content_(n, 0.0),
        pressure_(n, 0.0),
        undrained_(n, -1.0 / storage) {}

  std::span<const Port> ports() const override { return ports_; }
  PortView port(PortId id) override {
    switch (id) {
      case 0:
        return {.points = line_.set(),
                .value = dilatation_.value,
                .rate = dilatation_.rate,
                .slope = dilatation_.slope};
      case 1:
        return {.points = line_.set(), .value = pressure_, .slope = undrained_};
      case 2:
        stored_ = 0.0;
        for (const double content : content_) stored_ += content;
        return {.points = &total_, .value = {&stored_, 1}};
      default:
        return {.points = &total_, .value = {&gained_, 1}};
    }
  }
  void initialize(double t) override {
    clock_ = t;
    update_pressure();
  }
  double stable_time_step() const override { return std::numeric_limits<double>::infinity(); }
  double advance(const TimeWindow& window) override {
    if (window.begin != clock_) throw std::logic_error("the past was not dropped");
    clock_ = window.end;
    const double h = window.length();
    for (std::size_t i = 0; i < content_.size() && h > 0.0; ++i) {
      const double decay = conductance_ / (storage_ + dilatation_.slope[i]);
      const double begin = dilatation_.value[i] - dilatation_.rate[i] * h;
      const double faded = std::exp(-decay * h);
      const double before = content_[i];
      content_[i] = (before - begin) * faded - dilatation_.rate[i] * (1.0 - faded) / decay +
                    dilatation_.value[i];
      gained_ += content_[i] - before;
      content_[i] -= leak_ * h;
    }
    update_pressure();
    return window.end;
  }
  void visit_state(StateVisitor& visitor) override {
    visitor.visit("content", content_);
    visitor.visit("gained", gained_);
  }
  void on_restored(double t) override {
    clock_ = t;
    update_pressure();
  }

  const std::vector<double>& content() const { return content_; }
  const std::vector<double>& pressure() const { return pressure_; }

 private:
  void update_pressure() {
    for (std::size_t i = 0; i < content_.size(); ++i) {
      pressure_[i] = (content_[i] - dilatation_.value[i]) / (storage_ + dilatation_.slope[i]);
    }
  }

  std::vector<Port> ports_ = {
      {"dilatation", "1", PortDirection::in},
      {"pore_stress", "Pa", PortDirection::out},
      {"fluid_mass", "kg", PortDirection::out, PortKind::extensive, PortRole::mass_stored},
      {"fluid_gained", "kg", PortDirection::out, PortKind::extensive, PortRole::mass_gained}};
  double storage_;
  double conductance_;
  double leak_;
  Line line_;
  PointSet total_{.name = "total"};
  Input dilatation_;
  std::vector<double> content_;
  std::vector<double> pressure_;
  std::vector<double> undrained_;
  double stored_ = 0.0;
  double gained_ = 0.0;
  double clock_ = 0.0;  ///< not state: as an integrator's history, it is right only if it is told
};

/// Rings once, at a known time, and ends the window there. Counts rings in its state.
class Alarm final : public PhysicsModule {
 public:
  /// `expects`: times at which it expects to ring, ascending.
  explicit Alarm(double rings_at, std::vector<double> expects = {})
      : rings_at_(rings_at), expects_(std::move(expects)) {}

  std::span<const Port> ports() const override { return {}; }
  PortView port(PortId) override { return {}; }
  void initialize(double) override {}
  double stable_time_step() const override { return std::numeric_limits<double>::infinity(); }
  double expected_end(const TimeWindow& window) const override {
    const auto next = std::ranges::upper_bound(expects_, window.begin);
    return next == expects_.end() ? window.end : *next;
  }
  double advance(const TimeWindow& window) override {
    if (rings_ > 0 || window.end < rings_at_) return window.end;
    ++rings_;
    return rings_at_;
  }
  void visit_state(StateVisitor& visitor) override { visitor.visit("rings", rings_); }
  void on_restored(double) override {}

  std::int64_t rings() const { return rings_; }

 private:
  double rings_at_;
  std::vector<double> expects_;
  std::int64_t rings_ = 0;
};

/// Fluid particles that enter at x = 0, move to the right and leave at x = 5: points come, go and
/// keep their ids. In each window a particle gives off mass in proportion to its length, to
/// whoever takes `mass_given`, and less of it the warmer its surroundings are.
class Particles final : public PhysicsModule {
 public:
  Particles() { add(0.0); }

  std::span<const Port> ports() const override { return ports_; }
  PortView port(PortId id) override {
    points_.position = {x_, y_, {}};
    points_.count = x_.size();
    if (id == 0) return {.points = &points_, .value = given_};
    return {.points = &points_, .value = warmth_};
  }
  void initialize(double) override {}
  double stable_time_step() const override { return 0.5; }
  double advance(const TimeWindow& window) override {
    const double h = window.length();
    for (std::size_t i = 0; i < x_.size(); ++i) {
      x_[i] += h;
      given_[i] = 0.1 * h * static_cast<double>(1 + id_[i] % 3) / (1.0 + warmth_[i]);
      lost_ += given_[i];
    }
    if (h > 0.0) {
      while (!x_.empty() && x_.front() > 5.0) remove_first();
      add(h);
      ++points_.version;
    }
    return window.end;
  }
  void visit_state(StateVisitor& visitor) override {
    visitor.visit("id", id_);
    visitor.visit("x", x_);
    visitor.visit("given", given_);
    visitor.visit("next_id", next_id_);
    visitor.visit("lost", lost_);
    y_.resize(x_.size(), 0.0);
    warmth_.resize(x_.size(), 0.0);
    visitor.visit("warmth", warmth_);
  }
  void on_restored(double) override { ++points_.version; }

  std::size_t count() const { return x_.size(); }
  double lost() const { return lost_; }
  const std::vector<double>& warmth() const { return warmth_; }

 private:
  void add(double entered) {
    id_.push_back(next_id_++);
    x_.push_back(0.3 * entered);
    y_.push_back(0.0);
    // New points give their share of the window in which they came.
    given_.push_back(0.05 * entered);
    lost_ += given_.back();
    warmth_.push_back(0.0);
  }
  void remove_first() {
    // Its total has to go somewhere: to the next in line.
    given_.at(1) += given_.front();
    for (auto* values : {&x_, &y_, &given_, &warmth_}) values->erase(values->begin());
    id_.erase(id_.begin());
  }

  std::vector<Port> ports_ = {{"mass_given", "kg", PortDirection::out, PortKind::extensive},
                              {"warmth", "K", PortDirection::in}};
  PointSet points_{.name = "particles", .dimension = 2};
  std::vector<std::int64_t> id_;
  std::vector<double> x_, y_, given_, warmth_;
  std::int64_t next_id_ = 0;
  double lost_ = 0.0;
};

/// Points that do not move, take the mass and get warm by it.
class Wall final : public PhysicsModule {
 public:
  Wall() : line_(6, "wall"), given_(6), mass_(6, 0.0), warmth_(6, 0.0) {}

  std::span<const Port> ports() const override { return ports_; }
  PortView port(PortId id) override {
    if (id == 0) return {.points = line_.set(), .value = given_.value, .rate = given_.rate};
    return {.points = line_.set(), .value = warmth_};
  }
  void initialize(double) override {}
  double stable_time_step() const override { return std::numeric_limits<double>::infinity(); }
  double advance(const TimeWindow& window) override {
    for (std::size_t i = 0; i < mass_.size(); ++i) {
      if (window.length() > 0.0) mass_[i] += given_.value[i];
      warmth_[i] = mass_[i];
    }
    return window.end;
  }
  void visit_state(StateVisitor& visitor) override {
    visitor.visit("mass", mass_);
    visitor.visit("warmth", warmth_);
  }
  void on_restored(double) override {}

  double taken() const {
    double sum = 0.0;
    for (const double mass : mass_) sum += mass;
    return sum;
  }
  const std::vector<double>& warmth() const { return warmth_; }

 private:
  std::vector<Port> ports_ = {{"mass_given", "kg", PortDirection::in, PortKind::extensive},
                              {"warmth", "K", PortDirection::out}};
  Line line_;
  Input given_;
  std::vector<double> mass_;
  std::vector<double> warmth_;
};

/// Stands for a fluid that touches a body at every point: through its wall flows mass, in
/// proportion to the pores' mobility and the difference of pressures, and it presses on the wall,
/// anew at random in every window.
class Tank final : public PhysicsModule {
 public:
  Tank(const PointSet* body, double pressure, double force)
      : body_(body),
        pressure_(pressure),
        force_(force),
        impulse_(body->dimension * body->count, 0.0),
        given_(body->count, 0.0),
        displacement_(body->dimension * body->count),
        pore_pressure_(body->count),
        mobility_(body->count) {
    const auto vector = [&](const char* name, const char* unit, PortDirection direction,
                            PortKind kind) {
      return Port{name, unit, direction, kind, PortRole::field, body->dimension};
    };
    const auto total = [&](const char* unit) { return unit_of_total(unit, body->dimension); };
    ports_ = {
        vector("displacement", "m", PortDirection::in, PortKind::intensive),
        {"pore_pressure", "Pa", PortDirection::in},
        {"pore_mobility", "m^2/(Pa s)", PortDirection::in, PortKind::intensive, PortRole::property},
        vector("interface_impulse", total("N s").c_str(), PortDirection::out, PortKind::extensive),
        {"exchanged_mass", total("kg"), PortDirection::out, PortKind::extensive},
        {"free_fluid_mass", total("kg"), PortDirection::out, PortKind::extensive,
         PortRole::mass_stored}};
  }

  std::span<const Port> ports() const override { return ports_; }
  PortView port(PortId id) override {
    switch (id) {
      case 0:
        return {.points = body_, .value = displacement_.value, .rate = displacement_.rate};
      case 1:
        return {.points = body_, .value = pore_pressure_.value, .rate = pore_pressure_.rate};
      case 2:
        return {.points = body_, .value = mobility_.value};
      case 3:
        return {.points = body_, .value = impulse_};
      case 4:
        return {.points = body_, .value = given_};
      default:
        return {.points = &total_, .value = {&mass_, 1}};
    }
  }
  void initialize(double) override {}
  double stable_time_step() const override { return std::numeric_limits<double>::infinity(); }
  double advance(const TimeWindow& window) override {
    const double h = window.length();
    for (std::size_t i = 0; i < given_.size(); ++i) {
      const double wanted = pressure_ * (1.0 + random()) - pore_pressure_.value[i];
      given_[i] = h * 1e3 * mobility_.value[i] * wanted;
      mass_ -= given_[i];
    }
    for (double& impulse : impulse_) impulse = h * force_ * random();
    return window.end;
  }
  void visit_state(StateVisitor& visitor) override {
    visitor.visit("mass", mass_);
    visitor.visit("seed", seed_);
  }
  void on_restored(double) override {}

  std::span<const double> mobility() const { return mobility_.value; }

 private:
  /// From -1 to 1.
  double random() {
    seed_ = (1664525 * seed_ + 1013904223) % (std::int64_t{1} << 32);
    return static_cast<double>(seed_) / static_cast<double>(std::int64_t{1} << 31) - 1.0;
  }

  const PointSet* body_;
  double pressure_;
  double force_;
  std::vector<Port> ports_;
  PointSet total_{.name = "total"};
  std::vector<double> impulse_, given_;
  Input displacement_, pore_pressure_, mobility_;
  double mass_ = 0.0;
  std::int64_t seed_ = 1;
};

/// Draining pores and springs under one manager, with hands on both.
struct Consolidation {
  struct Setup {
    std::vector<double> stiffness = {1.0, 1.5, 2.0, 3.0};
    double announced_stiffness = 1.0;  ///< what fixed stress is told
    double storage = 0.5;
    double conductance = 1.0;
    double leak = 0.0;
  };

  Consolidation(const Setup& setup, const CouplingOptions& options)
      : setup(setup), manager(make(setup, pores, springs), options) {
    manager.initialize(0.0);
  }

  void run(double end) {
    manager.settle();
    while (manager.time() < end) manager.advance(end);
  }

  /// The monolithic answer: content' = -c (content + load/K)/(S + 1/K) from no content.
  double exact_content(std::size_t i, double t) const {
    const double give = 1.0 / setup.stiffness[i];
    const double a = setup.conductance / (setup.storage + give);
    const double g = give * load.size;
    const double w = load.frequency;
    const double sine = -a * a * g / (w * w + a * a);
    const double cosine = a * g * w / (w * w + a * a);
    return -g + sine * std::sin(w * t) + cosine * std::cos(w * t) + (g - cosine) * std::exp(-a * t);
  }
  double exact_pressure(std::size_t i, double t) const {
    const double give = 1.0 / setup.stiffness[i];
    return (exact_content(i, t) + give * load.at(t)) / (setup.storage + give);
  }
  double content_error(double t) const {
    double worst = 0.0;
    for (std::size_t i = 0; i < setup.stiffness.size(); ++i) {
      worst = std::max(worst, std::abs(pores->content()[i] - exact_content(i, t)));
    }
    return worst;
  }
  double pressure_error(double t) const {
    double worst = 0.0;
    for (std::size_t i = 0; i < setup.stiffness.size(); ++i) {
      worst = std::max(worst, std::abs(pores->pressure()[i] - exact_pressure(i, t)));
    }
    return worst;
  }

  Setup setup;
  Load load;
  DrainingPores* pores = nullptr;
  Springs* springs = nullptr;
  CouplingManager manager;

 private:
  static std::vector<ModuleSlot> make(const Setup& setup, DrainingPores*& pores,
                                      Springs*& springs) {
    auto flow = std::make_unique<DrainingPores>(setup.stiffness.size(), setup.storage,
                                                setup.conductance, setup.leak);
    auto solid = std::make_unique<Springs>(setup.stiffness, setup.announced_stiffness);
    pores = flow.get();
    springs = solid.get();
    std::vector<ModuleSlot> modules;
    modules.push_back({"pore_flow", std::move(flow)});
    modules.push_back({"solid", std::move(solid)});
    return modules;
  }
};

/// Windows of one length.
inline CouplingOptions even_windows(double length) {
  return {.first_window = length, .window_growth = 1.0, .largest_window = length};
}

}  // namespace perifrac::fake
