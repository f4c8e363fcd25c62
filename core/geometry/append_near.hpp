#pragma once

#ifdef __AVX512VL__
#include <bit>
#include <immintrin.h>
#endif

#include <algorithm>

#include "core/base/packet.hpp"

namespace perifrac {

/// Of the first `lanes` numbers of a packet, lane `without` apart, takes those less than `limit`
/// and writes their `index` one after the other. Gives their number; all packet_size places may be
/// overwritten.
inline int append_near(const Packet& number, double limit, Index lanes, Index without,
                       const Index* index, Index* place) {
#ifdef __AVX512VL__
  unsigned bits =
      _mm512_cmp_pd_mask(std::bit_cast<__m512d>(number), _mm512_set1_pd(limit), _CMP_LT_OQ);
  bits &= (1u << std::min(lanes, packet_size)) - 1u;
  bits &= ~(static_cast<std::uint32_t>(without) < packet_size ? 1u << without : 0u);
  const __m256i packet = _mm256_loadu_si256(reinterpret_cast<const __m256i*>(index));
  _mm256_storeu_si256(reinterpret_cast<__m256i*>(place),
                      _mm256_maskz_compress_epi32(static_cast<__mmask8>(bits), packet));
  return std::popcount(bits);
#else
  int count = 0;
  for (int l = 0; l < packet_size; ++l) {
    place[count] = index[l];
    count += (number[l] < limit) & (l < lanes) & (l != without);
  }
  return count;
#endif
}

}  // namespace perifrac
