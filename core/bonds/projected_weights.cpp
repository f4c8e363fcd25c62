#include "core/bonds/projected_weights.hpp"

#include <algorithm>
#include <cmath>

#include <Eigen/Cholesky>
#include <Eigen/SparseCore>
#include <fmt/format.h>

#include "core/base/errors.hpp"
#include "core/base/small_vector.hpp"
#include "core/bonds/bond_traversal.hpp"
#include "core/bonds/shape_tensor.hpp"
#include "core/solvers/conjugate_gradients.hpp"
#include "core/solvers/sparse_cholesky.hpp"

namespace perifrac {

namespace {

constexpr int most_steps = 40;
/// Of the moments, relative to k; and what an iterated step leaves of its residual.
constexpr double factored_tolerance = 1e-12, iterated_tolerance = 2e-3, left_by_step = 0.1;
constexpr int most_iterations = 3000;
constexpr double left_by_last_factor = 1e-3;
constexpr int iterations_worth_a_factor = 20;
constexpr Index points_worth_a_factor = 600;
constexpr double longest_step = 2.0;  // the most that one step may change ln s
constexpr double least_factor = 1e-4, largest_factor = 1e2;

/// Of all factors that give the moments the projection takes those nearest to 1, in the sense of
///   least sum_i sum_j V_i w_ij (s ln s - s + 1),
/// which are s_ij = exp(t . (z_i + parity z_j)), t = (xi, xi xi^T): positive whatever the
/// multipliers z, one a point and moment. The multipliers minimise a convex function; Newton's
/// method finds them.
///
/// In 3D a factor fills up beyond some hundred points. There its steps are found by conjugate
/// gradients, and to less: where z is a smooth field and its second moments half its gradient,
/// weights hardly change, not at all up to z of second order. What is left over there takes by far
/// the most iterations.
template <int D>
class MomentProjection {
 public:
  static constexpr int T = D + D * (D + 1) / 2;
  using Moments = std::array<double, T>;
  using Block = Eigen::Matrix<double, T, T>;

  MomentProjection(Family<D>& family, std::span<const Face> faces, FaceSet mirrored, double horizon)
      : family_(family), plain_(family.weight), length_(horizon), number_(family.point_count, -1) {
    family.weight.unpack();
    for (Index i = 0; i < family.point_count; ++i) {
      bool complete = true;
      for (std::size_t f = 0; f < faces.size(); ++f) {
        const Face& face = faces[f];
        const double depth = face.direction * (face.coordinate - family.position[face.axis][i]);
        complete = complete && (contains(mirrored, static_cast<int>(f)) || depth >= horizon);
      }
      if (complete) number_[i] = complete_count_++;
    }
  }

  WeightProjection project() {
    WeightProjection done;
    done.complete_points = complete_count_;
    if (complete_count_ == 0) return done;
    target_ = mean_moment();
    const bool is_large = D == 3 && complete_count_ > points_worth_a_factor;
    const Index size = T * complete_count_;
    Eigen::VectorXd multiplier = Eigen::VectorXd::Zero(size), residual(size), step(size);
    while (find_residual(residual) > (is_large ? iterated_tolerance : factored_tolerance)) {
      if (++done.steps > most_steps) refuse("do not exist");
      try {
        is_large ? find_step_by_iteration(residual, step) : find_step_by_factor(residual, step);
      } catch (const NotPositiveDefinite&) {
        refuse("do not exist");
      } catch (const NotConverged&) {
        refuse("were not found");
      }
      multiplier -= std::min(1.0, longest_step / largest_exponent(step)) * step;
      set_weights(multiplier);
      find_range(done);
    }
    return done;
  }

 private:
  [[noreturn]] static void refuse(const std::string& problem) {
    throw BodyError("the factors that would give its points the moments of a lattice " + problem,
                    "a larger horizon_ratio, a more regular cloud, or weights: plain");
  }

  /// Where no factors would do, those of Newton's steps grow beyond bounds.
  void find_range(WeightProjection& done) const {
    done.least_factor = done.largest_factor = 1.0;
    for (Index i = 0; i < family_.point_count; ++i) {
      for (Index k = 0; k < family_.bond_count(i); ++k) {
        const double factor = family_.weight(i, k) / plain_(i, k);
        done.least_factor = std::min(done.least_factor, factor);
        done.largest_factor = std::max(done.largest_factor, factor);
      }
    }
    if (done.least_factor < least_factor || done.largest_factor > largest_factor) {
      refuse(fmt::format("range from {:.2g} to {:.2g}", done.least_factor, done.largest_factor));
    }
  }

  double mean_moment() const {
    double sum = 0.0, volume = 0.0;
    for (Index i = 0; i < family_.point_count; ++i) {
      if (number_[i] < 0) continue;
      const auto shape = shape_tensor_at(family_, i);
      for (int a = 0; a < D; ++a) sum += family_.volume[i] * shape[a * D + a];
      volume += family_.volume[i];
    }
    return sum / (D * volume * length_ * length_);
  }

