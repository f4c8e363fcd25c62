#pragma once

#include <limits>
#include <optional>
#include <string>
#include <vector>

#include <nlohmann/json_fwd.hpp>

#include "app/run/recorder.hpp"
#include "app/run/summary.hpp"
#include "app/simulation/simulation.hpp"
#include "app/warnings/resolution_warnings.hpp"
#include "app/warnings/validity_watch.hpp"
#include "core/config/section.hpp"

namespace perifrac {

/// A run, window by window: what `perifrac run` does at a stretch, and Python as it likes. The same
/// windows, restart points and files, so that both have the same bits.
class SceneRun {
 public:
  /// Of an initialised simulation. `text` is the scene as run, which checkpoints belong to;
  /// `outputs` are the times of frames, rising [s], the last of which is the end. Writes nothing.
  /// Throws InputError.
  SceneRun(const Section& scene, std::string text, Simulation& simulation,
           std::vector<double> outputs);

  /// From t = 0, or from where a checkpoint stands. Without a folder nothing is written at all.
  void start(const std::filesystem::path& folder, const std::optional<Checkpoint>& restart = {});

  /// One window, not past the next output nor `stop` [s], and what is due after it: rows, frames,
  /// checks, restart points. A `stop` of one's own makes other windows. Throws NumericalError,
  /// OutputError.
  void advance(double stop = std::numeric_limits<double>::infinity());
  bool is_done() const { return simulation_.manager->time() >= outputs_.back(); }

  void write_checkpoint(bool if_due) { recorder_.write_checkpoint(if_due); }

  /// A load was changed by hand: the instant answer to it, as at the start. Windows start over from
  /// the first, and a restart finds the load as it is from here on.
  void settle();

  /// After the last window: says what only a run's end shows, where it was not stopped, and writes
  /// what it can be gone on from.
  void finish(bool stopped);
  /// After an error: the log says why, and what can still be written is. After any but a
  /// NumericalError the state is not sure any more.
  RunEnd fail(const std::exception& error);

  const Recorder& recorder() const { return recorder_; }
  /// What summary.json holds, of the scene in `file`. `whole` is the run's wall time [s].
  nlohmann::json summary(const std::string& file, const RunEnd& end, double whole) const;

 private:
  Section scene_;
  std::string text_;
  Simulation& simulation_;
  std::vector<double> outputs_;
  Recorder recorder_;
  ValidityWatch watch_;
  FillingWatch filling_;
};

}  // namespace perifrac
