#include "app/run/live_line.hpp"

#include <fmt/format.h>

#include "app/simulation/simulation.hpp"

namespace perifrac {

namespace {

/// As it stands on a line: `1 pass each`, `2.4 passes each`.
std::string passes_text(double passes) {
  const std::string number = fmt::format("{:.2g}", passes);
  return fmt::format("{} {} each", number, number == "1" ? "pass" : "passes");
}

}  // namespace

std::string crack_size(const CouplingManager& manager) {
  std::string text;
  for (const Field& field : fields_of(manager)) {
    const bool is_length = field.port.name == "crack_length";
    if (!is_length && field.port.name != "crack_area") continue;
    const auto values = field.values();
    if (values.size() != 1) continue;
    text = fmt::format("crack {} {:.4g} {}", is_length ? "length" : "area", values[0],
                       field.port.unit);
  }
  return text;
}

std::function<std::string()> live_words(const CouplingManager& manager) {
  return [&manager] {
    const auto windows = static_cast<double>(manager.step());
    std::string text;
    if (windows > 0.0) {
      text = ", " + passes_text(static_cast<double>(manager.work().passes) / windows);
    }
    const std::string crack = crack_size(manager);
    return crack.empty() ? text : text + "   " + crack;
  };
}

}  // namespace perifrac
