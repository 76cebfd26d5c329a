#pragma once

#include <string>

#include "floors.h"
#include "splotchcl/frame.h"
#include "splotchcl/renderer.h"

namespace splotchcl::bench {

// What the frame that was drawn last, with these statistics, gave its stages to do, as its first
// plan has it. Its lists are made once more, to look at what they hold; frames of tolerance 0,
// whose lists hold no widths, get no row parts. The device's name as in RendererOptions. Throws
// DeviceError.
FrameCounts frame_counts(const Frame& frame, const RenderStats& stats, const std::string& device);

// What a splat of a list is drawn in: pixels, from the middle of its tile; no radius where it is
// only listed.
struct Disc {
  float x, y, radius;
};
// Its row parts in a tile of so many pixels.
double row_parts_of(const Disc& disc, double tile_width, double tile_height);
// Patches of the tile that hold a pixel's center within the disc; none of a disc that touches at
// most seven columns and rows, which is drawn without them (kernels/composite/waiting.cl).
double patches_of(const Disc& disc, double tile_width, double tile_height, const PatchSize& patch);

}  // namespace splotchcl::bench
