#include "app/simulation/probes.hpp"

#include <cmath>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "core/bonds/crack_cut.hpp"
#include "tests/contract/fake_modules.hpp"
#include "tests/contract/scene_text.hpp"

namespace perifrac {
namespace {

std::vector<std::string> columns(const std::string& scene_text, const std::string& field) {
  const Section scene = read_scene_text(
      scene_text, {"output.probes=[{name: here, at: [1 m, 1 m], field: " + field + "}]"});
  Simulation simulation = make_simulation(scene);
  simulation.manager->initialize(0.0);
  std::vector<std::string> names;
  const Probes probes(scene.at("output"), simulation, 0.0);
  for (const HistoryColumn& column : probes.columns()) {
    if (column.name.ends_with(" at here")) names.push_back(column.name);
  }
  return names;
}

TEST(Probes, NameTheComponentsOfVectorsAndTensors) {
  const std::string scene = box_2d + quasi_static_2d;
  EXPECT_THAT(columns(scene, "dilatation"),
              testing::ElementsAre("dilatation at here", "body points read at here"));
  EXPECT_THAT(columns(scene, "displacement"),
              testing::ElementsAre("displacement_x at here", "displacement_y at here",
                                   "body points read at here"));
  EXPECT_THAT(columns(scene, "effective_stress"),
              testing::ElementsAre("effective_stress_xx at here", "effective_stress_xy at here",
                                   "effective_stress_yx at here", "effective_stress_yy at here",
                                   "body points read at here"));
}

using Place = std::vector<double>;
using FieldOfPlace = std::function<double(const Place&)>;

/// A body with one scalar field on it, which a test sets, and one probe.
class Probed {
 public:
  Probed(const std::string& scene_text, const std::string& at,
         std::vector<std::string> overrides = {})
      : scene_(read_scene_text(scene_text, with_probe(std::move(overrides), at))) {
    simulation_.body = make_body(scene_.at("body"), scene_.integer("dimension"));
    const PointSet& points = simulation_.points();
    auto socket = std::make_unique<fake::Socket>(
        std::vector<Port>{{"pore_pressure", "Pa", PortDirection::out}}, &points);
    socket_ = socket.get();
    std::vector<ModuleSlot> modules;
    modules.push_back({"pore_flow", std::move(socket)});
    simulation_.manager =
        std::make_unique<CouplingManager>(std::move(modules), fake::even_windows(0.1));
    simulation_.manager->initialize(0.0);
    probes_.emplace(scene_.at("output"), simulation_, 0.0);
  }

  /// What the probe reads of it, and from how many points.
  std::pair<double, int> read(const FieldOfPlace& field) {
    const PointSet& points = simulation_.points();
    for (std::size_t i = 0; i < points.count; ++i) {
      Place x;
      for (int a = 0; a < points.dimension; ++a) x.push_back(points.position[a][i]);
      socket_->at[0].value[i] = field(x);
    }
    std::vector<double> row;
    probes_->append_values(row);
    return {row.at(0), static_cast<int>(row.at(1))};
  }
  const Body<2>& body() const { return *std::get<0>(simulation_.body); }

 private:
  static std::vector<std::string> with_probe(std::vector<std::string> overrides,
                                             const std::string& at) {
    overrides.push_back(fmt::format("output.probes=[{{name: here, at: {}}}]", at));
    return overrides;
  }

