#include "app/run/recorder.hpp"

#include <algorithm>
#include <chrono>
#include <cmath>
#include <set>

#include "app/references/reference_types.hpp"
#include "app/run/frame_geometry.hpp"
#include "app/run/version.hpp"
#include "core/base/errors.hpp"
#include "core/base/ranks.hpp"
#include "core/profile/profile.hpp"
#include "core/state/finite_check.hpp"

namespace perifrac {

namespace {

double wall_clock() {
  return std::chrono::duration<double>(std::chrono::steady_clock::now().time_since_epoch()).count();
}

/// Adds the time of its own life.
class Stopwatch {
 public:
  explicit Stopwatch(double& seconds) : profiled_("output"), seconds_(seconds) {}
  Stopwatch(const Stopwatch&) = delete;
  Stopwatch& operator=(const Stopwatch&) = delete;
  ~Stopwatch() { seconds_ += wall_clock() - start_; }

 private:
  ProfilePart profiled_;
  double& seconds_;
  double start_ = wall_clock();
};

Probes make_probes(const Section& scene, const Simulation& simulation) {
  const ProfilePart profiled("output");
  return {scene.at("output"), simulation, fluid_spacing(scene)};
}

}  // namespace

Recorder::Recorder(const Section& scene, std::string scene_text, Simulation& simulation)
    : simulation_(simulation),
      scene_text_(std::move(scene_text)),
      probes_(make_probes(scene, simulation)),
      reference_(make_reference(scene, simulation)),
      mass_bound_(scene.number("ledger.mass_error")),
      history_interval_(scene.number("output.history_interval")),
      checkpoint_interval_(scene.number("output.checkpoint_interval")) {}

void Recorder::walk(StateVisitor& visitor) {
  simulation_.manager->visit_state(visitor);
  visitor.enter("output");
  visitor.visit("next_history_row", next_row_);
  if (reference_) reference_->visit_state(visitor);
  visitor.leave();
}

void Recorder::restore(const Checkpoint& checkpoint) {
  checkpoint.state.restore([this](StateVisitor& visitor) { walk(visitor); });
  simulation_.manager->restart_point();  // before modules are asked for what they hold
  restart_point();
}

void Recorder::open(const std::filesystem::path& folder, const std::optional<Checkpoint>& restart) {
  folder_ = folder;
  if (restart) last_frame_ = restart->time;
  std::vector<HistoryColumn> columns = probes_.columns();
  for (const LedgerColumn& column : simulation_.manager->ledger().columns()) {
    columns.push_back({column.name, column.unit});
  }
  std::set<std::string> point_sets;
  for (const Field& field : fields_of(*simulation_.manager)) {
    if (field.points().dimension > 0) point_sets.insert(field.points().name);
  }
  ranks::on_first([&] {
    if (restart) {
      // Before rows and frames are cut back: checkpoints beyond them, and the summary, must not
      // stay.
      write_last_checkpoint(false);
      std::filesystem::remove(folder_ / "summary.json");
    }
    const Stopwatch watch(seconds_);
    history_.emplace(folder_ / "history.csv", columns,
                     restart ? std::optional(restart->step) : std::nullopt);
    for (const std::string& name : point_sets) {
      frames_.emplace(name, FrameSeries(folder_, name, last_frame_));
    }
  });
}

void Recorder::record_window() {
  const double time = simulation_.manager->time();
  if (folder_.empty() || time < next_row_) return;
  const Stopwatch watch(seconds_);
  const ProfilePart profiled("history");
  // Rows keep to multiples of the interval, whatever the windows.
  if (history_interval_ > 0.0) {
    next_row_ = history_interval_ * (std::floor(time / history_interval_ * (1 + 1e-12)) + 1.0);
  }
  std::vector<double> row;
  probes_.append_values(row);
  for (const LedgerColumn& column : simulation_.manager->ledger().columns()) {
    row.push_back(column.value);
  }
  ranks::on_first([&] { history_->append(time, simulation_.manager->step(), row); });
  if (reference_) reference_->record_history(time);
}

void Recorder::record_output() {
  const Stopwatch watch(seconds_);
  const ProfilePart profiled("frames");
  const double time = simulation_.manager->time();
  write_frames(time);
  if (reference_ && time > 0.0) reference_->record_output(time);
}

void Recorder::record_failure() {
  const double time = simulation_.manager->time();
  if (folder_.empty() || last_frame_ == time) return;
  const Stopwatch watch(seconds_);
  write_frames(time);
}

void Recorder::check_kept() const {
  ranks::on_first([&] {
    if (history_) history_->check_kept();
    for (const auto& [name, series] : frames_) series.check_kept();
  });
}

void Recorder::write_frames(double time) {
  if (folder_.empty()) return;
  struct Frame {
    const PointSet* points = nullptr;
    std::vector<FrameField> fields;
  };
  std::map<std::string, Frame> frames;
  for (const Field& field : fields_of(*simulation_.manager)) {
    if (field.points().dimension == 0) continue;
    Frame& frame = frames[field.points().name];
    frame.points = &field.points();
    frame.fields.push_back(
        {field.port.name, field.port.unit, field.port.components, field.values()});
  }
  last_frame_ = time;
  ranks::on_first([&] {
    for (auto& [name, series] : frames_) {
      const Frame& frame = frames.at(name);
      series.write(time, *frame.points, frame.fields,
                   frame_geometry(simulation_.body, *frame.points));
    }
  });
}

void Recorder::check_mass() const {
  const CouplingManager& manager = *simulation_.manager;
  manager.ledger().check_mass(mass_bound_, manager.time());
}

std::int64_t Recorder::windows_since_restart_point() const {
  return simulation_.manager->step() - last_->step;
}

void Recorder::restart_point() {
  const ProfilePart profiled("restart points");
  check_mass();
  CouplingManager& manager = *simulation_.manager;
  if (!last_) last_ = {.scene = scene_text_, .version = version};
  last_->time = manager.time();
  last_->step = manager.step();
  last_->state.save([this](StateVisitor& visitor) { walk(visitor); });
  check_agreement();
  manager.restart_point();
}

/// What processes compute has the same bits only where they have the same instructions.
void Recorder::check_agreement() const {
  if (ranks::count() == 1 || ranks::agree(last_->state.digest())) return;
  throw FinalError("state", "the processes", last_->time,
                   "processes hold different states; expected machines with the same processor");
}

void Recorder::write_checkpoint(bool if_due) {
  if (folder_.empty() || !last_) return;
  ranks::on_first([&] { write_last_checkpoint(if_due); });
}

void Recorder::write_last_checkpoint(bool if_due) {
  if (last_->step == step_on_disk_) return;
  const double now = wall_clock();
  if (if_due && step_on_disk_ >= 0 && now - disk_time_ < checkpoint_interval_) return;
  const Stopwatch watch(seconds_);
  const ProfilePart profiled("checkpoints");
  perifrac::write_checkpoint(folder_, *last_);
  step_on_disk_ = last_->step;
  disk_time_ = now;
}

void Recorder::check_finite() {
  const CouplingManager& manager = *simulation_.manager;
  // Fields are named after their module; its arrays lie on the points that its own fields lie on.
  const auto points_of = [&](std::string_view name) -> const PointSet* {
    for (const ModuleSlot& slot : manager.modules()) {
      if (!name.starts_with(slot.name + "/")) continue;
      const auto ports = slot.module->ports();
      for (std::size_t id = 0; id < ports.size(); ++id) {
        if (ports[id].direction != PortDirection::out || ports[id].role != PortRole::field)
          continue;
        const PointSet* const points = slot.module->port(static_cast<PortId>(id)).points;
        if (points->dimension > 0) return points;
      }
    }
    return nullptr;
  };
  const ProfilePart profiled("checks for finite values");
  FiniteCheck check(manager.time(), points_of);
  simulation_.manager->visit_state(check);
}

}  // namespace perifrac
