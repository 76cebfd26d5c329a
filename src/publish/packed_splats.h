#pragma once

#include <array>
#include <cstdint>
#include <string>
#include <vector>

#include "publish/light_splats.h"

namespace splotchcl {

// Splats as a page draws them: seven numbers of 16 bits each, and one or three more where they
// absorb.
//   place   from the lower corner of their box to the upper, along each axis
//   sigma   the logarithm, from the least to the most
//   light   0: none; else the logarithm of a channel, from the least to the most that is kept:
//           channels a billion times darker than the brightest of all are none
//   depth   the same of optical depths, one for all channels where these are alike
struct PackedSplats {
  std::array<float, 3> lower{}, upper{};
  float least_sigma = 0, most_sigma = 0;  // log2
  float least_light = 0, most_light = 0;  // log2
  float least_depth = 0, most_depth = 0;  // log2
  std::vector<std::vector<std::uint16_t>> columns =
      std::vector<std::vector<std::uint16_t>>(7);  // place, sigma, light, depth

  std::size_t count() const { return columns[0].size(); }
  std::size_t depths() const { return columns.size() - 7; }  // 0, 1 or 3
};

PackedSplats pack(const std::vector<LightSplat>& splats);

// What a page draws of them, but for its own arithmetic.
std::vector<LightSplat> unpack(const PackedSplats& packed);

// The columns one after the other, each its low bytes and then its high ones, deflated (RFC 1950)
// and in base64 (RFC 4648). Throws DataError where memory runs out.
std::string as_text(const PackedSplats& packed);

}  // namespace splotchcl