  Moments moments_of(const Vector<D>& xi) const {
    Moments t;
    int k = 0;
    for (int a = 0; a < D; ++a) t[k++] = xi[a] / length_;
    for (int a = 0; a < D; ++a) {
      for (int b = a; b < D; ++b) t[k++] = t[a] * t[b];
    }
    return t;
  }

  Vector<D> bond_vector(Index i, Index j) const {
    return vector_at(family_.position, j) - vector_at(family_.position, i);
  }

  Index source_of(Index node) const {
    return node < family_.point_count ? node : family_.ghost_source[node - family_.point_count];
  }

  /// What the multipliers of a bond's other end are taken times. Seen from there the bond's first
  /// moment has changed sign; a ghost's multipliers are its source's, reflected.
  Moments end_signs(Index node) const {
    const bool real = node < family_.point_count;
    const FaceSet faces = real ? 0 : family_.ghost_faces[node - family_.point_count];
    Vector<D> reflected;
    for (int a = 0; a < D; ++a) {
      reflected[a] = contains(faces, 2 * a) != contains(faces, 2 * a + 1) ? -1.0 : 1.0;
    }
    Moments sign;
    int k = 0;
    for (int a = 0; a < D; ++a) sign[k++] = -reflected[a];
    for (int a = 0; a < D; ++a) {
      for (int b = a; b < D; ++b) sign[k++] = reflected[a] * reflected[b];
    }
    return sign;
  }

  /// The multipliers of all nodes as bonds that end there take them; 0 where there are none.
  void spread(const Eigen::VectorXd& multiplier) {
    at_node_.resize(static_cast<std::size_t>(T) * family_.node_count());
    for_each_point(family_.node_count(), [&](Index node) {
      const Index n = number_[source_of(node)];
      const Moments sign = end_signs(node);
      for (int k = 0; k < T; ++k) {
        at_node_[T * node + k] = n < 0 ? 0.0 : sign[k] * multiplier[T * n + k];
      }
    });
  }

  /// A point's own, as its bonds take them.
  Moments own_multipliers(const Eigen::VectorXd& multiplier, Index i) const {
    Moments own{};
    for (int k = 0; k < T && number_[i] >= 0; ++k) own[k] = multiplier[T * number_[i] + k];
    return own;
  }

  /// ln s of a bond with moments t to a node, after spread().
  double exponent(const Moments& own, Index node, const Moments& t) const {
    double sum = 0.0;
    for (int k = 0; k < T; ++k) sum += t[k] * (own[k] + at_node_[T * node + k]);
    return sum;
  }

  /// Calls use(k, ln s) for every bond of a point, after spread().
  template <class Use>
  void for_exponents(const Eigen::VectorXd& multiplier, Index i, Use&& use) const {
    const Moments own = own_multipliers(multiplier, i);
    const PointBonds bonds = family_.bonds(i);
    for (Index k = 0; k < bonds.count(); ++k) {
      const Index node = bonds.other(k);
      use(k, exponent(own, node, moments_of(bond_vector(i, node))));
    }
  }

  double largest_exponent(const Eigen::VectorXd& multiplier) {
    spread(multiplier);
    double largest = 0.0;
    for (Index i = 0; i < family_.point_count; ++i) {
      for_exponents(multiplier, i,
                    [&](Index, double e) { largest = std::max(largest, std::abs(e)); });
    }
    return largest;
  }

  void set_weights(const Eigen::VectorXd& multiplier) {
    spread(multiplier);
    for_each_point(family_.point_count, [&](Index i) {
      for_exponents(multiplier, i, [&](Index k, double e) {
        family_.weight.set(i, k, plain_(i, k) * std::exp(e));
      });
    });
  }

  /// What the moments are off, times V_i; returns the largest of them relative to k.
  double find_residual(Eigen::VectorXd& residual) const {
    double largest = 0.0;
    for (Index i = 0; i < family_.point_count; ++i) {
      if (number_[i] < 0) continue;
      Moments r = sum_over_bonds<T>(family_, i, [&](Index, const Vector<D>& xi, double w) {
        Moments t = moments_of(xi);
        for (double& value : t) value *= w;
        return t;
      });
      for (int a = 0, k = D; a < D; k += D - a++) r[k] -= target_;
      for (int k = 0; k < T; ++k) {
        residual[T * number_[i] + k] = family_.volume[i] * r[k];
        largest = std::max(largest, std::abs(r[k]) / target_);
      }
    }
    return largest;
  }

  /// The factor of an earlier step is near enough to precondition the next ones.
  void find_step_by_factor(const Eigen::VectorXd& residual, Eigen::VectorXd& step) {
    if (is_factored_ && find_step_by_last_factor(residual, step)) return;
    newton_.factor(derivative());
    is_factored_ = true;
    newton_.solve(residual, step);
  }

