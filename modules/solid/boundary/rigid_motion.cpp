#include "modules/solid/boundary/rigid_motion.hpp"

#include <array>
#include <random>

#include <Eigen/Cholesky>
#include <fmt/format.h>

#include "core/solvers/symmetric_spectrum.hpp"

namespace perifrac {

namespace {

constexpr std::array axis_names = {"x", "y", "z"};

/// Displacement of all unknowns, face values at rest, by a motion of the points along an axis.
template <int D>
Eigen::VectorXd translation(const Points<D>& points, Eigen::Index unknowns, int a) {
  Eigen::VectorXd motion = Eigen::VectorXd::Zero(unknowns);
  motion.segment(a * points.size(), points.size()).setOnes();
  return motion;
}

/// The same by a rotation in the plane (a, b), about the middle of the points.
template <int D>
Eigen::VectorXd rotation(const Points<D>& points, Eigen::Index unknowns, int a, int b) {
  const Index n = points.size();
  const Eigen::Map<const Eigen::VectorXd> xa(points.position[a].data(), n);
  const Eigen::Map<const Eigen::VectorXd> xb(points.position[b].data(), n);
  Eigen::VectorXd motion = Eigen::VectorXd::Zero(unknowns);
  motion.segment(a * n, n) = -(xb.array() - xb.mean());
  motion.segment(b * n, n) = xa.array() - xa.mean();
  return motion;
}

/// The mean of a stiffness' diagonal: about its energy of a vector of random signs.
double typical_stiffness(const StiffnessTimes& stiffness, Eigen::Index size) {
  Eigen::VectorXd signs(size);
  std::minstd_rand bits;
  for (double& sign : signs) sign = bits() % 2 == 0 ? 1.0 : -1.0;
  return signs.dot(stiffness(signs)) / static_cast<double>(size);
}

/// Lets the plates go along with a motion as far as that costs nothing: their own best answer.
void answer_of_plates(const StiffnessTimes& stiffness, Eigen::Index plates,
                      Eigen::VectorXd& motion) {
  if (plates == 0) return;
  Eigen::MatrixXd rows(motion.size(), plates);
  for (Eigen::Index k = 0; k < plates; ++k) {
    rows.col(k) = stiffness(Eigen::VectorXd::Unit(motion.size(), motion.size() - plates + k));
  }
  motion.tail(plates) = rows.bottomRows(plates).ldlt().solve(-(rows.transpose() * motion));
}

}  // namespace

template <int D>
std::string rigid_motion_without_energy(const Points<D>& points, const StiffnessTimes& stiffness,
                                        const Eigen::SparseMatrix<double>& free_unknowns,
                                        Eigen::Index plates) {
  const Eigen::Index all = free_unknowns.rows();
  Eigen::MatrixXd motions(free_unknowns.cols(), D * (D + 1) / 2);
  std::vector<std::string> names;
  int column = 0;
  const auto add = [&](const Eigen::VectorXd& motion_of_all, bool plates_follow) {
    Eigen::VectorXd motion = free_unknowns.transpose() * motion_of_all;
    motion.tail(plates).setZero();
    if (plates_follow) answer_of_plates(stiffness, plates, motion);
    motions.col(column++) = motion.normalized();
  };
  for (int a = 0; a < D; ++a) {
    add(translation(points, all, a), true);
    names.push_back(fmt::format("it can slide along {}", axis_names[a]));
  }
  for (int a = 0; a < D; ++a) {
    for (int b = a + 1; b < D; ++b) {
      add(rotation(points, all, a, b), false);
      names.push_back(
          fmt::format("it can turn in the plane of {} and {}", axis_names[a], axis_names[b]));
    }
  }
  Eigen::MatrixXd energy(motions.cols(), motions.cols());
  for (Eigen::Index k = 0; k < motions.cols(); ++k) {
    energy.col(k) = motions.transpose() * stiffness(motions.col(k));
  }
  const SymmetricSpectrum spectrum = symmetric_spectrum(energy);
  const double typical = typical_stiffness(stiffness, free_unknowns.cols());
  // Held by one face, a motion costs about 1 / (points across) of a bond's stiffness; free, only
  // rounding is left.
  if (spectrum.values[0] > 1e-11 * typical) return {};
  Eigen::Index worst;
  spectrum.vectors.col(0).cwiseAbs().maxCoeff(&worst);
  return names[worst];
}

template std::string rigid_motion_without_energy<2>(const Points<2>&, const StiffnessTimes&,
                                                    const Eigen::SparseMatrix<double>&,
                                                    Eigen::Index);
template std::string rigid_motion_without_energy<3>(const Points<3>&, const StiffnessTimes&,
                                                    const Eigen::SparseMatrix<double>&,
                                                    Eigen::Index);

}  // namespace perifrac
