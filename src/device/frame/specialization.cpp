#include "device/frame/specialization.h"

#include "device/frame/shared.h"
#include "scene/plan/splat_limits.h"
#include "surroundings/cloud_around.h"

namespace splotchcl {
namespace {

std::string define(const std::string& name_and_value) {
  return "#define " + name_and_value + "\n";
}

std::string define_if(bool condition, const std::string& name) {
  return condition ? define(name) : std::string();
}

// Light that passes many layers fades to denormal numbers, which no picture shows.
ProgramSource layers_of(const std::string& defines, const std::string& file) {
  ProgramSource source = {defines, file};
  source.denormals_are_zero = true;
  return source;
}

bool writes_splats(ProjectOutput output) {
  return output != ProjectOutput::counts && output != ProjectOutput::key_counts &&
         output != ProjectOutput::window_counts;
}

}  // namespace

bool is_of_window(ProjectOutput output) {
  return output == ProjectOutput::key_counts || output == ProjectOutput::window_counts ||
         output == ProjectOutput::window_splats;
}

Specialization::Specialization(const Frame& frame, const FramePlan& plan,
                               const DeviceTraits& traits)
    : light_(plan.light),
      projection_(frame.projection),
      rows_(traits.rows),
      rows_of_16_(traits.rows_of_16),
      extended_(plan.is_extended()),
      double_numbers_(traits.double_numbers),
      full_precision_(plan.precision != Precision::fast),
      fine_places_(plan.has_fine_places && !extended_),
      small_blocks_(plan.adds_small_blocks),
      kernel_cut_(frame.kernel.cut.has_value()),
      pixel_means_(takes_pixel_means(frame)),
      vector_colors_(plan.has_vector_colors),
      ellipses_(plan.has_ellipses),
      copies_(plan.has_copies),
      face_of_cube_(plan.is_face_of_cube),
      keeps_transmittance_(plan.layers.keeps_transmittance),
      clouds_around_(has_clouds_around(frame)),
      stencils_(plan.pyramid.has_stencils()),
      background_image_(frame.background_image != nullptr) {
  if (has_rows()) {
    tile_width_ = is_ordered() || extended_ ? 32 : 64;
    tile_height_ = 32;
  }
}

std::uint32_t Specialization::planes() const {
  return (is_ordered() ? 6u : 3u) * (extended_ ? 2u : 1u);
}

std::size_t Specialization::splat_bytes() const {
  return sizeof(shared::Splat) + (ellipses_ ? sizeof(shared::WidthAlongX) : 0) +
         (face_of_cube_ ? sizeof(shared::Tilt) + sizeof(cl_float) : 0) +
         (vector_colors_ ? sizeof(shared::OwnColor) : 0) + (fine_places_ ? sizeof(cl_uint) : 0) +
         (has_whole_sectors() ? sizeof(cl_uint) : 0) + (has_own_tiles() ? sizeof(cl_uint) : 0);
}

// The lanes that project a splat know its tiles. With that word a splat is as many words as there
// are lanes, and most of those that are gathered in sorted order lie in one line of the cache.
bool Specialization::has_own_tiles() const {
  return rows_ && !ellipses_ && !extended_;
}

// Splats of seven words are gathered in one sector of a GPU's memory with one more.
bool Specialization::has_whole_sectors() const {
  return !rows_ && !ellipses_ && !vector_colors_ && !fine_places_;
}

std::string Specialization::splat_defines() const {
  return define_if(vector_colors_, "VECTOR_COLORS") + define_if(fine_places_, "FINE_PLACES") +
         define_if(has_whole_sectors(), "WHOLE_SECTORS") +
         define_if(has_own_tiles(), "TILES_IN_SPLAT");
}

std::size_t Specialization::extended_splat_bytes() const {
  if (!extended_) return 0;
  return sizeof(shared::ExtendedSplat) + (ellipses_ ? sizeof(shared::ExtendedAlongX) : 0) +
         (face_of_cube_ ? sizeof(shared::ExtendedTilt) : 0);
}

// TileSplat, bin.h.
std::size_t Specialization::tile_splat_bytes() const {
  if (extended_) return sizeof(cl_uint);
  const std::size_t shape = 4 * sizeof(float) + (ellipses_ ? sizeof(shared::WidthAlongX) : 0) +
                            (face_of_cube_ ? sizeof(shared::Tilt) : 0) +
                            (fine_places_ ? 2 * sizeof(float) : 0);
  return shape + (is_ordered() ? 6 : 3) * sizeof(float);
}

std::string Specialization::tile_size_defines() const {
  return define("TILE_WIDTH " + std::to_string(tile_width_)) +
         define("TILE_HEIGHT " + std::to_string(tile_height_));
}

std::string Specialization::tile_defines() const {
  return tile_size_defines() + define("PLANES " + std::to_string(planes())) +
         define_if(is_ordered(), "LIGHT_ORDERED") + define_if(extended_, "EXTENDED_NUMBERS") +
         define_if(ellipses_, "ELLIPSES") + define_if(face_of_cube_, "FACE_OF_CUBE") +
         define_if(fine_places_, "FINE_PLACES");
}

std::string Specialization::slab_defines() const {
  return tile_size_defines() + define("PLANES 6") + define("SUMMED 6") +
         define_if(fine_places_, "FINE_PLACES");
}

std::string Specialization::number_defines() const {
  return define_if(full_precision_, "FULL_PRECISION") +
         define_if(keeps_transmittance_, "KEEP_TRANSMITTANCE");
}

ProgramSource Specialization::project(ProjectOutput output) const {
  // Extended numbers are of one particle at a time.
  std::string defines = define_if(rows_ && rows_of_16_ && !extended_, "LANES_16") +
                        define_if(rows_, "LANES_8") + splat_defines() +
                        define_if(clouds_around_, "CLOUDS_AROUND");
  if (writes_splats(output)) defines += define("OUTPUT_SPLATS");
  if (output == ProjectOutput::splats_and_keys || output == ProjectOutput::window_splats)
    defines += define("OUTPUT_KEYS");
  if (is_of_window(output)) defines += define("KEY_WINDOW");
  if (output == ProjectOutput::key_counts) defines += define("COUNT_KEYS");
  if (output == ProjectOutput::splats && rows_) defines += define("COUNT_TILES");
  if (finds_tiles(output)) defines += tile_size_defines();
  defines += define_if(double_numbers_, "DOUBLE_NUMBERS");
  if (is_wide_angle(projection_)) defines += wide_angle_defines();
  defines += define_if(extended_, "EXTENDED_NUMBERS");
  return {defines, rows_ ? "kernels/project/project.cl" : "kernels/project/project_groups.cl"};
}

bool Specialization::finds_tiles(ProjectOutput output) const {
  return (output == ProjectOutput::splats && rows_) || (writes_splats(output) && has_own_tiles());
}

std::string Specialization::wide_angle_defines() const {
  return define("WIDE_ANGLE") +
         define_if(projection_ == Projection::fisheye, "PROJECTION_FISHEYE") +
         define_if(projection_ == Projection::equirectangular, "PROJECTION_EQUIRECTANGULAR") +
         define_if(ellipses_, "ELLIPSES") + define_if(copies_, "COPIES") +
         define_if(face_of_cube_, "FACE_OF_CUBE");
}

ProgramSource Specialization::interpolate(bool rows) {
  return {define_if(rows, "LANES_8"), "kernels/interpolate/interpolate.cl"};
}

ProgramSource Specialization::boxes(bool rows, bool vector_colors) {
  return {define_if(rows, "LANES_8") + define_if(vector_colors, "VECTOR_COLORS"),
          "kernels/project/boxes.cl"};
}

ProgramSource Specialization::scan_blocks() {
  return {"", "kernels/project/scan.cl"};
}

ProgramSource Specialization::compact() {
  return {"", "kernels/project/compact.cl"};
}

ProgramSource Specialization::sort() {
  return {"", "kernels/sort/sort.cl"};
}

ProgramSource Specialization::carry() {
  return {"", "kernels/sort/carry.cl"};
}

ProgramSource Specialization::sort_groups() {
  return {"", "kernels/sort/sort_groups.cl"};
}

ProgramSource Specialization::scan() {
  return {"", "kernels/scan/scan_groups.cl"};
}

std::string Specialization::composite_file() const {
  return rows_ ? "kernels/composite/composite_rows.cl" : "kernels/composite/composite_groups.cl";
}

std::string Specialization::join_file() const {
  return rows_ ? "kernels/composite/join.cl" : "kernels/composite/join_groups.cl";
}

ProgramSource Specialization::bin() const {
  const std::string defines = tile_defines() + define_if(vector_colors_, "VECTOR_COLORS") +
                              define_if(has_whole_sectors(), "WHOLE_SECTORS") +
                              define_if(has_own_tiles(), "TILES_IN_SPLAT") +
                              define_if(!is_ordered(), "BLOCKS_OF_PROJECTION");
  if (rows_) {
    return {defines, "kernels/bin/bin.cl"};
  }
  return {defines, "kernels/bin/bin_groups.cl"};
}

ProgramSource Specialization::composite() const {
  std::string defines = tile_defines() + define_if(kernel_cut_, "KERNEL_CUT") +
                        define_if(pixel_means_, "SAMPLING_MEAN");
  if (extended_) {
    defines += define("LANES_8") + define_if(double_numbers_, "DOUBLE_NUMBERS");
    return {defines, has_rows() ? "kernels/composite/composite_extended_rows.cl"
                                : "kernels/composite/composite_extended_groups.cl"};
  }
  defines += number_defines() + define_if(rows_, "LANES_8") +
             define_if(takes_rows_of_16(), "ROWS_OF_16") + define_if(stencils_, "STENCILS") +
             block_defines();
  return layers_of(defines, composite_file());
}

ProgramSource Specialization::composite_with_clouds() const {
  ProgramSource source = composite();
  source.defines += define("CLOUDS_IN_LISTS");
  return source;
}

// A block of n splats errs by n roundings at most: 64 of them by less than 1e-5, 256 by less than
// 3e-5, but adding up smaller blocks takes rows as long as drawing them. Sums of light to three
// digits need none beside the lists; opacities stand still behind too many layers.
std::string Specialization::block_defines() const {
  // Behind many equal layers of opacity a bright background shows half as many roundings.
  if (small_blocks_ && is_ordered()) return define("SPLATS_OF_BLOCK 32u");
  if (small_blocks_ || !rows_) return define("SPLATS_OF_BLOCK 64u");
  if (full_precision_) return define("SPLATS_OF_BLOCK 256u");
  return is_ordered() ? define("SPLATS_OF_BLOCK 1024u") : "";
}

ProgramSource Specialization::join() const {
  return layers_of(tile_defines() + define_if(rows_, "LANES_8") +
                       define_if(keeps_transmittance_, "KEEP_TRANSMITTANCE"),
                   join_file());
}

// Coarse grids are for round splats that are not cut, and take center values.
ProgramSource Specialization::composite_slab() const {
  const std::string blocks = small_blocks_ || !rows_ ? define("SPLATS_OF_BLOCK 64u")
                             : full_precision_       ? define("SPLATS_OF_BLOCK 256u")
                                                     : std::string();
  return layers_of(slab_defines() + define_if(full_precision_, "FULL_PRECISION") +
                       define_if(rows_, "LANES_8") + define_if(takes_rows_of_16(), "ROWS_OF_16") +
                       blocks,
                   composite_file());
}

ProgramSource Specialization::join_slab() const {
  return layers_of(slab_defines() + define_if(rows_, "LANES_8"), join_file());
}

ProgramSource Specialization::lay_slab() const {
  return {define("LANES_8") + item_defines(), "kernels/resolve/slab.cl"};
}

ProgramSource Specialization::list_around() const {
  std::string defines = define_if(rows_, "LANES_8") + define_if(vector_colors_, "VECTOR_COLORS") +
                        define_if(double_numbers_, "DOUBLE_NUMBERS");
  if (is_wide_angle(projection_)) defines += wide_angle_defines();
  return {defines, "kernels/project/list_around.cl"};
}

ProgramSource Specialization::behind() const {
  const std::string defines = define_if(is_ordered(), "LIGHT_ORDERED");
  if (extended_) {
    return {defines + define("LANES_8") + define_if(double_numbers_, "DOUBLE_NUMBERS"),
            "kernels/composite/behind_extended.cl"};
  }
  return {defines + define_if(keeps_transmittance_, "KEEP_TRANSMITTANCE") +
              define("PIXELS_BEHIND " + std::to_string(pixels_behind())),
          "kernels/composite/behind.cl"};
}

int Specialization::pixels_behind() const {
  return extended_ ? 8 : rows_ ? 64 : 1;
}

ProgramSource Specialization::certify() const {
  const std::string defines =
      define_if(rows_, "LANES_8") + tile_defines() + define_if(kernel_cut_, "KERNEL_CUT");
  if (rows_) {
    return {defines, "kernels/certify/collect.cl"};
  }
  return {defines, "kernels/certify/collect_groups.cl"};
}

std::string Specialization::item_defines() const {
  return define("EIGHTS_OF_ITEM " + std::to_string(eights_of_item()));
}

ProgramSource Specialization::coarse_grids() const {
  return {item_defines(), "kernels/resolve/refine.cl"};
}

ProgramSource Specialization::blur() const {
  if (!rows_) return {"", "kernels/resolve/blur.cl"};
  return {define_if(rows_of_16_, "LANES_16") + define("LANES_8"), "kernels/resolve/blur_strips.cl"};
}

ProgramSource Specialization::clear() {
  return {"", "kernels/common/clear.cl"};
}

ProgramSource Specialization::add_light() {
  return {"", "kernels/composite/add_light.cl"};
}

ProgramSource Specialization::resolve() const {
  const std::string defines = define("LANES_8") + number_defines() +
                              define_if(extended_, "EXTENDED_NUMBERS") +
                              define_if(is_ordered(), "LIGHT_ORDERED") +
                              define_if(light_ == LightPlan::emission, "LIGHT_EMISSION") +
                              define_if(background_image_, "BACKGROUND_IMAGE") + item_defines();
  return {defines, "kernels/resolve/resolve.cl"};
}

}  // namespace splotchcl
