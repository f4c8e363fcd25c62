#include "tests/contract/fake_modules.hpp"

#include <gtest/gtest.h>

#include "tests/contract/module_contract.hpp"

namespace perifrac {
namespace {

// The fakes must be held to what they stand in for.
INSTANTIATE_TEST_SUITE_P(
    Fakes, ModuleContract,
    testing::Values(
        ModuleCase{"Springs",
                   [] {
                     return std::make_unique<fake::Springs>(std::vector<double>{1.0, 2.0}, 1.0);
                   },
                   0.1,
                   {{"pore_stress", 0.5}}},
        ModuleCase{"DrainingPores",
                   [] { return std::make_unique<fake::DrainingPores>(3, 0.5, 1.0); },
                   0.1,
                   {{"dilatation", 0.2}}},
        ModuleCase{"Particles",
                   [] { return std::make_unique<fake::Particles>(); },
                   0.4,
                   {{"warmth", 1.0}}},
        ModuleCase{
            "Wall", [] { return std::make_unique<fake::Wall>(); }, 0.4, {{"mass_given", 1.0}}},
        ModuleCase{"Alarm", [] { return std::make_unique<fake::Alarm>(0.15); }, 0.1}),
    case_name);

}  // namespace
}  // namespace perifrac
