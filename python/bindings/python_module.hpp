#pragma once

#include <pybind11/numpy.h>
#include <pybind11/pybind11.h>
#include <string>
#include <utility>
#include <vector>

#include "core/body/body.hpp"
#include "core/module/physics_module.hpp"

namespace perifrac {

/// A module that is an object of Python, derived from perifrac.Module: every function of the
/// interface is its method of the same name. Takes the GIL where it is called.
class PythonModule final : public PhysicsModule {
 public:
  /// `whole` is the name of where its totals live.
  PythonModule(pybind11::object self, const AnyBody& body, std::string whole);
  ~PythonModule() override;

  std::span<const Port> ports() const override { return ports_; }
  PortView port(PortId id) override;
  void initialize(double t) override;
  void connect(PortId in) override;
  double stable_time_step() const override;
  void prepare(const TimeWindow& window) override;
  double advance(const TimeWindow& window) override;
  bool wants_another_pass() const override;
  double conclude(const TimeWindow& window) override;
  bool may_end_windows() const override;
  std::string path() const override;
  void visit_state(StateVisitor& visitor) override;
  void on_restored(double t) override;

 private:
  /// What a port showed last, which spans refer to.
  struct Shown {
    pybind11::object points{}, value{}, rate{}, slope{}, forecast{};
    double number = 0.0;
  };

  template <class Result, class... Arguments>
  Result call(const char* method, Arguments&&... arguments) const;
  void forget_earlier();
  std::string who(const char* method) const;
  std::span<double> span_of(const pybind11::object& array, const Port& port, const char* part,
                            double& number) const;
  PortView view_of(const pybind11::object& shown, PortId id);

  pybind11::object self_;
  std::string class_name_;
  AnyBody body_;
  PointSet whole_;
  std::vector<Port> ports_;
  std::vector<Shown> shown_;
  std::vector<Shown> earlier_;  ///< shown since the last advance: spans of it may still be read
};

/// `perifrac.add_module_type`, and what a module of Python is made with and shows.
void bind_modules(pybind11::module_& module);

}  // namespace perifrac
