#pragma once

#include <cstddef>
#include <cstdint>
#include <string>

#include "device/opencl/device_traits.h"
#include "device/opencl/program_cache.h"
#include "splotchcl/frame.h"
#include "splotchcl/plan.h"

namespace splotchcl {

// What a projection writes.
enum class ProjectOutput {
  counts,           // how many splats each block has
  splats,           // and the splats
  splats_and_keys,  // and their sort keys
  // Of splats in a window of sort keys alone (key_windows.h):
  key_counts,     // as counts, and how many keys lie in each bin
  window_counts,  // as counts
  window_splats,  // as splats_and_keys
};
bool is_of_window(ProjectOutput output);

// The variant of the kernels that a frame needs. It alone writes the #defines that reach a
// kernel, and knows the sizes that follow from them. A kernel gets only those that it reads,
// so that frames share as many programs as possible.
class Specialization {
 public:
  Specialization(const Frame& frame, const FramePlan& plan, const DeviceTraits& traits);

  bool is_ordered() const { return light_ == LightPlan::ordered; }
  bool is_extended() const { return extended_; }
  // Whether a work-item composites rows of a tile, else a group of them its pixels. Pairs of floats
  // have no rows.
  bool has_rows() const { return rows_ && (!extended_ || double_numbers_); }
  bool has_vector_colors() const { return vector_colors_; }
  bool has_ellipses() const { return ellipses_; }
  bool is_face_of_cube() const { return face_of_cube_; }
  bool has_stencils() const { return stencils_; }
  bool has_background_image() const { return background_image_; }

  // Pixels of a tile.
  std::uint32_t tile_width() const { return tile_width_; }
  std::uint32_t tile_height() const { return tile_height_; }
  std::size_t tile_pixels() const { return std::size_t{tile_width_} * tile_height_; }
  // Floats per pixel of a grid: 3 sums, or 3 sources and 3 opacities; in extended precision
  // a high and a low part of each.
  std::uint32_t planes() const;
  // Bytes of the structures that kernels make larger or smaller (shared.h).
  std::size_t splat_bytes() const;
  std::size_t extended_splat_bytes() const;  // 0 where there are none
  std::size_t tile_splat_bytes() const;
  // Whether a splat in memory has its tiles with it.
  bool has_own_tiles() const;

  ProgramSource project(ProjectOutput output) const;
  ProgramSource bin() const;
  ProgramSource composite() const;
  // The same of lists in which there are clouds around the camera.
  ProgramSource composite_with_clouds() const;
  ProgramSource join() const;
  // The same of wide splats in slabs of an ordered plan, which are added up.
  ProgramSource composite_slab() const;
  ProgramSource join_slab() const;
  // A slab's wide splats laid among its narrow ones.
  ProgramSource lay_slab() const;
  ProgramSource certify() const;
  // Of clouds around the camera: which they are, and their layers.
  ProgramSource list_around() const;
  ProgramSource behind() const;
  int pixels_behind() const;  // of a work-item of that
  // A work-item that refines grids, lays slabs or makes the picture takes so many times eight
  // pixels: several on a processor, where it may be a call (common.cl, KERNEL_BODY).
  std::size_t eights_of_item() const { return rows_ ? 8 : 1; }
  ProgramSource resolve() const;
  // These are the same for all frames; rows as the device has them.
  static ProgramSource interpolate(bool rows);
  static ProgramSource boxes(bool rows, bool vector_colors);
  static ProgramSource scan_blocks();
  static ProgramSource compact();
  static ProgramSource sort();
  static ProgramSource sort_groups();
  static ProgramSource carry();
  static ProgramSource scan();
  ProgramSource coarse_grids() const;
  ProgramSource blur() const;
  static ProgramSource add_light();
  static ProgramSource clear();

 private:
  bool has_whole_sectors() const;
  bool finds_tiles(ProjectOutput output) const;
  std::string splat_defines() const;
  std::string wide_angle_defines() const;
  std::string composite_file() const;  // of single precision
  std::string join_file() const;
  std::string tile_size_defines() const;
  std::string tile_defines() const;
  std::string slab_defines() const;
  // Shapes on faces of a cube come eight pixels at a time.
  bool takes_rows_of_16() const { return rows_ && rows_of_16_ && !face_of_cube_; }
  std::string number_defines() const;
  std::string block_defines() const;
  std::string item_defines() const;

  LightPlan light_;
  Projection projection_;
  bool rows_;            // eight lanes, else one
  bool rows_of_16_;      // of a patch, and sixteen lanes of a projection
  bool extended_;        // numbers of 45 bits
  bool double_numbers_;  // as doubles, else pairs of floats
  bool full_precision_, fine_places_, small_blocks_;
  bool kernel_cut_, pixel_means_;
  bool vector_colors_, ellipses_, copies_, face_of_cube_;
  bool keeps_transmittance_;
  bool clouds_around_;  // may be: they are no splats
  bool stencils_;       // of sums
  bool background_image_;
  std::uint32_t tile_width_ = 16, tile_height_ = 16;
};

}  // namespace splotchcl
