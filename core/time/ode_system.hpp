#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <string>
#include <string_view>

namespace perifrac {

/// Ordinary differential equations dy/dt = f(t, y), with J = df/dy.
class OdeSystem {
 public:
  virtual ~OdeSystem() = default;

  /// What y is, for messages: the name that visit_state gives to it.
  virtual std::string_view name() const = 0;

  virtual std::size_t size() const = 0;

  /// Where an unknown lies, for messages.
  virtual std::string place(std::size_t unknown) const {
    return "entry " + std::to_string(unknown);
  }

  /// How many of the last unknowns only add up what the others do (the volume that left through a
  /// face): no rate depends on them, so they have no say in stability.
  virtual std::size_t accumulators() const { return 0; }

  /// dydt = f(t, y); both of length size().
  virtual void rhs(double t, std::span<const double> y, std::span<double> dydt) = 0;

  /// product = J(t, y) v, without forming J. An empty y asks for the J of a state of reference
  /// that changes with jacobian_version() only.
  virtual void jacobian_times(double t, std::span<const double> y, std::span<const double> v,
                              std::span<double> product) = 0;

  /// What an error in each unknown is measured against, positive; infinity: it need not be
  /// accurate.
  virtual void magnitudes(double t, std::span<const double> y, std::span<double> magnitude) = 0;

  /// Rises whenever J becomes another matrix (bonds broke), so that what was derived from the old
  /// one is derived anew at the next reset.
  virtual std::uint64_t jacobian_version() const = 0;

  /// An upper bound of the |eigenvalues| of the J of the state of reference; by power iteration,
  /// which takes some fifty products.
  virtual double fastest_rate(double t);

  /// Others answer y, and what they answer comes only when y is asked to go on: a mode must not
  /// come back from an advance with its sign turned, or the two feed each other.
  virtual bool is_answered_late() const { return false; }

  /// At most so many times the spectral radius at the state of reference is that of J(t, y); 1
  /// where J does not depend on y. Stable steps are shorter by it.
  virtual double jacobian_growth(double, std::span<const double>) { return 1.0; }
};

/// The matrix I - gamma J of an implicit step, by its inverse. An exact inverse makes a direct
/// solver, an approximate one a preconditioner.
class NewtonMatrix {
 public:
  virtual ~NewtonMatrix() = default;

  virtual bool exact() const = 0;

  /// Readies solve() for J at (t, y). The outcome may depend on nothing else: a run that goes on
  /// and a run that starts again from the same state must get the same bits.
  virtual void set_up(double t, std::span<const double> y, double gamma) = 0;

  /// solution = (I - gamma J)^-1 r. Where c J = 0 for a row vector c, c.y is conserved if
  /// c.solution = c.r.
  virtual void solve(std::span<const double> r, std::span<double> solution) = 0;
};

}  // namespace perifrac
