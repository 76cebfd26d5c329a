#include "publish/packed_splats.h"

#include <zlib.h>

#include <algorithm>
#include <cmath>
#include <cstddef>

#include "splotchcl/error.h"

namespace splotchcl {
namespace {

constexpr float most_code = 65535;
constexpr float octaves_of_light = 30;
constexpr std::size_t sigma_column = 3, first_light_column = 4, first_depth_column = 7;

std::uint16_t code_of(float value, float least, float most, float first_code) {
  if (!(most > least)) return static_cast<std::uint16_t>(first_code);
  const float part = std::clamp((value - least) / (most - least), 0.0F, 1.0F);
  return static_cast<std::uint16_t>(std::lround(first_code + part * (most_code - first_code)));
}

float value_of(std::uint16_t code, float least, float most, float first_code) {
  return least +
         (most - least) * (static_cast<float>(code) - first_code) / (most_code - first_code);
}

// 0: none. `value` is light or a depth, and what bounds it logarithms.
std::uint16_t code_or_none(float value, float least, float most) {
  const float logarithm = std::log2(value);
  return logarithm < least ? std::uint16_t{0} : code_of(logarithm, least, most, 1);
}

float value_or_none(std::uint16_t code, float least, float most) {
  return code == 0 ? 0.0F : std::exp2(value_of(code, least, most, 1));
}

// How many depths each splat needs.
std::size_t depths_of(const std::vector<LightSplat>& splats) {
  std::size_t depths = 0;
  for (const LightSplat& splat : splats) {
    const auto& [red, green, blue] = splat.depth;
    if (red != green || red != blue) return 3;
    if (red > 0) depths = 1;
  }
  return depths;
}

// Where the numbers lie that the codes are of.
PackedSplats ranges_of(const std::vector<LightSplat>& splats) {
  PackedSplats packed;
  if (splats.empty()) return packed;
  packed.lower = packed.upper = splats.front().place;
  float least_sigma = splats.front().sigma, most_sigma = least_sigma, most_light = 0,
        most_depth = 0;
  for (const LightSplat& splat : splats) {
    for (std::size_t axis = 0; axis < 3; ++axis) {
      packed.lower[axis] = std::min(packed.lower[axis], splat.place[axis]);
      packed.upper[axis] = std::max(packed.upper[axis], splat.place[axis]);
      most_light = std::max(most_light, splat.light[axis]);
      most_depth = std::max(most_depth, splat.depth[axis]);
    }
    least_sigma = std::min(least_sigma, splat.sigma);
    most_sigma = std::max(most_sigma, splat.sigma);
  }
  packed.least_sigma = std::log2(least_sigma);
  packed.most_sigma = std::log2(most_sigma);
  // Of what absorbs alone there is no light.
  packed.most_light = most_light > 0 ? std::log2(most_light) : 0.0F;
  packed.least_light = packed.most_light - octaves_of_light;
  packed.most_depth = most_depth > 0 ? std::log2(most_depth) : 0.0F;
  packed.least_depth = packed.most_depth - octaves_of_light;
  packed.columns.resize(first_depth_column + depths_of(splats));
  return packed;
}

std::string base64(const std::vector<Bytef>& bytes) {
  constexpr char letters[] = "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
  std::string text;
  text.reserve(bytes.size() / 3 * 4 + 4);
  for (std::size_t i = 0; i < bytes.size(); i += 3) {
    const auto byte = [&](std::size_t k) {
      return i + k < bytes.size() ? static_cast<unsigned>(bytes[i + k]) : 0U;
    };
    const unsigned bits = byte(0) << 16 | byte(1) << 8 | byte(2);
    for (std::size_t k = 0; k < 4; ++k)
      text += i + k > bytes.size() ? '=' : letters[bits >> (18 - 6 * k) & 63];
  }
  return text;
}

}  // namespace

PackedSplats pack(const std::vector<LightSplat>& splats) {
  PackedSplats packed = ranges_of(splats);
  for (const LightSplat& splat : splats) {
    for (std::size_t axis = 0; axis < 3; ++axis) {
      packed.columns[axis].push_back(
          code_of(splat.place[axis], packed.lower[axis], packed.upper[axis], 0));
      packed.columns[first_light_column + axis].push_back(
          code_or_none(splat.light[axis], packed.least_light, packed.most_light));
      if (axis < packed.depths())
        packed.columns[first_depth_column + axis].push_back(
            code_or_none(splat.depth[axis], packed.least_depth, packed.most_depth));
    }
    packed.columns[sigma_column].push_back(
        code_of(std::log2(splat.sigma), packed.least_sigma, packed.most_sigma, 0));
  }
  return packed;
}

std::vector<LightSplat> unpack(const PackedSplats& packed) {
  std::vector<LightSplat> splats(packed.count());
  for (std::size_t i = 0; i < splats.size(); ++i) {
    LightSplat& splat = splats[i];
    for (std::size_t axis = 0; axis < 3; ++axis) {
      splat.place[axis] =
          value_of(packed.columns[axis][i], packed.lower[axis], packed.upper[axis], 0);
      splat.light[axis] = value_or_none(packed.columns[first_light_column + axis][i],
                                        packed.least_light, packed.most_light);
      if (packed.depths() == 0) continue;
      const std::size_t depth = first_depth_column + (packed.depths() == 3 ? axis : 0);
      splat.depth[axis] =
          value_or_none(packed.columns[depth][i], packed.least_depth, packed.most_depth);
    }
    splat.sigma = std::exp2(
        value_of(packed.columns[sigma_column][i], packed.least_sigma, packed.most_sigma, 0));
  }
  return splats;
}

std::string as_text(const PackedSplats& packed) {
  std::vector<Bytef> bytes;
  bytes.reserve(packed.count() * 2 * packed.columns.size());
  for (const std::vector<std::uint16_t>& column : packed.columns) {
    for (const std::uint16_t code : column)
      bytes.push_back(static_cast<Bytef>(code & 255));
    for (const std::uint16_t code : column)
      bytes.push_back(static_cast<Bytef>(code >> 8));
  }
  uLongf size = compressBound(static_cast<uLong>(bytes.size()));
  std::vector<Bytef> deflated(size);
  const int status = compress2(deflated.data(), &size, bytes.data(),
                               static_cast<uLong>(bytes.size()), Z_BEST_COMPRESSION);
  if (status != Z_OK) throw DataError("there is not enough memory to pack the splats of a page");
  deflated.resize(size);
  return base64(deflated);
}

}  // namespace splotchcl
