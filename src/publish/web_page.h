#pragma once

#include <array>
#include <cstdint>
#include <string>
#include <vector>

#include "publish/light_splats.h"
#include "splotchcl/finish.h"
#include "splotchcl/frame.h"

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

// What a page says and shows of a scene beside its splats.
struct WebPage {
  std::string title, unit;  // the unit of lengths; may be empty
  FinishSettings finish;    // with exposure and white
  double gamma = 2.2;
  std::uint64_t particles = 0;  // that the splats stand for
  // Of the page's splats from the particles, with its footprint, in the scene's picture, in units
  // of what the page shows as white.
  double rms_difference = 0, largest_difference = 0;
};

// What a pixel of a page sees, as a standard deviation in pixels: nothing twinkles when one moves.
constexpr double page_footprint_pixels = 0.5;

// Throws UsageError for a frame that no page can show: wide angles, and clouds in an order that is
// not that of their depths.
void check_page(const Frame& frame);

// Likewise for files of splats, which know no matter whose order counts.
void check_splat_file(const Frame& frame);

// The frame as a page shows it, with the particles, or with splats in their place.
Frame as_on_page(const Frame& frame);
Frame as_on_page(const Frame& frame, const std::vector<LightSplat>& splats);

// Where their order counts: a picture whose light is right in this channel alone, for a scene has
// no colors of absorption that differ from particle to particle in all three.
Frame as_on_page(const Frame& frame, const std::vector<LightSplat>& splats, std::size_t channel);

// All of it in one text of HTML, which needs nothing else.
std::string make_web_page(const WebPage& page, const Frame& frame, const PackedSplats& splats);

}  // namespace splotchcl
