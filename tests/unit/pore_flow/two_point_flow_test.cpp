#include "modules/pore_flow/finite_volume/two_point_flow.hpp"

#include <cmath>

#include <fmt/format.h>
#include <gtest/gtest.h>

#include "core/bonds/crack_cut.hpp"
#include "core/geometry/voronoi.hpp"
#include "core/solvers/sparse_cholesky.hpp"
#include "core/solvers/symmetric_spectrum.hpp"
#include "tests/unit/pore_flow/pore_body.hpp"

namespace perifrac {
namespace {

using test::Cloud;

template <int D>
using CellLaw = LawByRegion<AnisotropicDarcyLaw<D>>;

template <int D>
Tensor<D, D> diagonal(const Vector<D>& values) {
  Tensor<D, D> tensor{};
  for (int a = 0; a < D; ++a) tensor[a * D + a] = values[a];
  return tensor;
}

template <int D>
CellLaw<D> uniform_law(const Body<D>& body, double mobility = 1.0) {
  Vector<D> values;
  values.fill(mobility);
  return {{{diagonal<D>(values)}}, std::vector<std::uint8_t>(body.points().size(), 0)};
}

template <int D>
struct CellFlow {
  std::shared_ptr<const Body<D>> body;
  Family<D> no_ghosts;
  std::unique_ptr<TwoPointFlow<D>> op;

  /// Faces in `pressures` have a face value, those in `sealed` are known to let nothing through.
  CellFlow(std::shared_ptr<const Body<D>> made, Cloud cloud, FaceSet sealed, FaceSet pressures,
           CellLaw<D> law, std::vector<HeldPoint> held = {})
      : body(std::move(made)) {
    MirrorCondition<D, 1> mirror(no_ghosts);
    for (int face = 0; face < 2 * D; ++face) {
      if (contains(pressures, face)) mirror.set_odd(face, 0);
    }
    const CellFaces<D> walls =
        cloud == Cloud::lattice
            ? lattice_cell_faces(body->points(), body->faces(), body->spacing())
            : voronoi_cell_faces(body->points(), body->faces(), body->spacing());
    op = std::make_unique<TwoPointFlow<D>>(body, walls,
                                           OuterWalls<D>{sealed, mirror, std::move(held)}, law);
  }
  CellFlow(std::shared_ptr<const Body<D>> made, Cloud cloud, FaceSet sealed, FaceSet pressures)
      : CellFlow(made, cloud, sealed, pressures, uniform_law<D>(*made)) {}

