#pragma once

#include <cstdint>
#include <iterator>
#include <string>
#include <string_view>
#include <vector>

#include <Eigen/Core>

namespace perifrac {

/// One walk over every evolving field serves rollback, checkpoint, restart and the check for
/// values that are not finite. Owners call visit() with each field once, in a fixed order.
class StateVisitor {
 public:
  explicit StateVisitor(bool takes_guesses = true) : takes_guesses_(takes_guesses) {}
  virtual ~StateVisitor() = default;

  /// False of rollback: what solvers go on from, and no answer depends on beyond its tolerance, is
  /// kept as it is, so that a window knows what the tries before have shown. Checkpoints take it,
  /// that a restart has the same bits.
  bool takes_guesses() const { return takes_guesses_; }

  void visit(std::string_view name, std::vector<double>& values) { real(path(name), values); }
  void visit(std::string_view name, std::vector<std::int64_t>& values) {
    integer(path(name), values);
  }
  void visit(std::string_view name, Eigen::VectorXd& values) {
    std::vector<double> all(values.begin(), values.end());
    visit(name, all);
    values = Eigen::Map<const Eigen::VectorXd>(all.data(), std::ssize(all));
  }
  void visit(std::string_view name, double& value) { visit_scalar(name, value); }
  void visit(std::string_view name, std::int64_t& value) { visit_scalar(name, value); }

  /// Fields visited until `leave` are named `group/name`.
  void enter(std::string_view group) { prefix_.append(group).push_back('/'); }
  void leave() {
    prefix_.pop_back();
    const auto slash = prefix_.rfind('/');
    prefix_.resize(slash == std::string::npos ? 0 : slash + 1);
  }

 private:
  virtual void real(const std::string& name, std::vector<double>& values) = 0;
  virtual void integer(const std::string& name, std::vector<std::int64_t>& values) = 0;

  template <class Number>
  void visit_scalar(std::string_view name, Number& value) {
    std::vector<Number> one{value};
    visit(name, one);
    value = one.at(0);
  }

  std::string path(std::string_view name) const { return prefix_ + std::string(name); }

  std::string prefix_;
  bool takes_guesses_;
};

}  // namespace perifrac
