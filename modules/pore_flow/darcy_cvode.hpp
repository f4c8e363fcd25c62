#pragma once

#include <string>

#include "core/time/cvode_integrator.hpp"
#include "modules/pore_flow/darcy_newton_matrix.hpp"

namespace perifrac {

/// CVODE with the matrix that its Newton iteration needs; both live as long as the integrator.
template <int D>
class DarcyCvode final : public Integrator {
 public:
  DarcyCvode(DarcySystem<D>& system, typename DarcyNewtonMatrix<D>::Method method, double tolerance)
      : matrix_(system, method), cvode_(system, matrix_, tolerance) {}

  void reset(double t, std::span<const double> y) override { cvode_.reset(t, y); }
  void advance(double t_end, std::span<double> y) override { cvode_.advance(t_end, y); }
  bool is_multistep() const override { return true; }
  double longest_step() const override { return cvode_.longest_step(); }
  std::string path() const override {
    return matrix_.exact() ? "CVODE's systems by a factor" : "CVODE's systems by krylov";
  }
  IntegratorStatistics statistics() const override { return cvode_.statistics(); }

 private:
  DarcyNewtonMatrix<D> matrix_;
  CvodeIntegrator cvode_;
};

}  // namespace perifrac