  Section scene_;
  Simulation simulation_{.body = {}, .manager = {}, .end = 1.0};
  fake::Socket* socket_ = nullptr;
  std::optional<Probes> probes_;
};

double linear(const Place& x) {
  return 3.0 + 2.0 * x[0] - 5.0 * x[1] + (x.size() > 2 ? 7.0 * x[2] : 0.0);
}

TEST(Probes, ReadLinearFieldsExactly) {
  for (const Place& place :
       {Place{6.3, 4.1}, {6.0, 5.0}, {6.5, 4.5}, {0.0, 0.0}, {12.0, 3.7}, {0.2, 10.9}}) {
    const std::string at = fmt::format("[{}, {}]", place[0], place[1]);
    EXPECT_NEAR(Probed(box_2d, at).read(linear).first, linear(place), 1e-11) << at;
    EXPECT_NEAR(Probed(box_2d, at, {"body.jitter=0.3"}).read(linear).first, linear(place), 1e-11)
        << at;
    const auto layered = Probed(box_2d, at, {"body.boundary.left=layer"}).read([](const Place& x) {
      return x[0] < 0.0 ? 1e3 : linear(x);  // the layer's values are no part of the body's
    });
    EXPECT_NEAR(layered.first, linear(place), 1e-11) << at;
  }
  const Place place = {3.3, 0.0, 4.6};
  EXPECT_NEAR(Probed(box_3d, "[3.3, 0, 4.6]").read(linear).first, linear(place), 1e-11);
}

TEST(Probes, ReadAPointAtTheirPlaceAlone) {
  const auto wild = [](const Place& x) { return std::sin(5.0 * x[0]) + x[1] * x[1]; };
  const auto [value, points] = Probed(box_2d, "[6.5, 4.5]").read(wild);
  EXPECT_EQ(value, wild({6.5, 4.5}));
  EXPECT_EQ(points, 1);
}

TEST(Probes, AreOfSecondOrder) {
  const auto curved = [](const Place& x) { return std::sin(0.05 * x[0]) * std::cos(0.04 * x[1]); };
  const auto error = [&](const std::string& at, const Place& place, const std::string& spacing) {
    Probed probed(box_2d, at, {"body.spacing=" + spacing});
    return std::abs(probed.read(curved).first - curved(place));
  };
  EXPECT_NEAR(error("[6, 5]", {6, 5}, "1") / error("[6, 5]", {6, 5}, "0.5"), 4.0, 0.3);
  EXPECT_NEAR(error("[12, 11]", {12, 11}, "1") / error("[12, 11]", {12, 11}, "0.5"), 4.0, 0.3);
}

TEST(Probes, NeverReadAcrossACrack) {
  const auto torn = [](const Place& x) { return linear(x) + (x[1] > 5.0 ? 100.0 : 0.0); };
  Probed probed(box_2d, "[6.2, 4.9]");
  EXPECT_GT(probed.read(torn).first, linear({6.2, 4.9}) + 10.0);  // smeared: nothing is torn yet
  const auto family = probed.body().family(0);
  BondState<2>& bonds = probed.body().claim_bond_state();
  const std::uint64_t before = bonds.version();
  for (double x = 0.0; x < 12.0; x += 1.0) {
    const CrackFacet<2> facet = {{{x, 5.0}, {x + 1.0, 5.0}}};
    bonds.add_facet(facet, bonds_cut_by<2>(facet, *family, INFINITY));
  }
  ASSERT_NE(bonds.version(), before);
  EXPECT_NEAR(probed.read(torn).first, linear({6.2, 4.9}), 1e-11);
}

TEST(Probes, NeverReadAcrossBondsThatBrokeWithoutAFacet) {
  const auto torn = [](const Place& x) { return linear(x) + (x[1] > 5.0 ? 100.0 : 0.0); };
  Probed probed(box_2d, "[6.2, 4.9]");
  const auto family = probed.body().family(0);
  const CrackFacet<2> plane = {{{0.0, 5.0}, {12.0, 5.0}}};
  probed.body().claim_bond_state().break_bonds(bonds_cut_by<2>(plane, *family, INFINITY));
  EXPECT_NEAR(probed.read(torn).first, linear({6.2, 4.9}), 1e-11);
}

TEST(Probes, NeverReadAcrossACutOutOrABorder) {
  const std::vector<std::string> notch = {"body.cutouts={slit: {from: [0, 5], to: [8, 6]}}"};
  const auto torn = [](const Place& x) { return linear(x) + (x[1] > 5.5 ? 100.0 : 0.0); };
  EXPECT_NEAR(Probed(box_2d, "[6.2, 4.9]", notch).read(torn).first, linear({6.2, 4.9}), 1e-11);
  const std::vector<std::string> layers = {"body.regions={upper: {from: [0, 5]}}"};
  const auto kinked = [](const Place& x) { return linear(x) + 30.0 * std::max(0.0, x[1] - 5.0); };
  for (const double y : {4.8, 5.2}) {
    const auto [value, points] = Probed(box_2d, fmt::format("[6.2, {}]", y), layers).read(kinked);
    EXPECT_NEAR(value, kinked({6.2, y}), 1e-11);
    EXPECT_GT(points, 3);
  }
}

}  // namespace
}  // namespace perifrac
