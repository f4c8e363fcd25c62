#include <cstdio>
#include "tests/unit/fracture/cracked_plate.hpp"
using namespace perifrac;
using namespace perifrac::test;
int main(int argc, char** argv) {
  const int a = argc > 1 ? atoi(argv[1]) : 10;
  const int n = argc > 2 ? atoi(argv[2]) : 200;
  const double mid = n / 2;
  auto seeds = CrackedPlate::line({mid - a, mid}, {1, 0}, 2 * a);
  CrackedPlate plate(n, n, seeds);
  EnergyRelease release(*plate.cracked, 1.0);
  for (int growth = 0; growth <= 4; ++growth) {
    const int count = plate.cracked->jumps().size();
    for (int pressurised = 0; pressurised < 2; ++pressurised) {
      plate.cracked->set_load(pressurised ? Eigen::VectorXd(Eigen::VectorXd::Zero(plate.free.cols())) : plate.remote(0, 1e-3, 0));
      Eigen::VectorXd p = Eigen::VectorXd::Constant(count, pressurised ? 1e-3 : 0.0);
      auto faces = plate.cracked->faces(p);
      Eigen::VectorXd u = plate.cracked->unknowns(faces.pressure);
      const double half = 0.5 * count;
      const double lambda = 2 * half / n;
      // square plate: Isida's series for h/w = 1 (approx)
      const double f = 1 + 0.0 * lambda;
      const double K2 = 1e-6 * M_PI * half * f * f;
      double volume = 0; for (int k = 0; k < count; ++k) volume += faces.opening[k];
      auto at = [&](int side) {
        CrackTip tip{{mid + (side ? a + growth : -a), mid}, {side ? 1.0 : -1.0, 0.0}, 0, 0};
        return release.at(tip, {u.data(), (size_t)u.size()}, faces.pressure);
      };
      auto l = at(0), r = at(1);
      double w0 = 4 * 1e-3 * half, v0 = 2 * M_PI * 1e-3 * half * half;
      printf("a %g %s: F=sqrt(J E')/(s sqrt(pi a)) left %.5f right %.5f  w0/exact %.5f vol/exact %.5f slide %.1e\n", half, pressurised ? "pressure" : "remote  ",
             sqrt(l.energy_release / K2), sqrt(r.energy_release / K2), faces.opening[count / 2] / w0, volume / v0, r.sliding / r.opening);
    }
    plate.cracked->cut({Vector<2>{mid + a + growth, mid}, Vector<2>{mid + a + growth + 1, mid}});
  }
}
