#include "device/frame/specialization.h"

#include "device/frame/key_parts.h"
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
ProgramSource layers_of(const std::string& defines, const std::vector<std::string>& files) {
  ProgramSource source = {defines, files};
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
      short_exponential_(plan.has_short_exponential),
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
      ten_taps_(plan.pyramid.refinement.has_ten_taps),
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
  return {defines, project_files(output)};
}

bool Specialization::finds_tiles(ProjectOutput output) const {
  return (output == ProjectOutput::splats && rows_) || (writes_splats(output) && has_own_tiles());
}

// Where the camera sees particles.
std::vector<std::string> Specialization::view_files() const {
  std::vector<std::string> files = {"splat.h",     "project.h",   "common.cl", "lanes.cl",
                                    "extended.cl", "prefetch.cl", "pieces.cl", "load.cl"};
  if (!rows_) files.insert(files.begin(), "group.h");
  if (is_wide_angle(projection_))
    files.insert(files.end(), {"extended_angle.cl", "wide_angle.cl", "wide_angle_extended.cl"});
  files.push_back("view.cl");
  if (face_of_cube_) files.insert(files.end(), {"face_ellipse.cl", "face_ellipse_extended.cl"});
  if (clouds_around_) files.push_back("around.cl");
  files.insert(files.end(), {"place_extended.cl", "limits.cl", "depth_key.cl"});
  return files;
}

std::vector<std::string> Specialization::project_files(ProjectOutput output) const {
  std::vector<std::string> files = view_files();
  if (!extended_) files.insert(files.end(), {"extended_value.cl", "sharp_places.cl"});
  files.insert(files.end(), {"splat_place.cl", "splat_widths.cl", "splat_brightness.cl",
                             "splat_sampling.cl", "splat_reach.cl", "splat_lanes.cl"});
  if (extended_) files.push_back("project_extended.cl");
  if (finds_tiles(output)) files.insert(files.end(), {"tiles.cl", "tile_lanes.cl"});
  files.insert(files.end(), {"sort_keys.cl", "words.cl", "splat_arrays.cl"});
  if (rows_) {
    files.push_back("project.cl");
  } else {
    files.insert(files.end(), {"group_sums.cl", "project_groups.cl"});
  }
  return files;
}

std::string Specialization::wide_angle_defines() const {
  return define("WIDE_ANGLE") +
         define_if(projection_ == Projection::fisheye, "PROJECTION_FISHEYE") +
         define_if(projection_ == Projection::equirectangular, "PROJECTION_EQUIRECTANGULAR") +
         define_if(ellipses_, "ELLIPSES") + define_if(copies_, "COPIES") +
         define_if(face_of_cube_, "FACE_OF_CUBE");
}

ProgramSource Specialization::interpolate(bool rows) {
  return {define_if(rows, "LANES_8"),
          {"splat.h", "interpolate.h", "common.cl", "lanes.cl", "interpolate.cl"}};
}

ProgramSource Specialization::boxes(bool rows, bool vector_colors) {
  return {define_if(rows, "LANES_8") + define_if(vector_colors, "VECTOR_COLORS"),
          {"splat.h", "project.h", "common.cl", "lanes.cl", "prefetch.cl", "load.cl", "boxes.cl"}};
}

ProgramSource Specialization::scan_blocks() {
  return {"", {"splat.h", "project.h", "scan.cl"}};
}

ProgramSource Specialization::compact() {
  return {"", {"splat.h", "project.h", "compact.cl"}};
}

ProgramSource Specialization::key_parts() const {
  return {define("SPLAT_WORDS " + std::to_string(splat_bytes() / sizeof(cl_uint))) +
              define("MOST_KEY_PARTS " + std::to_string(most_key_parts)),
          {"splat.h", "project.h", "prefetch.cl", "pieces.cl", "key_parts.cl"}};
}

ProgramSource Specialization::sort_parts() {
  return {"", {"prefetch.cl", "pieces.cl", "sort.h", "sort_parts.cl"}};
}

ProgramSource Specialization::sort() {
  return {"",
          {"group.h", "splat.h", "sort.h", "common.cl", "prefetch.cl", "pieces.cl", "short_run.cl",
           "sort.cl"}};
}

ProgramSource Specialization::carry() {
  return {"", {"carry.cl"}};
}

ProgramSource Specialization::sort_groups() {
  return {"",
          {"group.h", "splat.h", "sort.h", "common.cl", "group_sums.cl", "short_run.cl",
           "sort_groups.cl"}};
}

