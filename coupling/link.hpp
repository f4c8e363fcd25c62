#pragma once

#include <memory>
#include <optional>
#include <span>
#include <string>
#include <utility>
#include <vector>

#include "core/module/physics_module.hpp"
#include "coupling/frozen_points.hpp"
#include "coupling/mapping.hpp"
#include "coupling/summed_input.hpp"

namespace perifrac {

/// One end of a link.
struct LinkEnd {
  std::string module_name;
  PhysicsModule* module;
  PortId port;
};

/// One exchange in one direction: reads an out-port, writes the in-port of the same name.
///
/// The out-port's module (the source) may itself depend within the window on what it receives:
/// its `slope` s = d(output)/d(x), x being the quantity on its coupled in-port (the counter). The
/// link then sends the intercept c = output - s x*, with x* what the source saw when it gave that
/// output, and its rate; the target adds s x with its own x, and where both agree it sees the
/// output itself. This is the fixed-stress split, written for any pair. Without slope c is the
/// output. An extensive x is a total over the window: it starts from 0 in each.
///
/// A link is lagged where its source comes after its target in the order of advancing: the target
/// then starts on a prediction. An intensive value is extrapolated with the rate of the last
/// window, so that one pass is second order in the window; or it is held, as are properties that
/// nobody answers.
/// An extensive one is the total of the last window: late, but in one-pass nothing of it is lost.
///
/// Where several modules hand over totals to one in-port, it gets their sum (SummedInput). Its
/// module's answer to that is then told to each with its own share taken off, and those of modules
/// that advance before it, which it is told as they are in this window; what those after it hand
/// over stays in the intercept, at the pace of the last window.
///
/// An output that its module foretells (PortView::forecast) is neither predicted nor compared.
///
/// All that is held lies on the source's points and is mapped when delivered, so either end may
/// insert, remove or reorder points at any time.
class Link {
 public:
  /// ||used - answered|| of the value sent, and the size it is to be compared with: the larger of
  /// ||output|| and ||s x||, since c itself may cancel. Of pure numbers, differences below the
  /// rounding of 1 are none.
  struct Mismatch {
    double absolute = 0.0;
    double scale = 0.0;
    double output = 0.0;  ///< ||output||
    double relative() const;
    double of_output() const;  ///< absolute over it
  };

  Link(LinkEnd source, LinkEnd target, bool lagged);

  const std::string& name() const { return name_; }
  PortKind kind() const { return kind_; }
  std::string path() const;        ///< `solid.dilatation -> pore_flow`, for people
  std::string state_name() const;  ///< `solid.dilatation.pore_flow`, for checkpoints
  const LinkEnd& source() const { return source_; }
  const LinkEnd& target() const { return target_; }
  bool lagged() const { return lagged_; }
  bool is_foretold() const { return is_foretold_; }
  /// Sends a prediction, which the answer may contradict.
  bool predicts() const { return lagged_ && !is_foretold_; }

  /// Send intercept and slope from now on; `counter` is the source's in-port that its slope
  /// refers to. `hold`: the first pass of a window gets the intercept as it stands at its
  /// beginning.
  void use_slope(PortId counter, bool hold = false) {
    counter_ = counter;
    hold_ = hold;
  }
  bool uses_slope() const { return counter_.has_value(); }
  /// Likewise, of the answer to totals that link `total` hands over, alone or beside others.
  void use_slope_of(const Link& total);
  /// The target's in-port gets the sum of what the links at `sum` hand over; this one is the next.
  void join(std::shared_ptr<SummedInput> sum);
  /// Null where it has the in-port to itself.
  std::shared_ptr<const SummedInput> sum() const { return share_.sum; }
  bool is_first_of_sum() const { return share_.sum && share_.place == 0; }
  /// Predict from now on that the intercept stays, over a window, what it is at its beginning.
  void predict_no_change() { extrapolates_ = false; }
  bool holds() const { return hold_; }

  /// Reads the source as it stands, at rest: the first exchange, before any window.
  void start();

  /// Readies what a window of `length` [s] begins with. Any prediction of an earlier attempt at
  /// that window is forgotten.
  void predict(double length);

  /// Maps what is to be sent to the target's present points and writes its in-port.
  void deliver();

  /// Reads the source at the end of a window of `length` [s] and compares with what was sent.
  void collect(double length);
  const Mismatch& mismatch() const { return mismatch_; }

  /// What the target was sent in this pass, and what it would be sent now: on the source's points.
  std::span<const double> used() const { return used_; }
  std::span<const double> answer() const { return sent_.value; }
  /// Sends `value` in place of the answer in the next pass of this window, of `length` > 0 or 0
  /// [s].
  void relax(std::span<const double> value, double length);

  /// The window stands: what was collected is what the next one begins with.
  void accept();

  /// The fields that the next window depends on.
  void visit_state(StateVisitor& visitor);

 private:
  struct Sample {
    SharedPoints points;
    std::vector<double> output;
    std::vector<double> output_rate;
    std::vector<double> counter;  ///< x*, empty without slope
    std::vector<double> counter_rate;
  };

  /// One of several totals for one in-port; without a sum, there is one.
  struct Share {
    std::shared_ptr<SummedInput> sum;
    std::size_t place = 0;
  };
  struct Message {
    SharedPoints points;
    std::vector<double> value, rate, slope;
  };
  /// The message with what modules before the target handed over.
  struct Told {
    std::vector<double> earlier, value, rate;
  };

  void read_source(const PortView& out, Sample& sample);
  void read_counter(Sample& sample) const;
  void find_share();
  void deliver_sum();
  void add_earlier_shares();
  void read_slope(const PortView& out);
  void start_counter();
  void find_rates(double length);
  void rate_since(const std::vector<double>& now, const std::vector<double>& before, double length,
                  std::vector<double>& rate) const;
  void form_value(const Sample& sample);
  void compare();

  std::string name_;
  PortKind kind_;
  LinkEnd source_;
  LinkEnd target_;
  bool lagged_;
  std::optional<PortId> counter_;
  Share share_;          ///< that this link adds
  Share counter_share_;  ///< the target's own of what the slope refers to
  double length_ = 0.0;  ///< of the window at hand [s]
  bool hold_ = false;
  bool extrapolates_ = true;
  bool is_foretold_ = false;

  Sample accepted_;
  Sample reached_;

  Message sent_;
  std::vector<double> used_;
  Told told_;  ///< workspace
  Mismatch mismatch_;

  Mapping mapping_;
};

}  // namespace perifrac
