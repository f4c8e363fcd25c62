#pragma once

namespace perifrac {

/// Front of a collapsing column of water that is twice as high as wide, as measured: Martin and
/// Moyce, Phil. Trans. R. Soc. Lond. A 244 (1952), 312-324, table 2, width a = 2.25 inches.
namespace martin_moyce {

/// Place of the front over the width a, at T = t sqrt(2 g / a): linear between the measurements;
/// NaN after the last of them.
double front(double T);
/// The T of the last measurement.
double end();

}  // namespace martin_moyce

}  // namespace perifrac
