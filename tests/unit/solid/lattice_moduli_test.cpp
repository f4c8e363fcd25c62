#include <fstream>
#include <sstream>

#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "tests/unit/operators/test_bodies.hpp"
#include "tests/unit/solid/elastic.hpp"

namespace perifrac {
namespace {

/// A rock with K = 5, G = 4: how far a uniaxial modulus is off depends on the ratio of the two.
template <int D>
constexpr IsotropicElasticity<D> rock{5.0 - 8.0 / 3.0, 4.0};

constexpr std::array ratios = {2.0, 2.5, 3.0, 4.0};

/// What is added to a modulus, over the modulus.
struct Errors {
  double uniaxial;
  double shear;
};

template <int D>
using MakeElastic = std::shared_ptr<ElasticOperator<D>> (*)(std::shared_ptr<const Family<D>>,
                                                            MirrorCondition<D, D>);

template <int D>
std::shared_ptr<ElasticOperator<D>> linear_exact(std::shared_ptr<const Family<D>> family,
                                                 MirrorCondition<D, D> mirror) {
  using Law = IsotropicElasticity<D>;
  return std::make_shared<LinearExactElasticity<D, Law>>(
      LinearExactOperator<D, Law>(family, mirror, rock<D>));
}

template <int D>
std::shared_ptr<ElasticOperator<D>> lps(std::shared_ptr<const Family<D>> family,
                                        MirrorCondition<D, D> mirror) {
  return std::make_shared<LpsElasticity<D>>(
      family, mirror,
      LawByRegion<IsotropicElasticity<D>>{{rock<D>},
                                          std::vector<std::uint8_t>(family->point_count)});
}

/// The modulus between the top and the bottom of a body that its mirrored faces make infinite: the
/// stress that the top bears where the component u = the height, over 1.
template <int D>
double modulus(const Body<D>& body, MakeElastic<D> make, int component) {
  const FaceSet all = face_bit(2 * D) - 1;
  const auto family = body.family(all);
  MirrorCondition<D, D> mirror(*family);
  mirror.set_odd(2 * D - 2, component);
  mirror.set_odd(2 * D - 1, component);
  const auto solid = make(family, mirror);
  const Index points = body.points().size();
  std::vector<double> u(solid->size(), 0.0), force(u.size()), dilatation(points);
  const auto& height = body.points().position[D - 1];
  std::ranges::copy(height, u.begin() + component * points);
  double area = 1.0;
  for (int a = 0; a < D - 1; ++a) area *= body.faces()[2 * a + 1].coordinate;
  const int top = D * points + mirror.face_value(2 * D - 1, component);
  u[top] = body.faces()[2 * D - 1].coordinate;
  solid->apply(u, {}, force, dilatation);
  return force[top] / area;
}

template <int D>
Errors errors(MakeElastic<D> make, double spacing, double ratio, InfluenceFunction influence) {
  const auto body =
      test::box_body<D>(test::cube<D>(4), spacing, test::Cloud::lattice, ratio, influence);
  const auto [lambda, mu] = rock<D>;
  return {modulus<D>(*body, make, D - 1) / (lambda + 2.0 * mu) - 1.0,
          modulus<D>(*body, make, 0) / mu - 1.0};
}

/// The same of LPS by its sums over the lattice.
template <int D>
Errors lattice_sums(double ratio, InfluenceFunction influence_function) {
  double m = 0.0, uniaxial = 0.0, shear = 0.0;
  const int reach = 4, width = 2 * reach + 1;
  for (int cell = 0; cell < std::pow(width, D); ++cell) {
    Vector<D> xi;
    double square = 0.0;
    for (int a = 0, rest = cell; a < D; ++a, rest /= width) {
      xi[a] = rest % width - reach;
      square += xi[a] * xi[a];
    }
    const double r = std::sqrt(square);
    if (r == 0.0 || r > ratio * (1.0 + 1e-9)) continue;
    const double w = influence(influence_function, r, ratio);
    m += w * square;
    uniaxial += w * std::pow(xi[D - 1], 4) / square;
    shear += w * std::pow(xi[0] * xi[D - 1], 2) / square;
  }
  const auto [lambda, mu] = rock<D>;
  const double c = (D == 2 ? 8.0 : 15.0) * mu;
  return {(lambda - mu + c * uniaxial / m) / (lambda + 2.0 * mu) - 1.0, c * shear / m / mu - 1.0};
}

constexpr std::array functions = {InfluenceFunction::gaussian, InfluenceFunction::constant,
                                  InfluenceFunction::inverse};

template <int D>
void expect_errors_of_the_lattice() {
  for (const InfluenceFunction influence : functions) {
    for (const double ratio : ratios) {
      const Errors expected = lattice_sums<D>(ratio, influence);
      for (const double spacing : {1.0, 0.5, 0.25}) {
        const Errors found = errors<D>(lps<D>, spacing, ratio, influence);
        EXPECT_NEAR(found.uniaxial, expected.uniaxial, 1e-12) << ratio << " " << spacing;
        EXPECT_NEAR(found.shear, expected.shear, 1e-12) << ratio << " " << spacing;
      }
    }
  }
}

TEST(LatticeModuli, OfLpsAreOffByTheLatticeAndNotByTheSpacing) {
  expect_errors_of_the_lattice<2>();
  expect_errors_of_the_lattice<3>();
}

TEST(LatticeModuli, OfLpsWithTheGaussianAreTooStiffAlongTheAxesAndTooSoftInShear) {
  const std::array expected = {Errors{16.4, -42.4}, Errors{7.5, -19.5}, Errors{3.6, -9.3},
                               Errors{1.1, -2.9}};
  for (std::size_t k = 0; k < ratios.size(); ++k) {
    const auto found = errors<2>(lps<2>, 1.0, ratios[k], InfluenceFunction::gaussian);
    EXPECT_NEAR(100.0 * found.uniaxial, expected[k].uniaxial, 0.05);
    EXPECT_NEAR(100.0 * found.shear, expected[k].shear, 0.05);
  }
}

template <int D>
void expect_exact_moduli() {
  for (const InfluenceFunction influence : functions) {
    for (const double ratio : ratios) {
      const Errors found = errors<D>(linear_exact<D>, 0.5, ratio, influence);
      EXPECT_NEAR(found.uniaxial, 0.0, 1e-13);
      EXPECT_NEAR(found.shear, 0.0, 1e-13);
    }
  }
}

TEST(LatticeModuli, OfTheLinearExactOperatorAreExact) {
  expect_exact_moduli<2>();
  expect_exact_moduli<3>();
}

template <int D>
std::string row(const char* name, InfluenceFunction influence) {
  std::string line = fmt::format("| {}D | {} |", D, name);
  for (const double ratio : ratios) {
    const auto [uniaxial, shear] = errors<D>(lps<D>, 1.0, ratio, influence);
    line += fmt::format(" {:+.1f} / {:+.1f} |", 100.0 * uniaxial, 100.0 * shear);
  }
  return line;
}

TEST(LatticeModuli, StandInTheDocs) {
  std::stringstream page;
  page << std::ifstream(PERIFRAC_SOURCE_DIR "/docs/materials.md").rdbuf();
  const std::array names = {"gaussian", "constant", "inverse"};
  for (std::size_t k = 0; k < functions.size(); ++k) {
    EXPECT_THAT(page.str(), testing::HasSubstr(row<2>(names[k], functions[k])));
    EXPECT_THAT(page.str(), testing::HasSubstr(row<3>(names[k], functions[k])));
  }
}

}  // namespace
}  // namespace perifrac
