#pragma once

#include <cstdint>
#include <functional>
#include <map>
#include <string>
#include <variant>
#include <vector>

#include "core/state/state_visitor.hpp"

namespace perifrac {

/// Shows every field of some modules to a visitor.
using StateWalk = std::function<void(StateVisitor&)>;

/// A copy of every evolving field, in memory. Rollback holds one, a checkpoint is one on disk.
class Snapshot {
 public:
  using Values = std::variant<std::vector<double>, std::vector<std::int64_t>>;
  using Fields = std::map<std::string, Values>;

  /// `takes_guesses`: as of StateVisitor.
  explicit Snapshot(bool takes_guesses = true) : takes_guesses_(takes_guesses) {}
  explicit Snapshot(Fields fields) : fields_(std::move(fields)) {}

  /// Takes a copy of all that `walk` shows and forgets what it no longer shows. Storage is used
  /// again, so a window repeated at unchanged sizes allocates no arrays.
  /// Throws std::logic_error when a name is shown twice.
  void save(const StateWalk& walk);

  /// Puts the copy back, in whatever order `walk` asks for it; arrays are resized as needed.
  /// Throws std::logic_error when `walk` shows a field that is not held (or is of another type),
  /// shows one twice, or leaves one out; the state is then only partly restored.
  void restore(const StateWalk& walk) const;

  const Fields& fields() const { return fields_; }

  /// A number that another state all but never has.
  std::int64_t digest() const;

 private:
  Fields fields_;
  bool takes_guesses_ = true;
};

}  // namespace perifrac
