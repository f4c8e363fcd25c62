#include "coupling/coupling_keys.hpp"

namespace perifrac {
namespace {

// No length of window suits every physics, but the simulated time is known to be of interest: five
// decades of growth from a sudden load, which diffuses as the square root of time, then at least
// fifty windows. With the growth of 1.1 this comes to about 130 windows.
constexpr double first_part = 1e-5;
constexpr double largest_part = 0.02;

Split split(const std::string& word) {
  if (word == "drained") return Split::drained;
  if (word == "fixed_stress") return Split::fixed_stress;
  if (word == "undrained") return Split::undrained;
  return Split::automatic;
}

AccelerationType acceleration_type(const std::string& word) {
  if (word == "aitken") return AccelerationType::aitken;
  if (word == "anderson") return AccelerationType::anderson;
  if (word == "quasi_newton") return AccelerationType::quasi_newton;
  return AccelerationType::none;
}

}  // namespace

const KeyTable& coupling_keys() {
  static const KeyTable keys = {
      {.path = "window.type",
       .type = KeyType::word,
       .fallback = "schedule",
       .words = {"schedule", "one_step"},
       .meaning = "schedule: windows grow from the first to the largest. one_step: every window is "
                  "the shortest stable step of any explicit module, at most the largest"},
      {.path = "window.first",
       .unit = "s",
       .range = "(0, inf)",
       .meaning = "Length of the first window and of the first after a sudden load; left out: "
                  "1e-5 of the simulated time"},
      {.path = "window.growth",
       .range = "[1, 2]",
       .fallback = "1.1",
       .meaning = "Factor from one window to the next, up to the largest"},
      {.path = "window.largest",
       .unit = "s",
       .range = "(0, inf)",
       .meaning =
           "Longest window; left out: a fiftieth of the simulated time. An undrained split in "
           "one pass keeps windows shorter where more than 0.02 of the pore stress would "
           "change unseen"},
      {.path = "window.retries",
       .type = KeyType::integer,
       .range = "[0, inf)",
       .fallback = "8",
       .meaning =
           "How often a window in which modules do not agree, or one of them fails, is taken "
           "back and tried again, half as long, before the run stops; 0: never. Also how often an "
           "undrained split may halve its windows"},
      {.path = "split",
       .type = KeyType::word,
       .fallback = "automatic",
       .words = {"drained", "fixed_stress", "undrained", "automatic"},
       .meaning = "What is sent between modules that depend on each other: plain values, or values "
                  "with the slope of the sender's first answer, to pore flow (fixed_stress) or to "
                  "an explicit solid (undrained); automatic: whichever the solid can take"},
      {.path = "iterations.max",
       .type = KeyType::integer,
       .range = "[1, inf)",
       .meaning =
           "Passes over the modules in a window; 1: one pass on extrapolated inputs. Left "
           "out: 1, and 100 with fixed_stress in windows whose inputs were not as foretold, or "
           "in all where the modules depend on each other too strongly for one"},
      {.path = "iterations.tolerance",
       .range = "(0, 0.1]",
       .fallback = "1e-4",
       .meaning = "Relative change from pass to pass below which a window is done; it cannot be "
                  "met below the tolerance of the modules' own integrators"},
      {.path = "acceleration",
       .type = KeyType::word,
       .fallback = "anderson",
       .words = {"none", "aitken", "anderson", "quasi_newton"},
       .meaning = "How the next pass's input is formed from those before: anderson from those of "
                  "the window, quasi_newton from those of windows before, too"},
  };
  return keys;
}

CouplingOptions read_coupling_options(const Section& coupling, double duration) {
  const auto window = [&](const char* key, double part) {
    return coupling.has(key) ? coupling.number(key) : part * duration;
  };
  CouplingOptions options{.first_window = window("window.first", first_part),
                          .window_growth = coupling.number("window.growth"),
                          .largest_window = window("window.largest", largest_part)};
  if (options.first_window > options.largest_window) {
    if (coupling.has("window.first") && coupling.has("window.largest")) {
      coupling.fail("window.first", "the first window is longer than the largest",
                    "window.first <= window.largest");
    }
    // Only one was given, and it is meant.
    const double given =
        coupling.has("window.first") ? options.first_window : options.largest_window;
    options.first_window = options.largest_window = given;
  }
  if (coupling.word("window.type") == "one_step") options.window = WindowType::one_step;
  options.retries = coupling.integer("window.retries");
  options.split = split(coupling.word("split"));
  options.max_iterations.reset();
  if (coupling.has("iterations.max")) options.max_iterations = coupling.integer("iterations.max");
  options.tolerance = coupling.number("iterations.tolerance");
  options.acceleration = acceleration_type(coupling.word("acceleration"));
  return options;
}

}  // namespace perifrac
