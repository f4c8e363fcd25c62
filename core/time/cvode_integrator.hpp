#pragma once

#include <memory>

#include "core/time/integrator.hpp"
#include "core/time/ode_system.hpp"

namespace perifrac {

/// Backward differentiation of order 1 to 5 with error control (CVODE of SUNDIALS), Newton's
/// method inside. Its history lives on from one advance to the next, and ends at reset.
class CvodeIntegrator final : public Integrator {
 public:
  /// System and matrix must outlive the integrator. An exact matrix solves Newton's systems itself;
  /// an approximate one preconditions, from the right, a GMRES that needs the system's
  /// jacobian_times only. Either way a linear invariant that the matrix keeps is kept.
  /// `tolerance` bounds the error of a step over the system's magnitudes (root mean square).
  CvodeIntegrator(OdeSystem& system, NewtonMatrix& matrix, double tolerance);
  ~CvodeIntegrator() override;

  void reset(double t, std::span<const double> y) override;
  void advance(double t_end, std::span<double> y) override;
  bool is_multistep() const override { return true; }
  double longest_step() const override;
  IntegratorStatistics statistics() const override;

 private:
  class Cvode;
  std::unique_ptr<Cvode> cvode_;
};

}  // namespace perifrac
