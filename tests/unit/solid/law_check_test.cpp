// What law_problem() says of laws, of the built-in one and of ones that are wrong in one way each.
#include "modules/solid/material/law_check.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "modules/solid/material/isotropic_elasticity.hpp"
#include "modules/solid/material/tangent_law.hpp"
#include "tests/unit/solid/nonlinear_laws.hpp"

namespace perifrac {
namespace {

using testing::HasSubstr;

template <int D>
constexpr IsotropicElasticity<D> sandstone{4e9, 3e9};

/// Isotropic, with one thing changed.
template <int D>
struct Changed {
  static constexpr int components = D;
  IsotropicElasticity<D> isotropic_rock = sandstone<D>;
  double coupling = 0.0;  ///< of xx by yy, and not of yy by xx
  double spin = 0.0;      ///< stiffness against rotation
  double softening = 0.0;

  std::array<double, D * D> stress(const std::array<double, D * D>& g) const {
    std::array<double, D* D> s = isotropic_rock.stress(g);
    s[0] += coupling * g[D + 1] - softening * g[0];
    s[1] += spin * (g[1] - g[D]);
    s[D] -= spin * (g[1] - g[D]);
    return s;
  }
  double stabilisation() const { return isotropic_rock.stabilisation(); }
  double drained_bulk_modulus() const { return isotropic_rock.drained_bulk_modulus(); }
  const IsotropicElasticity<D>& isotropic() const { return isotropic_rock; }
};

template <int D>
void hold_laws() {
  for (const double size : {1e-6, 1e-3, 1.0}) EXPECT_EQ(law_problem<D>(sandstone<D>, size), "");
  EXPECT_EQ(law_problem<D>(Changed<D>{}), "");
  EXPECT_EQ(law_problem<D>(TangentLaw<D>::of(Changed<D>{})), "");
  EXPECT_THAT(law_problem<D>(Changed<D>{.coupling = 1e8}), HasSubstr("not the derivative"));
  EXPECT_THAT(law_problem<D>(Changed<D>{.spin = 1e8}), HasSubstr("rotation alone"));
  EXPECT_THAT(law_problem<D>(Changed<D>{.softening = 1e11}), HasSubstr("does not resist"));
}

TEST(LawCheck, TellsLawsFromWhatAreNone2d) { hold_laws<2>(); }
TEST(LawCheck, TellsLawsFromWhatAreNone3d) { hold_laws<3>(); }

/// Flow with one thing changed.
template <int D>
struct Flowing : test::Hardening<D> {
  double heat = 1.0, skew = 0.0, creep = 0.0;

  using Gradient = Tensor<D, D>;
  Gradient stress(const Gradient& g, const Gradient& plastic) const {
    Gradient s = test::Hardening<D>::stress(g, plastic);
    s[1] += skew * g[0];
    return s;
  }
  double follow(const Gradient& g, Gradient& plastic, double seconds) const {
    const double found = test::Hardening<D>::follow(g, plastic, seconds);
    plastic[0] += creep;
    plastic[D + 1] -= creep;
    return heat * found;
  }
};

template <int D>
void hold_with_memory() {
  const test::Hardening<D> good{sandstone<D>, 4e6, 1e9};
  for (const double size : {1e-4, 1e-3, 1e-2}) EXPECT_EQ(law_problem<D>(good, size), "");
  EXPECT_EQ(law_problem<D>(Flowing<D>{good}), "");
  EXPECT_THAT(law_problem<D>(Flowing<D>{good, 0.5}), HasSubstr("into heat"));
  EXPECT_THAT(law_problem<D>(Flowing<D>{good, 1.0, 1e9}), HasSubstr("derivative"));
  EXPECT_NE(law_problem<D>(Flowing<D>{good, 1.0, 0.0, 1e-4}), "");
}

TEST(LawCheck, TellsMemoriesFromWhatAreNone2d) { hold_with_memory<2>(); }
TEST(LawCheck, TellsMemoriesFromWhatAreNone3d) { hold_with_memory<3>(); }

TEST(LawCheck, ATangentIsTheLawAtRest) {
  const auto tangent = TangentLaw<3>::of(Changed<3>{});
  const std::array<double, 9> gradient{1e-3, 2e-3, 0.0, 5e-4, -1e-3, 3e-3, 1e-4, 0.0, 2e-3};
  const auto expected = sandstone<3>.stress(gradient), found = tangent.stress(gradient);
  for (int k = 0; k < 9; ++k) EXPECT_NEAR(found[k], expected[k], 1e-8 * 4e7);
}

}  // namespace
}  // namespace perifrac
