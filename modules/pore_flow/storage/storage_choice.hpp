#pragma once

#include <memory>

#include "core/body/body.hpp"
#include "core/config/key.hpp"
#include "core/config/section.hpp"
#include "modules/pore_flow/material/pore_fluid.hpp"
#include "modules/pore_flow/storage/pore_storage.hpp"

namespace perifrac {

/// `undrained_stabilisation`.
KeyTable storage_choice_keys();

/// Whether `undrained_stabilisation` may be more than none here.
template <int D>
bool can_be_stabilised(const Section& pore_flow, const Body<D>& body);

/// The storage that the scene asks for; where it leaves that open, the points' own.
/// Throws InputError.
template <int D>
std::unique_ptr<PoreStorage> make_storage(const Section& section, const Body<D>& body,
                                          const PoreFluid& fluid, PoreMaterials materials);

/// Where the scene leaves it open: stabilises as soon as the slope of the dilatation calls for it.
/// Empty where it does not, or stabilised storage cannot be.
template <int D>
StorageChoice storage_choice(const Section& section, std::shared_ptr<const Body<D>> body,
                             PoreMaterials materials);

}  // namespace perifrac
