#pragma once

#include <string>

#include "app/references/solutions/kgd_solution.hpp"

namespace perifrac {

/// A plane-strain fracture of two wings that fluid drives through an infinite body: what
/// dimensional analysis says of it. Symbols as in Detournay (2004, 2016) and Adachi and Detournay
/// (2008).
struct HydraulicFracture {
  KgdProblem driven;
  double leak_off_coefficient = 0.0;  ///< Carter's C_L, of one side [m/s^0.5]; C' = 2 C_L
  double closing_stress = 0.0;        ///< across the crack [Pa]
};

/// Where viscosity alone counts and nothing leaks.
CrackSize viscosity_corner(const KgdProblem& driven, double t);
/// Between them; a corner where the toughness is beyond KgdSolution's table.
CrackSize storage_solution(const KgdProblem& driven, double t);
/// l = Q t^(1/2) / (pi C'), where all but nothing stays in the crack [m].
double leak_off_corner(const HydraulicFracture& fracture, double t);

/// C_m = C' (E' t / (mu' Q^3))^(1/6): what leaks over what is pumped in, but for a factor.
double leak_off_number(const HydraulicFracture& fracture, double t);
/// E'^4 C'^6 t / (K'^4 Q^2) for `share` of the rate as Q: above 1 leak-off decides, if viscosity
/// does not count. For the printed criterion of a crack from a body's face Q is what goes into
/// that.
double leak_off_over_toughness(const HydraulicFracture& fracture, double share, double t);
/// What is in the crack over what was pumped in. A crack that leaks is about the one that does not
/// at the time when that is as long; then the balance of volume is one equation. Within 1 % of a
/// marched solution in length and opening, 1.5 % in pressure, for any toughness and leak-off.
double efficiency(const HydraulicFracture& fracture, double t);
/// The crack at t [s] by that balance.
CrackSize expected_crack(const HydraulicFracture& fracture, double t);

/// mu' E'^2 / stress^3: long after it fluid reaches the tips [s]; infinite without stress.
double lag_time(const HydraulicFracture& fracture);
/// At most this long is the dry tip at t [m]: as without toughness (Garagash and Detournay 2000),
/// or as without stress.
double largest_lag(const HydraulicFracture& fracture, double t);

/// What decides: `viscosity` or `toughness`, `storage` or `leak-off`, and both names of a pair
/// unless one corner gives the length to about 1 %; `mostly` the one that three quarters go to.
std::string corner(double dimensionless_toughness, double efficiency);

}  // namespace perifrac
