#include "device/frame/variant.h"

#include "device/frame/shared.h"
#include "scene/plan/splat_limits.h"
#include "surroundings/cloud_around.h"

namespace splotchcl {
namespace {

std::string define(const std::string& name_and_value) {
  return "#define " + name_and_value + "\n";
}

std::string define_if(bool condition, const std::string& name_and_value) {
  return condition ? define(name_and_value) : std::string();
}

// A constant that kernels ask for by `if`, or `#if` where something is declared.
std::string flag(bool value, const std::string& name) {
  return define(name + (value ? " 1" : " 0"));
}

std::string define(const std::string& name, std::uint64_t value) {
  return define(name + " " + std::to_string(value));
}

// A block of n splats errs by n roundings at most: 64 of them by less than 1e-5, 256 by less than
// 3e-5, but adding up smaller blocks takes rows as long as drawing them. Sums of light to three
// digits need none beside the lists; opacities stand still behind too many layers. Behind many
// equal layers of opacity a bright background shows half as many roundings.
std::string splats_of_block(const Variant& v) {
  if (v.small_blocks && v.is_ordered()) return define("SPLATS_OF_BLOCK 32u");
  if (v.small_blocks || !v.rows) return define("SPLATS_OF_BLOCK 64u");
  if (v.full_precision) return define("SPLATS_OF_BLOCK 256u");
  return define_if(v.is_ordered(), "SPLATS_OF_BLOCK 1024u");
}

std::string wide_angle(const Variant& v) {
  return flag(is_wide_angle(v.projection), "WIDE_ANGLE") +
         flag(v.projection == Projection::fisheye, "PROJECTION_FISHEYE") +
         flag(v.projection == Projection::equirectangular, "PROJECTION_EQUIRECTANGULAR") +
         flag(v.copies, "COPIES") + flag(v.ellipses, "ELLIPSES") +
         flag(v.face_of_cube, "FACE_OF_CUBE");
}

std::string numbers(const Variant& v) {
  return define_if(v.rows, "LANES_8") + flag(v.extended, "EXTENDED_NUMBERS") +
         flag(v.double_numbers, "DOUBLE_NUMBERS") + flag(v.full_precision, "FULL_PRECISION") +
         splats_of_block(v);
}

std::string layout(const Variant& v) {
  return flag(v.vector_colors, "VECTOR_COLORS") + flag(v.fine_places, "FINE_PLACES") +
         flag(v.has_whole_sectors(), "WHOLE_SECTORS") + flag(v.has_own_tiles(), "TILES_IN_SPLAT") +
         define("TILE_WIDTH", v.tile_width) + define("TILE_HEIGHT", v.tile_height) +
         define("PLANES", v.planes()) + define("SUMMED", v.sums) +
         define("EIGHTS_OF_ITEM", v.eights_of_item()) +
         define("PIXELS_BEHIND", static_cast<std::uint64_t>(v.pixels_behind()));
}

std::string light(const Variant& v) {
  return flag(v.is_ordered(), "LIGHT_ORDERED") +
         flag(v.light == LightPlan::emission, "LIGHT_EMISSION") +
         flag(v.keeps_transmittance, "KEEP_TRANSMITTANCE") + flag(v.kernel_cut, "KERNEL_CUT") +
         flag(v.pixel_means, "SAMPLING_MEAN") + flag(v.stencils, "STENCILS") +
         flag(v.clouds_around, "CLOUDS_AROUND") + flag(v.background_image, "BACKGROUND_IMAGE");
}

std::string defines_of(const Choices& choices) {
  std::string defines;
  for (const std::string& choice : choices)
    defines += define(choice);
  return defines;
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
  if (has_rows()) {
    tile_width = is_ordered() || extended ? 32 : 64;
    tile_height = 32;
  }
}

Variant Variant::of_slabs() const {
  Variant slabs = *this;
  slabs.light = LightPlan::proportional;
  slabs.sums = 6;
  slabs.pixel_means = slabs.keeps_transmittance = false;
  return slabs;
}

// Splats of seven words are gathered in one sector of a GPU's memory with one more.
bool Variant::has_whole_sectors() const {
  return !rows && !ellipses && !vector_colors && !fine_places;
}

std::size_t Variant::splat_bytes() const {
  return sizeof(shared::Splat) + (ellipses ? sizeof(shared::WidthAlongX) : 0) +
         (face_of_cube ? sizeof(shared::Tilt) + sizeof(cl_float) : 0) +
         (vector_colors ? sizeof(shared::OwnColor) : 0) + (fine_places ? sizeof(cl_uint) : 0) +
         (has_whole_sectors() ? sizeof(cl_uint) : 0) + (has_own_tiles() ? sizeof(cl_uint) : 0);
}

std::size_t Variant::extended_splat_bytes() const {
  if (!extended) return 0;
  return sizeof(shared::ExtendedSplat) + (ellipses ? sizeof(shared::ExtendedAlongX) : 0) +
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

ProgramSource program_source(const std::string& file, const Choices& choices) {
  ProgramSource source;
  source.file = file;
  source.defines = defines_of(choices);
  return source;
}

ProgramSource program_source(const Variant& variant, const std::string& file,
                             const Choices& choices) {
  ProgramSource source = program_source(file, choices);
  source.variant = numbers(variant) + light(variant) + layout(variant) + wide_angle(variant);
  return source;
}

ProgramSource program_of_layers(const Variant& variant, const std::string& file,
                                const Choices& choices) {
  ProgramSource source = program_source(variant, file, choices);
  source.denormals_are_zero = !variant.extended;
  return source;
}

}  // namespace splotchcl
