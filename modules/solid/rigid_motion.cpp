#include "modules/solid/rigid_motion.hpp"

#include <array>

#include <Eigen/Dense>

namespace perifrac {

namespace {

constexpr std::array axis_names = {"x", "y", "z"};

/// Rotation k of the plane (a, b), about the middle of the points.
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

}  // namespace

template <int D>
std::string rigid_motion_without_energy(const Points<D>& points,
                                        const Eigen::SparseMatrix<double>& stiffness) {
  const Index n = points.size();
  const Eigen::Index unknowns = stiffness.rows();
  Eigen::MatrixXd motions(unknowns, D * (D + 1) / 2);
  std::vector<std::string> names;
  int column = 0;
  for (int a = 0; a < D; ++a) {
    Eigen::VectorXd motion = Eigen::VectorXd::Zero(unknowns);
    motion.segment(a * n, n).setOnes();
    // A plate goes along as far as that costs nothing: its own best answer to the motion.
    for (Eigen::Index plate = D * n; plate < unknowns; ++plate) {
      motion[plate] = -stiffness.col(plate).dot(motion) / stiffness.coeff(plate, plate);
    }
    motions.col(column++) = motion.normalized();
    names.push_back(std::string("it can slide along ") + axis_names[a]);
  }
  for (int a = 0; a < D; ++a) {
    for (int b = a + 1; b < D; ++b) {
      motions.col(column++) = rotation(points, unknowns, a, b).normalized();
      names.push_back(std::string("it can turn in the plane of ") + axis_names[a] + " and " +
                      axis_names[b]);
    }
  }
  const Eigen::MatrixXd energy = motions.transpose() * (stiffness * motions);
  const Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd> spectrum(energy);
  const double typical = stiffness.diagonal().mean();
  // Held by one face, a motion costs about 1 / (points across) of a bond's stiffness; free, only
  // rounding is left.
  if (spectrum.eigenvalues()[0] > 1e-11 * typical) return {};
  Eigen::Index worst;
  spectrum.eigenvectors().col(0).cwiseAbs().maxCoeff(&worst);
  return names[worst];
}

template std::string rigid_motion_without_energy<2>(const Points<2>&,
                                                    const Eigen::SparseMatrix<double>&);
template std::string rigid_motion_without_energy<3>(const Points<3>&,
                                                    const Eigen::SparseMatrix<double>&);

}  // namespace perifrac