ProgramSource Specialization::scan() {
  return {"", {"group.h", "splat.h", "scan.h", "common.cl", "group_sums.cl", "scan_groups.cl"}};
}

ProgramSource Specialization::bin() const {
  const std::string defines = tile_defines() + define_if(vector_colors_, "VECTOR_COLORS") +
                              define_if(has_whole_sectors(), "WHOLE_SECTORS") +
                              define_if(has_own_tiles(), "TILES_IN_SPLAT") +
                              define_if(!is_ordered(), "BLOCKS_OF_PROJECTION");
  if (rows_) {
    return {defines,
            {"splat.h", "project.h", "bin.h", "common.cl", "prefetch.cl", "pieces.cl", "tiles.cl",
             "amplitudes.cl", "entries.cl", "bin.cl"}};
  }
  return {defines,
          {"group.h", "splat.h", "project.h", "bin.h", "common.cl", "tiles.cl", "group_sums.cl",
           "amplitudes.cl", "entries.cl", "bin_groups.cl"}};
}

ProgramSource Specialization::composite() const {
  std::string defines = tile_defines() + define_if(kernel_cut_, "KERNEL_CUT") +
                        define_if(short_exponential_, "SHORT_EXPONENTIAL") +
                        define_if(pixel_means_, "SAMPLING_MEAN");
  if (extended_) {
    defines += define("LANES_8") + define_if(double_numbers_, "DOUBLE_NUMBERS");
    std::vector<std::string> files = {
        "splat.h",    "bin.h",       "composite.h",       "common.cl",         "lanes.cl",
        "precise.cl", "extended.cl", "extended_lanes.cl", "extended_pixels.cl"};
    if (has_rows())
      files.insert(files.end(), {"double_lanes.cl", "extended_means.cl", "extended_shape.cl",
                                 "pieces.cl", "composite_extended_rows.cl"});
    else
      files.push_back("composite_extended_groups.cl");
    return {defines, files};
  }
  defines += number_defines() + define_if(rows_, "LANES_8") +
             define_if(takes_rows_of_16(), "ROWS_OF_16") + define_if(stencils_, "STENCILS") +
             block_defines();
  return layers_of(defines, composite_files());
}

ProgramSource Specialization::composite_with_clouds() const {
  ProgramSource source = composite();
  source.defines += define("CLOUDS_IN_LISTS");
  return source;
}

std::vector<std::string> Specialization::composite_files() const {
  std::vector<std::string> files = {"splat.h", "bin.h", "composite.h", "common.cl"};
  if (takes_rows_of_16())
    files.insert(files.end(), {"lanes_of_16.cl", "gaussian.cl", "opacity.cl"});
  files.insert(files.end(),
               {"lanes.cl", "gaussian.cl", "shape.cl", "opacity.cl", "clouds.cl", "stencil.cl"});
  if (face_of_cube_) files.push_back("face_shape.cl");
  if (rows_) {
    files.insert(files.end(), {"rows.cl", "prefetch.cl", "words.cl", "entry_lanes.cl",
                               "entry_windows.cl", "patch.cl", "patch_reach.cl", "patch_shapes.cl",
                               "patches.cl", "waiting.cl", "tile_planes.cl"});
    if (face_of_cube_) {
      files.push_back("face_rows.cl");
    } else {
      files.push_back("splat_rows.cl");
    }
    files.insert(files.end(),
                 {"stencil_rows.cl", "narrow_splats.cl", "narrow_discs.cl", "ordered_list.cl",
                  "entry_group.cl", "summed_list.cl", "pieces.cl", "composite_rows.cl"});
  } else {
    files.insert(files.end(),
                 {"flags.cl", "tile_batch.cl", "layer_behind.cl", "composite_groups.cl"});
  }
  return files;
}

std::vector<std::string> Specialization::join_files() const {
  std::vector<std::string> files = {"splat.h",   "bin.h",    "composite.h",
                                    "common.cl", "lanes.cl", "opacity.cl"};
  if (rows_) {
    files.insert(files.end(), {"join_pixels.cl", "join.cl"});
  } else {
    files.insert(files.end(), {"layer_behind.cl", "join_groups.cl"});
  }
  return files;
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
                   join_files());
}