  std::vector<double> apply(const std::vector<double>& p) const {
    std::vector<double> outflow(op->size());
    op->apply(p, outflow);
    return outflow;
  }
  std::vector<double> velocity(const std::vector<double>& p) const {
    std::vector<double> v(D * op->point_count());
    op->velocity(p, v);
    return v;
  }
  /// Pressures of a field at the points, then of the faces.
  template <class Field>
  std::vector<double> values(Field&& field, std::vector<double> faces = {}) const {
    std::vector<double> p;
    for (Index i = 0; i < op->point_count(); ++i) p.push_back(field(op->place(i)));
    p.insert(p.end(), faces.begin(), faces.end());
    return p;
  }
};

constexpr std::array clouds = {Cloud::lattice, Cloud::jittered};

template <int D>
void expect_matrix_of_what_is_applied() {
  for (const Cloud cloud : clouds) {
    const auto body = test::box_body<D>(test::cube<D>(7), 0.5, cloud);
    CellFlow<D> flow(body, cloud, 0b0100, D == 2 ? 0b1010 : 0b010010);
    for (const bool scaled : {false, true}) {
      if (scaled) {
        std::vector<double> factor = test::random_values(body->points().size(), 3);
        for (double& value : factor) value = 1.0 + 0.5 * value;
        flow.op->scale_mobility(factor);
      }
      const auto p = test::random_values(flow.op->size());
      const auto outflow = flow.apply(p);
      const Eigen::MatrixXd h = flow.op->assemble();
      const Eigen::VectorXd difference = h * test::as_eigen(p) - test::as_eigen(outflow);
      EXPECT_LT(test::largest(difference), 1e-14 * test::largest(outflow));
      // Equal and opposite; what leaves the points leaves by the faces.
      EXPECT_EQ((h - h.transpose()).cwiseAbs().maxCoeff(), 0.0);
      EXPECT_LT(h.colwise().sum().cwiseAbs().maxCoeff(), 2e-15 * h.cwiseAbs().maxCoeff());
    }
  }
}

TEST(TwoPointFlow, AppliesTheMatrixThatItAssembles) {
  expect_matrix_of_what_is_applied<2>();
  expect_matrix_of_what_is_applied<3>();
}

template <int D>
void expect_one_null_mode(const std::array<int, D>& counts) {
  for (const Cloud cloud : clouds) {
    const CellFlow<D> flow(test::box_body<D>(counts, 0.5, cloud), cloud, ~0u, 0);
    const Eigen::VectorXd values = symmetric_spectrum(Eigen::MatrixXd(flow.op->assemble())).values;
    const double top = values[values.size() - 1];
    EXPECT_LT(std::abs(values[0]), 1e-14 * top);
    EXPECT_GT(values[1], 1e-2 * top);
  }
}

TEST(TwoPointFlow, HasOnlyUniformPressureAsNullMode) {
  expect_one_null_mode<2>({8, 7});
  expect_one_null_mode<3>({5, 4, 6});
}

/// Patch test: linear pressures of any direction inside, and along every axis from face to face.
template <int D>
void expect_exact_for_linear_fields(Cloud cloud) {
  constexpr Vector<3> slope = {2.0, 1.4, -0.9};
  const auto body = test::box_body<D>(test::cube<D>(D == 2 ? 14 : 7), 0.5, cloud);
  const double length = 0.5 * (D == 2 ? 14 : 7);
  const CellFlow<D> free(body, cloud, 0, 0);
  const auto p = free.values([&](const Vector<D>& x) {
    double sum = 0.3;
    for (int a = 0; a < D; ++a) sum += slope[a] * x[a];
    return sum;
  });
  const auto outflow = free.apply(p), velocity = free.velocity(p);
  std::vector<bool> outside(body->points().size(), false);
  for (const auto& wall :
       (cloud == Cloud::lattice ? lattice_cell_faces(body->points(), body->faces(), 0.5)
                                : voronoi_cell_faces(body->points(), body->faces(), 0.5))
           .outer) {
    outside[wall.i] = true;
  }
  const Index n = body->points().size();
  for (Index i = 0; i < n; ++i) {
    if (!outside[i]) {
      EXPECT_NEAR(outflow[i] / body->points().volume[i], 0.0, 1e-10) << i;
    }
    for (int a = 0; a < D; ++a) EXPECT_NEAR(velocity[a * n + i], -slope[a], 1e-11) << i;
  }
  for (int a = 0; a < D; ++a) {
    const FaceSet held = face_bit(2 * a) | face_bit(2 * a + 1);
    const CellFlow<D> through(body, cloud, ~held, held);
    const auto linear = through.values([&](const Vector<D>& x) { return 3.0 - 2.0 * x[a]; },
                                       {3.0, 3.0 - 2.0 * length});
    const auto flux = through.apply(linear), v = through.velocity(linear);
    for (Index i = 0; i < n; ++i) {
      EXPECT_NEAR(flux[i] / body->points().volume[i], 0.0, 1e-10) << i;
      for (int b = 0; b < D; ++b) EXPECT_NEAR(v[b * n + i], b == a ? 2.0 : 0.0, 1e-11) << i;
    }
    EXPECT_NEAR(flux[n] / (2.0 * body->area(2 * a)), 1.0, 1e-12);
    EXPECT_NEAR(flux[n + 1] / (2.0 * body->area(2 * a)), -1.0, 1e-12);
  }
}

TEST(TwoPointFlow, IsExactForLinearFields) {
  for (const Cloud cloud : clouds) {
    expect_exact_for_linear_fields<2>(cloud);
    expect_exact_for_linear_fields<3>(cloud);
  }
}

/// Through layers of any mobility, also across one of a single row, the flux is that of their
/// resistances, and every pressure is exact.
TEST(TwoPointFlow, IsExactThroughLayers) {
  const std::vector<double> mobility = {1.0, 1e-3, 40.0, 0.7};
  const auto body = test::box_body<2>({12, 5}, 0.5);
  CellLaw<2> law = uniform_law<2>(*body);
  law.laws.clear();
  for (const double k : mobility) law.laws.push_back({diagonal<2>({k, 1.0})});
  const auto rock_at = [](double x) { return x < 2.0 ? 0 : x < 2.5 ? 1 : x < 4.0 ? 2 : 3; };
  for (Index i = 0; i < body->points().size(); ++i) {
    law.law_of_point[i] = static_cast<std::uint8_t>(rock_at(body->points().at(i)[0]));
  }
  const CellFlow<2> flow(body, Cloud::lattice, 0b1100, 0b0011, law);
  const double flux = 1.0 / (2.0 / 1.0 + 0.5 / 1e-3 + 1.5 / 40.0 + 2.0 / 0.7);
  const auto exact = [&](double x) {
    double p = 1.0;
    for (const auto [from, to, k] : {std::array{0.0, 2.0, 1.0}, std::array{2.0, 2.5, 1e-3},
                                     std::array{2.5, 4.0, 40.0}, std::array{4.0, 6.0, 0.7}}) {
      p -= flux / k * std::clamp(x - from, 0.0, to - from);
    }
    return p;
  };
  const auto p = flow.values([&](const Vector<2>& x) { return exact(x[0]); }, {1.0, 0.0});
  const auto outflow = flow.apply(p), velocity = flow.velocity(p);
  const Index n = body->points().size();
  for (Index i = 0; i < n; ++i) {
    EXPECT_NEAR(outflow[i], 0.0, 1e-13) << i;
    EXPECT_NEAR(velocity[i] / flux, 1.0, 1e-10) << i;
  }
  EXPECT_NEAR(outflow[n] / (2.5 * flux), 1.0, 1e-12);
}

TEST(TwoPointFlow, CarriesTensorsAlongTheAxes) {
  const auto body = test::box_body<3>({6, 6, 6}, 0.5);
  CellLaw<3> law = uniform_law<3>(*body);
  law.laws = {{diagonal<3>({3.0, 0.5, 0.0})}};
  const CellFlow<3> flow(body, Cloud::lattice, 0, 0, law);
  const auto v = flow.velocity(
      flow.values([](const Vector<3>& x) { return 2.0 * x[0] - 1.4 * x[1] + 7.0 * x[2]; }));
  const Index n = body->points().size();
  for (Index i = 0; i < n; ++i) {
    EXPECT_NEAR(v[i], -6.0, 1e-12);
    EXPECT_NEAR(v[n + i], 0.7, 1e-12);
    EXPECT_EQ(v[2 * n + i], 0.0);
  }
  EXPECT_NEAR(flow.op->mobility(0), 3.5 / 3.0, 1e-15);
}

/// p - Laplace(p) = q with p = g(x) g(y), g = 3 x^2 - 2 x^3 + 1 flat at the faces, which are
/// sealed; or p = sin(pi x / 2) g(y), of no pressure on the left.
double worst_error(int count, Cloud cloud, bool held) {
  const auto body = test::box_body<2>({count, count}, 1.0 / count, cloud);
  const Points<2>& points = body->points();
  Points<2> cells = points;
  set_voronoi_volumes<2>(cells, {0.0, 0.0}, {1.0, 1.0}, 1.0 / count);
  const CellFlow<2> flow(body, cloud, held ? 0b1110 : 0b1111, held ? 0b0001 : 0);
  Eigen::VectorXd exact(points.size()), right_side(points.size());
  for (Index i = 0; i < points.size(); ++i) {
    const auto [x, y] = points.at(i);
    const auto g = [](double s) { return s * s * (3.0 - 2.0 * s) + 1.0; };
    const double k = 0.5 * std::numbers::pi;
    const double of_x = held ? std::sin(k * x) : g(x);
    const double curvature = (held ? -k * k : (6.0 - 12.0 * x) / g(x)) + (6.0 - 12.0 * y) / g(y);
    exact[i] = of_x * g(y);
    right_side[i] = cells.volume[i] * exact[i] * (1.0 - curvature);
  }
  Eigen::SparseMatrix<double> matrix =
      flow.op->assemble().topLeftCorner(points.size(), points.size());
  for (Index i = 0; i < points.size(); ++i) matrix.coeffRef(i, i) += cells.volume[i];
  SparseCholesky factor;
  factor.factor(matrix);
  Eigen::VectorXd p(points.size());
  factor.solve(right_side, p);
  return test::largest(p - exact);
}

TEST(TwoPointFlow, ConvergesToSecondOrder) {
  for (const Cloud cloud : clouds) {
    for (const bool held : {false, true}) {
      const std::vector<int> counts = {16, 32, 64};
      std::vector<double> errors;
      for (const int count : counts) errors.push_back(worst_error(count, cloud, held));
      // Of both halvings: the largest error of a cloud is at one of its points, by chance.
      const double order = 0.5 * std::log2(errors[0] / errors[2]);
      const std::string name = fmt::format("{}_{}", cloud == Cloud::lattice ? "lattice" : "voronoi",
                                           held ? "held" : "sealed");
      std::printf("two-point flow, %s: %.2e %.2e %.2e, order %.2f\n", name.c_str(), errors[0],
                  errors[1], errors[2], order);
      EXPECT_GT(order, cloud == Cloud::lattice ? 1.9 : 1.6) << name;
    }
  }
}

/// A crack from face to face: neither side feels the other, whatever runs through it; mended, they
/// conduct again, to the bit.
TEST(TwoPointFlow, LetsNothingThroughACrack) {
  for (const Cloud cloud : clouds) {
    const auto body = test::box_body<2>({12, 9}, 0.5, cloud);
    CellFlow<2> flow(body, cloud, ~0u, 0);
    const Eigen::MatrixXd intact = flow.op->assemble();
    const auto family = body->family(0);
    BondState<2> bonds, mended(7);
    for (int k = 0; k < 13; ++k) {
      const CrackFacet<2> facet = {
          {{0.5 * k - 0.2, 2.3 + 0.06 * k}, {0.5 * k + 0.3, 2.36 + 0.06 * k}}};
      bonds.add_facet(facet, bonds_cut_by<2>(facet, *family, INFINITY));
    }
    flow.op->follow(bonds);
    const auto above = [&](const Vector<2>& x) { return x[1] > 2.3 + 0.12 * (x[0] + 0.2); };
    const auto p = flow.values([&](const Vector<2>& x) { return above(x) ? 1.0 : 0.0; });
    EXPECT_EQ(test::largest(flow.apply(p)), 0.0);
    const Eigen::MatrixXd h = flow.op->assemble();
    EXPECT_EQ((h - h.transpose()).cwiseAbs().maxCoeff(), 0.0);
    const Eigen::VectorXd values = symmetric_spectrum(h).values;
    EXPECT_LT(values[1], 1e-14 * values[values.size() - 1]);
    EXPECT_GT(values[2], 1e-3 * values[values.size() - 1]);
    flow.op->follow(mended);
    EXPECT_EQ((Eigen::MatrixXd(flow.op->assemble()) - intact).cwiseAbs().maxCoeff(), 0.0);
  }
}

/// Cells of a thin cloud may meet although their points are beyond the horizon: no bond breaks
/// between them, the crack itself tells.
TEST(TwoPointFlow, LetsNothingThroughACrackBetweenDistantPoints) {
  Points<2> points;
  points.add({1.0, 1.0}, 8.0);
  points.add({1.0, 7.0}, 8.0);
  const auto body = std::make_shared<const Body<2>>(points, test::box_faces<2>({2, 8}, 1.0), 1.0,
                                                    2.5, InfluenceFunction::gaussian);
  CellFlow<2> flow(body, Cloud::jittered, ~0u, 0);
  EXPECT_NEAR(flow.apply({1.0, 0.0})[0], 2.0 / 6.0, 1e-14);
  BondState<2> bonds;
  bonds.add_facet({{{0.0, 3.0}, {2.0, 3.0}}}, {});
  flow.op->follow(bonds);
  EXPECT_EQ(flow.apply({1.0, 0.0})[0], 0.0);
}

}  // namespace
}  // namespace perifrac