  bool find_step_by_last_factor(const Eigen::VectorXd& residual, Eigen::VectorXd& step) {
    Eigen::VectorXd left = residual;
    step.setZero();
    try {
      ConjugateGradients().correct(
          left, step, left_by_last_factor * residual.norm(), iterations_worth_a_factor,
          [this](const Eigen::VectorXd& change, Eigen::VectorXd& image) {
            apply_derivative(change, image);
          },
          [this](const Eigen::VectorXd& of, Eigen::VectorXd& correction) {
            newton_.solve(of, correction);
          });
    } catch (const NotConverged&) {
      return false;
    }
    return true;
  }

  void find_step_by_iteration(const Eigen::VectorXd& residual, Eigen::VectorXd& step) {
    const auto blocks = inverse_blocks();
    const auto precondition = [&](const Eigen::VectorXd& left, Eigen::VectorXd& correction) {
      for_each_point(complete_count_, [&](Index n) {
        correction.segment<T>(T * n) = blocks[n].template cast<double>() * left.segment<T>(T * n);
      });
    };
    const auto apply = [this](const Eigen::VectorXd& change, Eigen::VectorXd& image) {
      apply_derivative(change, image);
    };
    Eigen::VectorXd left = residual;
    step.setZero();
    ConjugateGradients().correct(left, step, left_by_step * residual.norm(), most_iterations, apply,
                                 precondition);
  }

  /// image = derivative() change.
  void apply_derivative(const Eigen::VectorXd& change, Eigen::VectorXd& image) {
    spread(change);
    for_each_point(family_.point_count, [&](Index i) {
      if (number_[i] < 0) return;
      const Moments own = own_multipliers(change, i);
      const auto sum =
          sum_over_bonds<T>(family_, i, [&](Index node, const Vector<D>& xi, double w) {
            Moments t = moments_of(xi);
            const double weight = w * exponent(own, node, t);
            for (double& value : t) value *= weight;
            return t;
          });
      for (int k = 0; k < T; ++k) image[T * number_[i] + k] = family_.volume[i] * sum[k];
    });
  }

  /// By complete point, of what derivative() says of it alone.
  std::vector<Eigen::Matrix<float, T, T>> inverse_blocks() const {
    std::vector<Eigen::Matrix<float, T, T>> inverse(complete_count_);
    for_each_point(family_.point_count, [&](Index i) {
      if (number_[i] < 0) return;
      const auto sum = sum_over_bonds<T * T>(family_, i, [&](Index, const Vector<D>& xi, double w) {
        const Moments t = moments_of(xi);
        std::array<double, T * T> square;
        for (int k = 0; k < T; ++k) {
          for (int l = 0; l < T; ++l) square[k * T + l] = w * t[k] * t[l];
        }
        return square;
      });
      const Block block = family_.volume[i] * Eigen::Map<const Block>(sum.data());
      inverse[number_[i]] = block.llt().solve(Block::Identity()).template cast<float>();
    });
    return inverse;
  }

  /// The derivative of the residual by the multipliers, its lower half: symmetric and positive
  /// definite, as the second derivative of what they minimise.
  Eigen::SparseMatrix<double> derivative() const {
    std::vector<Eigen::Triplet<double>> entries;
    for (Index i = 0; i < family_.point_count; ++i) {
      if (number_[i] < 0) continue;
      const Index row = T * number_[i];
      Moments sign;
      sign.fill(1.0);
      const auto add = [&](Index column, const Moments& t, double c, const Moments& signs) {
        for (int k = 0; k < T; ++k) {
          for (int l = 0; l < (row == column ? k + 1 : T); ++l) {
            entries.emplace_back(row + k, column + l, c * t[k] * t[l] * signs[l]);
          }
        }
      };
      for (const auto& [node, weight] : family_.bonds(i)) {
        const Moments t = moments_of(bond_vector(i, node));
        const double c = family_.volume[i] * weight;
        add(row, t, c, sign);
        const Index column = T * number_[source_of(node)];
        if (column >= 0 && column <= row) add(column, t, c, end_signs(node));
      }
    }
    Eigen::SparseMatrix<double> matrix(T * complete_count_, T * complete_count_);
    matrix.setFromTriplets(entries.begin(), entries.end());
    return matrix;
  }

  Family<D>& family_;
  const BondWeights plain_;    ///< the weights before
  double length_;              ///< bond vectors are measured in it
  std::vector<Index> number_;  ///< of a complete point, -1 at others
  Index complete_count_ = 0;
  double target_ = 0.0;          ///< k
  std::vector<double> at_node_;  ///< spread() multipliers, T a node
  SparseCholesky newton_;
  bool is_factored_ = false;
};

}  // namespace

template <int D>
WeightProjection project_weights(Family<D>& family, std::span<const Face> faces, FaceSet mirrored,
                                 double horizon) {
  return MomentProjection<D>(family, faces, mirrored, horizon).project();
}

template WeightProjection project_weights<2>(Family<2>&, std::span<const Face>, FaceSet, double);
template WeightProjection project_weights<3>(Family<3>&, std::span<const Face>, FaceSet, double);

}  // namespace perifrac
