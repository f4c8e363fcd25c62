#include "tests/unit/time/line_diffusion.hpp"

#include "core/solvers/symmetric_spectrum.hpp"

namespace perifrac::test {

namespace {

/// s V dq/dt = -H q - a V of the pressures q, by modes m of x = root q, root^2 = s V:
/// dm/dt = -rate m - a shape^T V / root.
struct Modes {
  explicit Modes(const LineDiffusion& line)
      : volume(Eigen::VectorXd::Map(line.volume.data(),
                                    static_cast<Eigen::Index>(line.volume.size()))),
        storage(Eigen::VectorXd::Map(line.storage.data(), volume.size())),
        root(storage.cwiseProduct(volume).cwiseSqrt()) {
    Eigen::MatrixXd links = Eigen::MatrixXd::Zero(volume.size(), volume.size());
    for (Eigen::Index i = 0; i < volume.size(); ++i) {
      const double link = line.link[static_cast<std::size_t>(i)];
      links(i, i) += link;
      if (i == 0) continue;
      links(i - 1, i - 1) += link;
      links(i, i - 1) = links(i - 1, i) = -link;
    }
    const auto scale = root.cwiseInverse().asDiagonal();
    SymmetricSpectrum spectrum = symmetric_spectrum(scale * links * scale);
    rate = std::move(spectrum.values);
    shape = std::move(spectrum.vectors);
  }

  Eigen::VectorXd volume, storage, root, rate;
  Eigen::MatrixXd shape;
};

}  // namespace

double LineDiffusion::stable_step() const { return 2.0 / Modes(*this).rate.maxCoeff(); }

std::vector<double> LineDiffusion::exact(std::span<const double> y, double t) const {
  const Modes modes(*this);
  const Eigen::VectorXd begin = Eigen::VectorXd::Map(y.data(), modes.volume.size());
  const Eigen::VectorXd at_start =
      modes.shape.transpose() * modes.root.cwiseProduct(begin.cwiseQuotient(modes.storage));
  const Eigen::VectorXd drawn =
      uptake * (modes.shape.transpose() * modes.volume.cwiseQuotient(modes.root));
  const Eigen::ArrayXd decay = (-t * modes.rate.array()).exp();
  const Eigen::VectorXd mode =
      decay * at_start.array() - drawn.array() * (1.0 - decay) / modes.rate.array();
  const Eigen::VectorXd pressure = (modes.shape * mode).cwiseQuotient(modes.root);
  const Eigen::VectorXd end = (modes.storage.cwiseProduct(pressure).array() + uptake * t).matrix();
  std::vector<double> result(end.begin(), end.end());
  result.push_back(y.back() + modes.volume.dot(begin - end));
  return result;
}

}  // namespace perifrac::test
