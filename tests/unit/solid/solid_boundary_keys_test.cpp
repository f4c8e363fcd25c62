#include "modules/solid/boundary/solid_boundary_keys.hpp"

#include <fstream>
#include <unistd.h>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "core/base/errors.hpp"
#include "core/config/scene.hpp"
#include "modules/solid/material/stress_at_rest.hpp"
#include "tests/unit/solid/elastic_solid.hpp"

namespace perifrac {
namespace {

using testing::HasSubstr;

SolidBoundary<2> read(const Body<2>& body, const std::string& solid, const std::string& top = "") {
  const std::string path =
      testing::TempDir() + "solid_boundary_" + std::to_string(getpid()) + ".yaml";
  std::ofstream(path) << "dimension: 2\n" << top << "solid: {type: any, " << solid << "}\n";
  const Catalogue catalogue = {
      {"",
       "",
       {{.path = "dimension", .type = KeyType::integer, .required = true, .meaning = "Of space."},
        {.path = "gravity", .type = KeyType::vector, .unit = "m/s^2", .meaning = "Gravity."}}},
      {"solid", "any", solid_boundary_keys()},
      {"solid", "any", stress_at_rest_keys()}};
  return read_solid_boundary<2>(read_scene(path, {}, catalogue).at("solid"), body);
}

std::string complaint(const Body<2>& body, const std::string& solid, const std::string& top = "") {
  try {
    read(body, solid, top);
  } catch (const InputError& error) {
    return error.what();
  }
  return "none";
}

TEST(SolidBoundaryKeys, SayWhatTheBuildersSay) {
  const auto body = test::box_body<2>({14, 12}, 0.5);
  const SolidBoundary<2> from_scene = read(
      *body,
      "density: 2000, body_force: [1, 2], body_force_schedule: {times: [0, 9], factors: [1, 3]}, "
      "boundary: {left: {type: roller, normal_displacement: 1 mm, normal_velocity: 2 mm/s,"
      "                  schedule: {ramp: 8 s}},"
      "           bottom: {type: fixed, displacement: [1, 2], velocity: [3, 4]},"
      "           right: {type: traction, traction: [5, 6], schedule: {ramp: 2 s}},"
      "           top: {type: pressure, pressure: 7 kPa, schedule: {ramp: 20 s}}}",
      "gravity: [0, -9.81]\n");
  SolidBoundary<2> built(*body);
  built.roller(0, 1e-3, 2e-3, Schedule::ramp(8.0));
  built.fixed(2, {1.0, 2.0}, {3.0, 4.0});
  built.traction(1, {5.0, 6.0}, Schedule::ramp(2.0));
  built.traction(3, {0.0, -7e3}, Schedule::ramp(20.0));
  built.body_force({1.0, 2.0}, Schedule::table({0.0, 9.0}, {1.0, 3.0}));
  built.body_force({0.0, -2000.0 * 9.81});
  ASSERT_EQ(from_scene.mirrored(), built.mirrored());
  const auto mirror = built.mirror_condition(*body->family(built.mirrored()));
  const auto elastic = test::elastic<2>(*body, built, {1.0, 1.0});
  const ForceOfStress force_of = test::force_of(*elastic);
  Eigen::VectorXd expected(elastic->size()), read_back(elastic->size());
  for (const double t : {0.0, 1.5, 30.0}) {
    built.prescribed(mirror).at(t, expected);
    from_scene.prescribed(mirror).at(t, read_back);
    EXPECT_EQ(read_back, expected);
    EXPECT_NE(expected.norm(), 0.0);
    built.loads(mirror, force_of).at(t, expected);
    from_scene.loads(mirror, force_of).at(t, read_back);
    EXPECT_LT(test::largest(read_back - expected), 1e-13 * test::largest(expected));
  }
}

TEST(SolidBoundaryKeys, RefuseWhatWouldDoNothing) {
  const auto body = test::box_body<2>({6, 6}, 0.5);
  EXPECT_THAT(complaint(*body, "boundary: {left: {type: roller, schedule: {ramp: 1}}}"),
              HasSubstr("solid.boundary.left.schedule: nothing that it could multiply"));
  EXPECT_THAT(complaint(*body, "boundary: {left: {type: free, schedule: {ramp: 1}}}"),
              HasSubstr("solid.boundary.left.schedule: nothing that it could multiply"));
  EXPECT_THAT(complaint(*body, "body_force_schedule: {ramp: 1}"),
              HasSubstr("solid.body_force_schedule: nothing that it could multiply"));
  EXPECT_EQ(complaint(*body, "density: 2000"), "none");
}

TEST(SolidBoundaryKeys, AllowPressureAloneOnASphere) {
  std::vector<Face> faces = test::box_faces<2>({8, 8}, 0.5);
  faces.push_back({"surface", -1, 0, 4.0});
  const Body<2> body(box_lattice<2>({8, 8}, 0.5), faces, 0.5, 1.25, InfluenceFunction::gaussian);
  for (const std::string type :
       {"roller", "fixed", "rigid_plate, force: 1", "traction, traction: [1, 1]"}) {
    EXPECT_THAT(complaint(body, "boundary: {surface: {type: " + type + "}}"),
                HasSubstr("solid.boundary.surface.type: '" + type.substr(0, type.find(',')) +
                          "' on a curved face; expected one of: free, pressure"));
  }
  EXPECT_EQ(complaint(body, "boundary: {surface: {type: free}}"), "none");
  const std::string pressure = "surface: {type: pressure, pressure: 1 MPa}";
  const std::string held = "left: {type: roller}, right: {type: fixed}, bottom: {type: roller}";
  EXPECT_THAT(complaint(body, "boundary: {" + pressure + ", " + held + "}"),
              HasSubstr("solid.boundary.surface: pressure beside the free face 'top'"));
  EXPECT_EQ(complaint(body, "boundary: {" + pressure + ", " + held + ", top: {type: roller}}"),
            "none");
}

}  // namespace
}  // namespace perifrac
