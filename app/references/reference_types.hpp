#pragma once

#include <memory>
#include <string>
#include <vector>

#include "app/references/reference.hpp"
#include "app/simulation/simulation.hpp"
#include "core/config/section.hpp"

namespace perifrac {

/// A word of `reference.type` and what makes the comparison. `make` throws InputError where the
/// scene is not the problem that was solved; the manager must be initialised.
struct ReferenceType {
  std::string name;
  std::unique_ptr<Reference> (*make)(const Section& scene, const Simulation& simulation);
};

/// All references.
const std::vector<ReferenceType>& reference_types();

/// The one that `reference.type` names; none where the scene has no such section.
std::unique_ptr<Reference> make_reference(const Section& scene, const Simulation& simulation);

// What makes each, and the scene that it is for: each throws InputError for another. That of files
// (`table`) has a header of its own.

/// A quarter of Mandel's slab: a 2D box on rollers at left and bottom, a rigid plate at the top,
/// drained at the right.
std::unique_ptr<Reference> make_mandel_reference(const Section& scene,
                                                 const Simulation& simulation);

/// A column in 2D or 3D on rollers at its sides, on a roller or fixed at the sealed bottom, under a
/// traction on the drained top.
std::unique_ptr<Reference> make_terzaghi_reference(const Section& scene,
                                                   const Simulation& simulation);

/// The same column of two materials: one region of the body, from some height up, differs in
/// permeability or elastic constants.
std::unique_ptr<Reference> make_layered_column_reference(const Section& scene,
                                                         const Simulation& simulation);

/// A 3D ball, whole or cut by symmetry planes, under a pressure on its drained surface.
std::unique_ptr<Reference> make_cryer_reference(const Section& scene, const Simulation& simulation);

/// Pore flow alone in a box: one face at a pressure, the others sealed.
std::unique_ptr<Reference> make_diffusion_reference(const Section& scene,
                                                    const Simulation& simulation);

/// A solid alone: a box on rollers at its low faces, uniform tractions on its high ones.
std::unique_ptr<Reference> make_drained_plate_reference(const Section& scene,
                                                        const Simulation& simulation);

/// A dynamic solid alone in 2D: a beam along x, fixed at the left, under a sudden body force.
std::unique_ptr<Reference> make_cantilever_reference(const Section& scene,
                                                     const Simulation& simulation);

/// Fluid at rest in an open tank: one block that covers the container's floor.
std::unique_ptr<Reference> make_hydrostatic_reference(const Section& scene,
                                                      const Simulation& simulation);

/// Fluid that fills an endless slit along x and starts to flow under gravity along it.
std::unique_ptr<Reference> make_poiseuille_reference(const Section& scene,
                                                     const Simulation& simulation);

/// A column, twice as high as wide, that collapses at the left end of a dry tank.
std::unique_ptr<Reference> make_dam_break_reference(const Section& scene,
                                                    const Simulation& simulation);

/// Water that a piston presses on a porous box, without pores at first or at the steady state,
/// whose bottom is held at no pressure and whose solid does not deform; no gravity.
std::unique_ptr<Reference> make_constant_head_reference(const Section& scene,
                                                        const Simulation& simulation);

/// An elastic plate in 2D, clamped at its left and right, that bears its own weight and that of
/// fluid over all of it.
std::unique_ptr<Reference> make_water_on_plate_reference(const Section& scene,
                                                         const Simulation& simulation);

/// `reference.type: kgd`: one wing of a crack that runs from the left face, an axis of symmetry,
/// into a body much larger than itself, against the self-similar solution: length, net pressure and
/// opening at the inlet.
std::unique_ptr<Reference> make_kgd_reference(const Section& scene, const Simulation& simulation);

/// `reference.type: radial`: a quarter of a plane crack in a 3D body, from the corner of two planes
/// of symmetry where fluid is pumped in, against a penny-shaped one in an infinite body: radius of
/// a circle of the crack's area, net pressure and opening at the inlet.
std::unique_ptr<Reference> make_radial_reference(const Section& scene,
                                                 const Simulation& simulation);

/// `reference.type: slit_flow`: steady flow through a straight slit of fixed width between two
/// pressures against the cubic law, w^3 / (12 mu) times the fall of pressure.
std::unique_ptr<Reference> make_slit_flow_reference(const Section& scene,
                                                    const Simulation& simulation);

}  // namespace perifrac
