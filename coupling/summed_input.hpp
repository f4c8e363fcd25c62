#pragma once

#include <cstddef>
#include <span>
#include <string>
#include <utility>
#include <vector>

#include "core/base/require.hpp"
#include "core/state/compensated_sum.hpp"
#include "core/state/state_visitor.hpp"

namespace perifrac {

/// What several modules hand over to one in-port, a total over the window each. The in-port is
/// given their sum; each share is kept, on the in-port's points, for those that are told how the
/// in-port's module answers their own. Shares stand in the order in which their modules advance.
class SummedInput {
 public:
  /// Returns the place of one more module, `source`.
  std::size_t add(std::string source);
  std::size_t sources() const { return shares_.size(); }

  /// Of the pass at hand, or of the last one where it has not come so far.
  std::vector<double>& share(std::size_t place) { return shares_[place].values; }

  /// Sets `sum` to that of the shares at the places [begin, end); one that was never handed over
  /// counts as nothing. Throws std::logic_error where sizes differ.
  void add_up(std::size_t begin, std::size_t end, std::span<double> sum) const;

  /// The window stands, and this is what passed.
  void accept(std::size_t place);

  /// What one source has handed over since the start, all points and components together.
  double passed(std::size_t place) const { return shares_[place].passed.value(); }
  const std::string& source(std::size_t place) const { return shares_[place].source; }

  void visit_state(StateVisitor& visitor, std::size_t place) {
    shares_[place].passed.visit_state(visitor, "passed");
  }

 private:
  struct Share {
    std::string source;
    std::vector<double> values;
    CompensatedSum passed;
  };
  std::vector<Share> shares_;
};

}  // namespace perifrac
