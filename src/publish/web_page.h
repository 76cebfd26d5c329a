#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "publish/packed_splats.h"
#include "splotchcl/finish.h"
#include "splotchcl/frame.h"

namespace splotchcl {

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