// Coarse grids are for round splats that are not cut, and take center values.
ProgramSource Specialization::composite_slab() const {
  const std::string blocks = small_blocks_ || !rows_ ? define("SPLATS_OF_BLOCK 64u")
                             : full_precision_       ? define("SPLATS_OF_BLOCK 256u")
                                                     : std::string();
  return layers_of(slab_defines() + define_if(full_precision_, "FULL_PRECISION") +
                       define_if(rows_, "LANES_8") + define_if(takes_rows_of_16(), "ROWS_OF_16") +
                       blocks,
                   composite_files());
}

ProgramSource Specialization::join_slab() const {
  return layers_of(slab_defines() + define_if(rows_, "LANES_8"), join_files());
}

ProgramSource Specialization::lay_slab() const {
  return {define("LANES_8") + define_if(ten_taps_, "TEN_TAPS") + item_defines(),
          {"splat.h", "resolve.h", "common.cl", "lanes.cl", "gaussian.cl", "shape.cl",
           "prefetch.cl", "refine.cl", "slab.cl"}};
}

ProgramSource Specialization::list_around() const {
  std::string defines = define_if(rows_, "LANES_8") + define_if(vector_colors_, "VECTOR_COLORS") +
                        define_if(double_numbers_, "DOUBLE_NUMBERS");
  if (is_wide_angle(projection_)) defines += wide_angle_defines();
  std::vector<std::string> files = view_files();
  files.push_back("list_around.cl");
  return {defines, files};
}

ProgramSource Specialization::behind() const {
  const std::string defines = define_if(is_ordered(), "LIGHT_ORDERED");
  if (extended_) {
    return {defines + define("LANES_8") + define_if(double_numbers_, "DOUBLE_NUMBERS"),
            {"splat.h", "composite.h", "common.cl", "lanes.cl", "precise.cl", "extended.cl",
             "extended_lanes.cl", "behind_extended.cl"}};
  }
  return {defines + define_if(keeps_transmittance_, "KEEP_TRANSMITTANCE") +
              define("PIXELS_BEHIND " + std::to_string(pixels_behind())),
          {"splat.h", "composite.h", "common.cl", "lanes.cl", "opacity.cl", "behind.cl"}};
}

int Specialization::pixels_behind() const {
  return extended_ ? 8 : rows_ ? 64 : 1;
}

ProgramSource Specialization::certify() const {
  const std::string defines =
      define_if(rows_, "LANES_8") + tile_defines() + define_if(kernel_cut_, "KERNEL_CUT");
  if (rows_) {
    return {defines,
            {"splat.h", "bin.h", "certify.h", "common.cl", "lanes.cl", "prefetch.cl", "pieces.cl",
             "words.cl", "entry_lanes.cl", "collected.cl", "collect.cl"}};
  }
  return {defines,
          {"group.h", "splat.h", "bin.h", "certify.h", "common.cl", "group_sums.cl", "lanes.cl",
           "entry_lanes.cl", "collected.cl", "collect_groups.cl"}};
}

std::string Specialization::item_defines() const {
  return define("EIGHTS_OF_ITEM " + std::to_string(eights_of_item()));
}

ProgramSource Specialization::coarse_grids() const {
  std::vector<std::string> files = {"splat.h", "resolve.h", "common.cl", "prefetch.cl"};
  if (!rows_) files.push_back("blur.cl");
  files.push_back("refine.cl");
  return {define_if(ten_taps_, "TEN_TAPS") + item_defines(), files};
}

ProgramSource Specialization::blur_strips() const {
  return {define_if(rows_of_16_, "LANES_16") + define("LANES_8"),
          {"splat.h", "resolve.h", "common.cl", "lanes.cl", "prefetch.cl", "blur_strips.cl"}};
}

ProgramSource Specialization::clear() {
  return {"", {"clear.h", "clear.cl"}};
}

ProgramSource Specialization::add_light() {
  return {"", {"splat.h", "composite.h", "add_light.cl"}};
}

ProgramSource Specialization::resolve() const {
  const std::string defines = define("LANES_8") + number_defines() +
                              define_if(extended_, "EXTENDED_NUMBERS") +
                              define_if(is_ordered(), "LIGHT_ORDERED") +
                              define_if(light_ == LightPlan::emission, "LIGHT_EMISSION") +
                              define_if(background_image_, "BACKGROUND_IMAGE") + item_defines();
  return {defines,
          {"splat.h", "resolve.h", "common.cl", "lanes.cl", "gaussian.cl", "shape.cl", "opacity.cl",
           "precise.cl", "resolve.cl"}};
}

}  // namespace splotchcl
