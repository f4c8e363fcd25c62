#pragma once

#include <filesystem>
#include <map>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include <nlohmann/json_fwd.hpp>

#include "app/references/reference.hpp"
#include "app/simulation/probes.hpp"
#include "app/simulation/simulation.hpp"
#include "core/io/checkpoint.hpp"
#include "core/io/frames.hpp"
#include "core/io/history.hpp"
#include "core/state/snapshot.hpp"

namespace perifrac {

/// Everything that a run leaves behind while it runs: history rows, frames, checkpoints, and the
/// comparison with a reference. Before open() it writes nothing.
class Recorder {
 public:
  /// Reads what the scene asks for; writes nothing. The manager must be initialised. Throws
  /// InputError.
  Recorder(const Section& scene, std::string scene_text, Simulation& simulation);

  /// Puts back what a checkpoint holds; the manager must be initialised.
  void restore(const Checkpoint& checkpoint);
  /// Begins to write into a folder that an OutputFolder of the first process holds. `restart` is
  /// what the run goes on from: what lies beyond it is removed.
  void open(const std::filesystem::path& folder, const std::optional<Checkpoint>& restart);

  void record_window();  ///< a row of history.csv and of the comparison, when one is due
  void record_output();  ///< a frame and a comparison
  /// Remembers this state as one that a restart goes on from bit for bit, and lets go of
  /// everything in the running simulation that a restart would not have. Throws as check_mass.
  void restart_point();
  std::int64_t windows_since_restart_point() const;
  /// Throws NumericalError where the fluid mass of the ledger is off beyond the bound of the scene.
  void check_mass() const;

  /// A frame of the state that a run failed in, where there is none of that time; nothing before
  /// it began to write.
  void record_failure();
  /// Throws OutputError where something of what was written is not there any more.
  void check_kept() const;

  /// Writes the last restart point, if it is not on disk yet; with `if_due`, only where the wall
  /// time between checkpoints has gone by.
  void write_checkpoint(bool if_due);

  /// Throws NumericalError at the first value that is not finite.
  void check_finite();

  double seconds() const { return seconds_; }  ///< wall time [s] of all that is written
  const Reference* reference() const { return reference_.get(); }  ///< null without one

 private:
  void walk(StateVisitor& visitor);
  void write_frames(double time);
  void write_last_checkpoint(bool if_due);
  void check_agreement() const;

  Simulation& simulation_;
  std::string scene_text_;
  Probes probes_;
  std::unique_ptr<Reference> reference_;
  double mass_bound_;
  double history_interval_;
  double checkpoint_interval_;
  double next_row_ = 0.0;

  double seconds_ = 0.0;
  std::filesystem::path folder_;
  std::optional<double> last_frame_;  ///< of which time [s]
  std::optional<Checkpoint> last_;    ///< the last restart point

  // Of the first process, which alone writes.
  std::optional<History> history_;
  std::map<std::string, FrameSeries> frames_;  ///< by point set
  std::int64_t step_on_disk_ = -1;
  double disk_time_ = 0.0;  ///< wall time of the last checkpoint [s]
};

}  // namespace perifrac
