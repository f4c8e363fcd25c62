#pragma once

#include <nlohmann/json.hpp>

#include "core/body/body.hpp"
#include "core/state/state_visitor.hpp"

namespace perifrac {

/// Lists every evolving field and its size; empty ones are those of what is absent.
class ArrayList final : public StateVisitor {
 public:
  nlohmann::json arrays = nlohmann::json::array();

 private:
  void real(const std::string& name, std::vector<double>& values) override {
    add(name, values.size(), sizeof(double));
  }
  void integer(const std::string& name, std::vector<std::int64_t>& values) override {
    add(name, values.size(), sizeof(std::int64_t));
  }
  void add(const std::string& name, std::size_t count, std::size_t size) {
    if (count == 0) return;
    arrays.push_back({{"name", name}, {"count", count}, {"bytes", count * size}});
  }
};

/// Of all families of the body that are in use; 0 without a body.
inline std::size_t family_bytes(const AnyBody& any) {
  return std::visit(
      [](const auto& body) {
        std::size_t bytes = 0;
        if (!body) return bytes;
        for (const auto& family : body->families()) bytes += family->bytes();
        return bytes;
      },
      any);
}

}  // namespace perifrac
