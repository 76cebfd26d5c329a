#pragma once

#include <cstddef>
#include <cstdint>
#include <string>

#include "device/opencl/device_traits.h"
#include "device/opencl/program_text.h"
#include "splotchcl/frame.h"
#include "splotchcl/plan.h"

namespace splotchcl {

// What a frame needs of the kernels, and the sizes that follow. Kernels ask for it by macros; a
// program gets those that its text mentions, so that frames share as many programs as they can.
struct Variant {
  Variant(const Frame& frame, const FramePlan& plan, const DeviceTraits& traits);

  LightPlan light;
  Projection projection;
  bool rows;            // the shape for processors: eight lanes, and rows of a tile
  bool rows_of_16;      // registers hold sixteen floats
  bool double_numbers;  // the device has double precision: sharp splats' places are in it
  bool extended;        // all of the frame is in double precision
  bool full_precision, fine_places, small_blocks, native_exp2;
  bool kernel_cut, pixel_means;
  bool vector_colors, ellipses, copies, face_of_cube;
  bool keeps_transmittance;
  bool clouds_around;  // the camera, there may be: they are no splats
  bool stencils;       // of sums
  bool background_image;
  std::uint32_t sums = 3;                 // of what is added up: light, of slabs depth as well
  std::uint32_t tile_width, tile_height;  // pixels

  bool is_ordered() const { return light == LightPlan::ordered; }
  std::size_t tile_pixels() const { return std::size_t{tile_width} * tile_height; }
  // Of a group that composites a tile: each has four pixels, or eight in extended precision.
  std::size_t items_of_tile() const { return tile_pixels() / (extended ? 8 : 4); }
  // Floats per pixel of a grid: sums, or 3 sources and 3 opacities; in extended precision a high
  // and a low part of each.
  std::uint32_t planes() const { return (is_ordered() ? 6u : sums) * (extended ? 2u : 1u); }
  // Whether a splat in memory has its tiles with it, which the lanes that project it know. With
  // that word a splat is as many words as there are lanes, and most of those that are gathered in
  // sorted order lie in one line of the cache.
  bool has_own_tiles() const { return rows && !ellipses && !extended; }
  // Splats of seven words are gathered in one sector of a GPU's memory with one more.
  bool has_whole_sectors() const {
    return !rows && !ellipses && !vector_colors && !fine_places && !extended;
  }
  // Bytes of the structures that the variant makes larger or smaller (shared.h).
  std::size_t splat_bytes() const;
  std::size_t extended_splat_bytes() const;  // of these; 0 where there are none
  std::size_t tile_splat_bytes() const;
  // A work-item that refines grids, lays slabs or makes the picture takes so many times eight
  // pixels: several on a processor, where it may be a call (common.cl, KERNEL_BODY).
  std::size_t eights_of_item() const { return rows ? 8 : 1; }
  int pixels_behind() const { return rows ? 64 : 1; }  // of a work-item
  // Shapes on faces of a cube come eight pixels at a time.
  bool takes_rows_of_16() const { return rows && rows_of_16 && !face_of_cube; }

  // Of the wide splats in slabs of an ordered frame, which are added up: round ones that are not
  // cut and take values at pixel centers.
  Variant of_slabs() const;
};

ProgramSource program_source(const Variant& variant, const std::string& file,
                             const Choices& choices = {});

}  // namespace splotchcl
