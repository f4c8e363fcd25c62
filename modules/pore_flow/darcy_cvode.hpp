#pragma once

#include <memory>
#include <string>

#include "core/time/cvode_integrator.hpp"
#include "modules/pore_flow/darcy_factor.hpp"
#include "modules/pore_flow/darcy_preconditioner.hpp"

namespace perifrac {

/// CVODE with the matrix that its Newton iteration needs; both live as long as the integrator.
template <int D>
class DarcyCvode final : public Integrator {
 public:
  enum class Systems { factored, iterated };

  DarcyCvode(DarcySystem<D>& system, Systems systems, double tolerance)
      : matrix_(make_matrix(system, systems)), cvode_(system, *matrix_, tolerance) {}

  void reset(double t, std::span<const double> y) override { cvode_.reset(t, y); }
  void advance(double t_end, std::span<double> y) override { cvode_.advance(t_end, y); }
  bool is_multistep() const override { return true; }
  double longest_step() const override { return cvode_.longest_step(); }
  std::string path() const override {
    return matrix_->exact() ? "CVODE's systems by a factor" : "CVODE's systems by krylov";
  }
  IntegratorStatistics statistics() const override { return cvode_.statistics(); }

 private:
  static std::unique_ptr<NewtonMatrix> make_matrix(DarcySystem<D>& system, Systems systems) {
    if (systems == Systems::factored) return std::make_unique<DarcyFactor<D>>(system);
    return std::make_unique<DarcyPreconditioner<D>>(system);
  }

  std::unique_ptr<NewtonMatrix> matrix_;
  CvodeIntegrator cvode_;
};

}  // namespace perifrac
