#pragma once

namespace perifrac {

/// Has OpenBLAS use AVX-512 or AVX2 where the processor has them and OpenBLAS does not know it.
/// Versions before 0.3.25 (Debian 12 has 0.3.21) take an Intel processor younger than themselves
/// for a Pentium 4, whose kernels are 4 to 8 times slower: OpenBLAS issue 4267. What
/// OPENBLAS_CORETYPE says in the environment stays. To be called before any factorisation.
void choose_openblas_kernels();

}  // namespace perifrac
