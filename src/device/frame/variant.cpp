#include "device/frame/variant.h"

#include <utility>

#include "device/frame/shared.h"
#include "scene/plan/splat_limits.h"
#include "surroundings/cloud_around.h"

namespace splotchcl {
namespace {

// A block of n splats errs by n roundings at most: 64 of them by less than 1e-5, 256 by less than
// 3e-5, but adding up smaller blocks takes rows as long as drawing them. Sums of light to three
// digits need none beside the lists. GPUs and ordered frames are told (LayerLimits).
std::string splats_of_block(const Variant& v) {
  if (!v.full_precision) return "";
  return define(v.small_blocks ? "SPLATS_OF_BLOCK 64u" : "SPLATS_OF_BLOCK 256u");
}

// Constants that kernels ask for by `if`, or `#if` where something is declared.
std::string defines_of(const Variant& v) {
  const std::pair<const char*, std::uint64_t> constants[] = {
      {"LIGHT_ORDERED", v.is_ordered()},
      {"LIGHT_EMISSION", v.light == LightPlan::emission},
      {"WIDE_ANGLE", is_wide_angle(v.projection)},
      {"PROJECTION_FISHEYE", v.projection == Projection::fisheye},
      {"PROJECTION_EQUIRECTANGULAR", v.projection == Projection::equirectangular},
      {"EXTENDED_NUMBERS", v.extended},
      {"DOUBLE_NUMBERS", v.double_numbers && !v.extended},
      {"FULL_PRECISION", v.full_precision},
      {"NATIVE_EXP2", v.native_exp2},
      {"FINE_PLACES", v.fine_places},
      {"KERNEL_CUT", v.kernel_cut},
      {"SAMPLING_MEAN", v.pixel_means},
      {"VECTOR_COLORS", v.vector_colors},
      {"ELLIPSES", v.ellipses},
      {"COPIES", v.copies},
      {"FACE_OF_CUBE", v.face_of_cube},
      {"KEEP_TRANSMITTANCE", v.keeps_transmittance},
      {"CLOUDS_AROUND", v.clouds_around},
      {"STENCILS", v.stencils},
      {"BACKGROUND_IMAGE", v.background_image},
      {"WHOLE_SECTORS", v.has_whole_sectors()},
      {"TILES_IN_SPLAT", v.has_own_tiles()},
      {"TILE_WIDTH", v.tile_width},
      {"TILE_HEIGHT", v.tile_height},
      {"PLANES", v.planes()},
      {"SUMMED", v.sums},
      {"EIGHTS_OF_ITEM", v.eights_of_item()},
      {"PIXELS_BEHIND", static_cast<std::uint64_t>(v.pixels_behind())}};
  std::string defines = v.rows ? define("LANES_8") : "";
  for (const auto& [name, value] : constants)
    defines += define(name + (" " + std::to_string(value)));
  return defines + splats_of_block(v);
}

}  // namespace

Variant::Variant(const Frame& frame, const FramePlan& plan, const DeviceTraits& traits)
    : light(plan.light),
      projection(frame.projection),
      rows(traits.rows),
      rows_of_16(traits.rows_of_16),
      double_numbers(traits.double_numbers),
      extended(plan.is_extended()),
      full_precision(plan.precision != Precision::fast),
      fine_places(plan.has_fine_places && !extended),
      small_blocks(plan.adds_small_blocks),
      native_exp2(traits.native_exp2 && !rows && plan.precision == Precision::fast),
      kernel_cut(frame.kernel.cut.has_value()),
      pixel_means(takes_pixel_means(frame)),
      vector_colors(plan.has_vector_colors),
      ellipses(plan.has_ellipses),
      copies(plan.has_copies),
      face_of_cube(plan.is_face_of_cube),
      keeps_transmittance(plan.layers.keeps_transmittance),
      clouds_around(has_clouds_around(frame)),
      stencils(plan.pyramid.has_stencils()),
      background_image(frame.background_image != nullptr) {
  tile_height = rows || !extended ? 32 : 16;
  tile_width = rows && !is_ordered() && !extended ? 64 : tile_height;
}

Variant Variant::of_slabs() const {
  Variant slabs = *this;
  slabs.light = LightPlan::proportional;
  slabs.sums = 6;
  slabs.pixel_means = slabs.keeps_transmittance = false;
  return slabs;
}

std::size_t Variant::splat_bytes() const {
  return sizeof(shared::Splat) + (ellipses ? sizeof(shared::WidthAlongX) : 0) +
         (face_of_cube ? sizeof(shared::Tilt) + sizeof(cl_float) : 0) +
         (vector_colors ? sizeof(shared::OwnColor) : 0) + (fine_places ? sizeof(cl_uint) : 0) +
         (has_whole_sectors() ? sizeof(cl_uint) : 0) + (has_own_tiles() ? sizeof(cl_uint) : 0) +
         extended_splat_bytes();
}

std::size_t Variant::extended_splat_bytes() const {
  if (!extended) return 0;
  return sizeof(shared::ExtendedSplat) + (ellipses ? sizeof(shared::FloatPair) : 0) +
         (face_of_cube ? sizeof(shared::ExtendedTilt) : 0);
}

// TileSplat, bin.h.
std::size_t Variant::tile_splat_bytes() const {
  if (extended) return sizeof(cl_uint);
  const std::size_t shape = 4 * sizeof(float) + (ellipses ? sizeof(shared::WidthAlongX) : 0) +
                            (face_of_cube ? sizeof(shared::Tilt) : 0) +
                            (fine_places ? 2 * sizeof(float) : 0);
  return shape + (is_ordered() ? 6 : 3) * sizeof(float);
}

ProgramSource program_source(const Variant& variant, const std::string& file,
                             const Choices& choices) {
  ProgramSource source = program_source(file, choices);
  source.variant = defines_of(variant);
  return source;
}

}  // namespace splotchcl
