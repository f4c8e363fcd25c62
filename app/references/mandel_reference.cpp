#include "app/references/mandel_reference.hpp"

#include <algorithm>
#include <array>
#include <cmath>

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include "modules/pore_flow/pore_material.hpp"
#include "modules/solid/isotropic_elasticity.hpp"

namespace perifrac {

namespace {

void require_word(const Section& scene, const std::string& path, const std::string& word) {
  if (!scene.has(path) || scene.word(path) != word) {
    scene.fail("reference.type", "this scene is not Mandel's problem",
               fmt::format("{}: {}", path, word));
  }
}

MandelProblem read_problem(const Section& scene) {
  if (scene.integer("dimension") != 2) {
    scene.fail("reference.type", "Mandel's problem is plane", "dimension: 2");
  }
  require_word(scene, "body.shape", "box");
  if (!scene.has("solid") || scene.word("solid.type") != "dynamic") {
    require_word(scene, "solid.type", "quasi_static");
  }
  require_word(scene, "pore_flow.type", "darcy");
  require_word(scene, "solid.boundary.left.type", "roller");
  require_word(scene, "solid.boundary.bottom.type", "roller");
  require_word(scene, "solid.boundary.top.type", "rigid_plate");
  require_word(scene, "pore_flow.boundary.right.type", "pressure");
  const auto elasticity = read_isotropic_elasticity<2>(scene.at("solid"));
  const PoreMaterial pore = read_pore_material(scene.at("pore_flow"));
  const std::vector<double> size = scene.numbers("body.size");
  return {elasticity.lame_lambda,
          elasticity.shear_modulus,
          pore.biot_coefficient,
          pore.storage,
          pore.mobility,
          size[0],
          size[1],
          scene.number("solid.boundary.top.force")};
}

/// Points whose coordinate along `axis` is the smallest, sorted along the other axis.
std::vector<Index> lowest_layer(const Points<2>& points, int axis) {
  const std::vector<double>& across = points.position[axis];
  const std::vector<double>& along = points.position[1 - axis];
  const double least = *std::ranges::min_element(across);
  std::vector<Index> layer;
  for (Index i = 0; i < points.size(); ++i) {
    if (across[i] < least * (1.0 + 1e-9)) layer.push_back(i);
  }
  std::ranges::sort(layer, {}, [&](Index i) { return along[i]; });
  return layer;
}

}  // namespace

MandelReference::MandelReference(const Section& scene, const Simulation& simulation)
    : solution_(read_problem(scene)),
      pressure_(field_named(*simulation.manager, "pore_pressure")),
      plate_(field_named(*simulation.manager, "top_plate_displacement")),
      points_(&std::get<std::shared_ptr<const Body<2>>>(simulation.body)->points()),
      row_(lowest_layer(*points_, 1)) {
  const double width = scene.numbers("body.size")[0];
  for (const double part : {0.0, 0.25, 0.5, 0.75}) {
    const auto nearest = std::ranges::min_element(row_, {}, [&](Index i) {
      return std::abs(points_->position[0][i] - part * width * (1.0 - 1e-9));
    });
    histories_.push_back({*nearest, {}});
  }
}

void MandelReference::record_window(double t) {
  const std::span<const double> p = pressure_.values();
  window_time_.push_back(t);
  for (History& history : histories_) history.computed.push_back(p[history.point]);
}

void MandelReference::record_output(double t) {
  const std::span<const double> p = pressure_.values();
  double largest = 0.0;
  for (Index i = 0; i < points_->size(); ++i) {
    const double exact = solution_.pressure(points_->position[0][i], t);
    largest = std::max(largest, std::abs(p[i] - exact));
  }
  output_time_.push_back(t);
  pressure_error_.push_back(largest / solution_.initial_pressure());
  const double plate = solution_.plate_displacement(t);
  plate_error_.push_back(std::abs(plate_.values()[0] / plate - 1.0));
  for (const Index i : row_) profile_.push_back(p[i]);
}

void MandelReference::visit_state(StateVisitor& visitor) {
  visitor.visit("window_time", window_time_);
  for (std::size_t k = 0; k < histories_.size(); ++k) {
    visitor.visit(fmt::format("history_{}", k), histories_[k].computed);
  }
  visitor.visit("output_time", output_time_);
  visitor.visit("pressure_error", pressure_error_);
  visitor.visit("plate_error", plate_error_);
  visitor.visit("profile", profile_);
}

double MandelReference::peak_error() const {
  const History& middle = histories_.front();
  if (middle.computed.empty()) return 0.0;
  const double computed = *std::ranges::max_element(middle.computed);
  const double exact = solution_.peak_pressure(points_->position[0][middle.point]);
  return std::abs(computed - exact) / solution_.initial_pressure();
}

bool MandelReference::peak_passed() const {
  return !window_time_.empty() && solution_.dimensionless_time(window_time_.back()) > 0.1;
}

nlohmann::json MandelReference::summary() const {
  nlohmann::json result = {{"type", "mandel"}, {"title", "Mandel's analytic solution"}};
  auto& table = result["table"] = nlohmann::json::array();
  for (std::size_t n = 0; n < output_time_.size(); ++n) {
    table.push_back({{"time", output_time_[n]},
                     {"dimensionless_time", solution_.dimensionless_time(output_time_[n])},
                     {"pressure_error", pressure_error_[n]},
                     {"plate_error", plate_error_[n]}});
  }
  if (peak_passed()) {
    const double x = points_->position[0][histories_.front().point];
    result["quantities"] = {{{"name", "Mandel-Cryer peak in the middle / p0"},
                             {"unit", ""},
                             {"max_error", peak_error()},
                             {"at", {{"x", {{"value", x}, {"unit", "m"}}}}}}};
  }

  constexpr std::array places = {"the middle", "a/4", "a/2", "3a/4"};
  for (std::size_t k = 0; k < histories_.size(); ++k) {
    const double x = points_->position[0][histories_[k].point];
    std::vector<double> exact;
    for (const double t : window_time_) exact.push_back(solution_.pressure(x, t));
    result["histories"].push_back({{"name", fmt::format("pore pressure at {}", places[k])},
                                   {"unit", "Pa"},
                                   {"time", window_time_},
                                   {"computed", histories_[k].computed},
                                   {"exact", exact}});
  }
  result["profiles"] = nlohmann::json::array({profile_summary()});
  return result;
}

nlohmann::json MandelReference::profile_summary() const {
  nlohmann::json profile = {{"name", "pore pressure along x"},
                            {"unit", "Pa"},
                            {"x_name", "x"},
                            {"x_unit", "m"},
                            {"times", output_time_},
                            {"x", nlohmann::json::array()},
                            {"computed", nlohmann::json::array()},
                            {"exact", nlohmann::json::array()}};
  std::vector<double> x;
  for (const Index i : row_) x.push_back(points_->position[0][i]);
  for (std::size_t n = 0; n < output_time_.size(); ++n) {
    const auto begin = profile_.begin() + n * row_.size();
    std::vector<double> exact;
    for (const double at : x) exact.push_back(solution_.pressure(at, output_time_[n]));
    profile["x"].push_back(x);
    profile["computed"].push_back(std::vector<double>(begin, begin + row_.size()));
    profile["exact"].push_back(exact);
  }
  return profile;
}

std::string MandelReference::table() const {
  std::string text = fmt::format("{:>12}  {:>8}  {:>18}  {:>18}\n", "time [s]", "ct/a^2",
                                 "max |p - exact|/p0", "plate, relative");
  for (std::size_t n = 0; n < output_time_.size(); ++n) {
    text += fmt::format("{:12.5g}  {:8.4f}  {:18.2e}  {:18.2e}\n", output_time_[n],
                        solution_.dimensionless_time(output_time_[n]), pressure_error_[n],
                        plate_error_[n]);
  }
  if (peak_passed()) {
    text += fmt::format("Mandel-Cryer peak in the middle: {:.2e} p0 off\n", peak_error());
  }
  return text;
}

}  // namespace perifrac
