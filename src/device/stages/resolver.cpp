#include "device/stages/resolver.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <utility>
#include <vector>

#include "certificate/certificate.h"
#include "device/frame/stage_context.h"
#include "device/opencl/launch.h"
#include "device/stages/stage_programs.h"
#include "parallel/for_blocks.h"
#include "scene/ceil_divide.h"
#include "scene/memory_advice.h"
#include "scene/plan/grid_filters.h"
#include "scene/plan/grid_pyramid.h"
#include "splotchcl/frame_check.h"

namespace splotchcl {
namespace {

// All values are 0. A picture is as large as the planes of its sums.
Image image_on_large_pages(int width, int height) {
  const std::size_t values = 4 * static_cast<std::size_t>(width) * static_cast<std::size_t>(height);
  Image image;
  image.width = width;
  image.height = height;
  image.pixels.reserve(values);
  float* const room = image.pixels.data();
  expect_all_written(room, values * sizeof(float));
  // One thread alone would wait for the system to clear it.
  constexpr std::size_t at_once = std::size_t{1} << 19;
  for_blocks(values, at_once, [room](std::size_t first, std::size_t end) {
    make_pages(room + first, (end - first) * sizeof(float));
  });
  image.pixels.resize(values);
  return image;
}

// Rows of eight, or of a strip, may reach beyond the last plane.
constexpr std::size_t padding_of_rows = 2 * STRIP;

// Strips of eight pixels that a row of a part is cut into (kernels/resolve/slab.cl).
std::size_t strips_of_eight(const shared::GridPart& part) {
  return ceil_divide(static_cast<std::size_t>(part.right_end - part.left), 8);
}

// Pairs of an even row and the next that a part touches.
std::size_t row_pairs(const shared::GridPart& part) {
  return ceil_divide(static_cast<std::size_t>(part.bottom - (part.top & ~1)), 2);
}

// Floats of one plane of a part blurred along its columns, and of one refined along them. A part
// that is refined begins with an even column, and has the rows that its taps look at.
std::size_t blurred_floats(const shared::GridPart& part, int reach) {
  const auto height = static_cast<std::size_t>(part.bottom - part.top + 2 * reach);
  return height * 8 * strips_of_eight(part);
}

std::size_t refined_rows(const shared::GridPart& part) {
  return static_cast<std::size_t>(part.bottom - part.top) / 2 + 2 * (REFINEMENT_REACH + 1);
}

std::size_t refined_strips(const shared::GridPart& part) {
  return ceil_divide(static_cast<std::size_t>(part.right_end - part.left) + 1, 16);
}

// Where so much shows through. An opacity of floats errs by ten roundings of 1 (plan.h,
// keeps_transmittance).
float depth_behind(float passed, const LayerLimits& layers) {
  constexpr float roundings = 10 * 0x1p-24f, deepest_of_floats = 88;
  const float known = layers.keeps_transmittance ? passed : passed - roundings;
  return known > 0 ? std::min(-std::log(known), deepest_of_floats) : deepest_of_floats;
}

}  // namespace

Resolver::Resolver(const StageContext& context)
    : context_(context), program_(context.device.programs.get(resolve_program(context.variant))) {
  const Frame& frame = context.frame;
  parameters_.width = frame.crop.width;
  parameters_.height = frame.crop.height;
  for (std::size_t c = 0; c < 3; ++c) {
    parameters_.source[c] = static_cast<float>(context.plan.source[c]);
    parameters_.background[c] = static_cast<float>(frame.background[c]);
  }
  parameters_.crop_x = frame.crop.x;
  parameters_.crop_y = frame.crop.y;
  parameters_.circle_x = 2 * frame.crop.x - frame.width;
  parameters_.circle_y = 2 * frame.crop.y - frame.height;
  if (frame.projection == Projection::fisheye)
    parameters_.circle_diameter = std::min(frame.width, frame.height);
  if (context.layout.grids.size() > 1) {
    grids_program_ = context.device.programs.get(refine_program(context.variant));
    if (context.plan.pyramid.is_blurred())
      blur_program_ = context.device.programs.get(blur_program(context.variant));
  }
  if (needs_depths(frame, context.plan))
    deepest_program_ = context.device.programs.get(deepest_program(context.variant));
  if (context.plan.slabs > 0)
    slab_program_ = context.device.programs.get(lay_slab_program(context.variant));
}

CollectingRoom Resolver::room_for_collecting() const {
  const GridPyramid& pyramid = context_.plan.pyramid;
  const std::vector<shared::GridPart>& wanted = context_.layout.wanted;
  std::size_t floats = 0;
  for (std::size_t level = 0; level < pyramid.level_grids.size(); ++level) {
    const shared::GridPart& part = wanted[level];
    floats = std::max(floats, refined_rows(part) * 16 * refined_strips(part));
    const bool by_axes = !context_.variant.rows && pyramid.is_blurred();
    if (by_axes && static_cast<int>(level) >= pyramid.first_level)
      floats = std::max(floats, blurred_floats(part, reach_of_blurs(pyramid)));
  }
  BufferPool& pool = context_.device.pool;
  CollectingRoom room;
  room.columns = pool.get<float>(context_.variant.planes() * floats, "blurred or refined columns");
  // Of a crop a coarser level may touch more tiles than a finer one.
  std::uint64_t largest_plane = 0;
  for (const shared::Grid& grid : context_.layout.collecting)
    largest_plane = std::max<std::uint64_t>(largest_plane, grid.plane_size);
  for (std::size_t i = 0; i < std::min(room.levels.size(), context_.layout.collecting.size()); ++i)
    room.levels[i] = pool.get<float>(context_.variant.planes() * largest_plane + padding_of_rows,
                                     "a level of grids");
  return room;
}

// The picture's own grid, or what a level is blurred to; of grids that are not blurred the only one
// of the level.
Resolver::LevelLight Resolver::light_of_level(const Planes& planes, int level,
                                              const CollectingRoom& room) const {
  const PictureLayout& layout = context_.layout;
  if (level == 0 || layout.collecting.empty())
    return {&planes.light, static_cast<std::uint32_t>(
                               context_.plan.pyramid.level_grids[static_cast<std::size_t>(level)])};
  const auto number = static_cast<std::size_t>(level - 1);
  return {&room.levels[number % room.levels.size()],
          static_cast<std::uint32_t>(layout.grids.size() + number)};
}

// What every grid holds, brought to the picture's own: blurred level by level, and refined from the
// coarsest on. Grids without light are left out.
Resolver::LevelLight Resolver::collect(const Planes& planes, int finest,
                                       const CollectingRoom& room) const {
  const GridPyramid& pyramid = context_.plan.pyramid;
  LevelLight coarser;
  for (int level = static_cast<int>(pyramid.level_grids.size()) - 1; level >= finest; --level) {
    const LevelLight here = light_of_level(planes, level, room);
    const bool is_own = level == 0 || !pyramid.is_blurred();
    bool has_light = is_own && (planes.used_grids >> here.grid & 1) != 0;
    const std::vector<std::size_t> blurs = blurs_with_light(planes, level);
    if (!blurs.empty()) {
      blur(planes, blurs, level, here, has_light, room);
      has_light = true;
    }
    if (coarser.memory) {
      refine(coarser, here, context_.layout.wanted[static_cast<std::size_t>(level)], has_light,
             room.columns);
      has_light = true;
    }
    coarser = has_light ? here : LevelLight();
  }
  return coarser;
}

std::vector<std::size_t> Resolver::blurs_with_light(const Planes& planes, int level) const {
  const GridPyramid& pyramid = context_.plan.pyramid;
  std::vector<std::size_t> used;
  if (level < pyramid.first_level) return used;
  for (std::size_t i = 0; i < pyramid.blurs.size(); ++i) {
    if ((planes.used_grids >> (pyramid.first_grid_of(level) + i) & 1) != 0) used.push_back(i);
  }
  return used;
}

void Resolver::blur(const Planes& planes, const std::vector<std::size_t>& blurs, int level,
                    const LevelLight& target, bool add, const CollectingRoom& room) const {
  if (context_.variant.rows) {
    blur_in_strips(planes, blurs, level, target, add);
    return;
  }
  for (const std::size_t i : blurs)
    blur_by_axes(planes, i, level, target, add || i != blurs.front(), room.columns);
}

void Resolver::blur_in_strips(const Planes& planes, const std::vector<std::size_t>& blurs,
                              int level, const LevelLight& target, bool add) const {
  const GridPyramid& pyramid = context_.plan.pyramid;
  const shared::GridPart& part = context_.layout.wanted[static_cast<std::size_t>(level)];
  shared::BlurStripsParameters parameters{};
  parameters.target = target.grid;
  parameters.part = part;
  parameters.add = add;
  for (const std::size_t i : blurs) {
    const std::vector<float> weights = blur_weights(pyramid.blurs[i], pyramid.blur_error);
    shared::BlurWeights& blur = parameters.blurs[parameters.source_count++];
    blur.source = static_cast<std::uint32_t>(pyramid.first_grid_of(level) + i);
    blur.half_width = static_cast<int>(weights.size() / 2);
    static_assert(most_blur_weights == MOST_BLUR_WEIGHTS);
    std::copy(weights.begin() + blur.half_width, weights.end(), blur.weights);
  }
  const auto width = static_cast<std::size_t>(part.right_end - part.left);
  const auto height = static_cast<std::size_t>(part.bottom - part.top);
  Launch(context_.device, "resolve", blur_program_.create_kernel("blur_strips"))
      .value(parameters)
      .arg(context_.grids)
      .arg(planes.light)
      .arg(*target.memory)
      .run_grid(ceil_divide(width, STRIP), ceil_divide(height, ROWS_OF_BAND),
                context_.variant.planes());
}

void Resolver::blur_by_axes(const Planes& planes, std::size_t blur, int level,
                            const LevelLight& target, bool add,
                            const Buffer<float>& columns) const {
  const GridPyramid& pyramid = context_.plan.pyramid;
  const shared::GridPart& part = context_.layout.wanted[static_cast<std::size_t>(level)];
  const std::vector<float> weights = blur_weights(pyramid.blurs[blur], pyramid.blur_error);
  shared::BlurParameters parameters{};
  parameters.source = static_cast<std::uint32_t>(pyramid.first_grid_of(level) + blur);
  parameters.target = target.grid;
  parameters.part = part;
  parameters.half_width = static_cast<int>(weights.size() / 2);
  parameters.add = add;
  static_assert(most_blur_weights == MOST_BLUR_WEIGHTS);
  std::copy(weights.begin(), weights.end(), parameters.weights);

  const std::size_t width_strips = strips_of_eight(part);
  const auto height = static_cast<std::size_t>(part.bottom - part.top);
  const std::size_t source_height = height + 2 * static_cast<std::size_t>(parameters.half_width);
  const std::size_t plane_count = context_.variant.planes();
  Launch(context_.device, "resolve", blur_program_.create_kernel("blur_columns"))
      .value(parameters)
      .arg(context_.grids)
      .arg(planes.light)
      .arg(columns)
      .run_grid(width_strips, source_height, plane_count);
  Launch(context_.device, "resolve", blur_program_.create_kernel("blur_rows"))
      .value(parameters)
      .arg(context_.grids)
      .arg(*target.memory)
      .arg(columns)
      .run_grid(width_strips, height, plane_count);
}

shared::RefineParameters Resolver::refine_parameters(std::uint32_t coarse, std::uint32_t fine,
                                                     const shared::GridPart& part) const {
  shared::RefineParameters parameters{};
  parameters.coarse = coarse;
  parameters.fine = fine;
  parameters.part = part;
  static_assert(refinement_taps == REFINEMENT_TAPS);
  static_assert(RefinementFilter::reach() == REFINEMENT_REACH);
  const std::array<double, refinement_taps>& weights = context_.plan.pyramid.refinement.weights;
  std::transform(weights.begin(), weights.end(), parameters.weights,
                 [](double weight) { return static_cast<float>(weight); });
  return parameters;
}

std::size_t Resolver::items_of(std::size_t eights) const {
  return ceil_divide(eights, context_.variant.eights_of_item());
}

void Resolver::refine_columns(const LevelLight& coarse, const shared::RefineParameters& parameters,
                              const Buffer<float>& columns) const {
  Launch(context_.device, "resolve", grids_program_.create_kernel("refine_columns"))
      .value(parameters)
      .arg(context_.grids)
      .arg(*coarse.memory)
      .arg(columns)
      .run_grid(items_of(refined_strips(parameters.part)), refined_rows(parameters.part),
                context_.variant.planes());
}

void Resolver::refine(const LevelLight& coarse, const LevelLight& fine,
                      const shared::GridPart& part, bool add, const Buffer<float>& columns) const {
  shared::RefineParameters parameters = refine_parameters(coarse.grid, fine.grid, part);
  parameters.add = add;
  refine_columns(coarse, parameters, columns);
  Launch(context_.device, "resolve", grids_program_.create_kernel("refine_rows"))
      .value(parameters)
      .arg(context_.grids)
      .arg(*fine.memory)
      .arg(columns)
      .run_grid(items_of(strips_of_eight(part)), row_pairs(part), context_.variant.planes());
}

SlabLight Resolver::start_slabs() const {
  const shared::Grid& grid = context_.layout.grids.front();
  const shared::GridPart& part = context_.layout.wanted.front();
  const std::uint64_t floats = std::uint64_t{context_.variant.planes()} * grid.plane_size;
  const std::size_t eights =
      strips_of_eight(part) * static_cast<std::size_t>(part.bottom - part.top);
  SlabLight slab;
  // Rows of eight may reach beyond the last plane.
  slab.before = context_.device.pool.get<float>(floats + 8, "planes before a slab");
  slab.errors = context_.device.pool.get<float>(eights, "errors of slabs");
  for (const Buffer<float>* buffer : {&slab.before, &slab.errors})
    clear_memory(context_.device, "resolve", buffer->memory(), 0, buffer->size() * sizeof(float));
  slab.room = room_for_collecting();
  return slab;
}

Planes Resolver::lay_slab(Planes light, SlabLight& slab) const {
  constexpr std::uint32_t picture = 1;
  if (light.used_grids == picture) return light;
  Planes planes = std::move(light);
  const LevelLight coarse = collect(planes, 1, slab.room);
  const shared::GridPart& part = context_.layout.wanted.front();
  const shared::RefineParameters parameters = refine_parameters(coarse.grid, 0, part);
  refine_columns(coarse, parameters, slab.room.columns);
  Launch(context_.device, "resolve", slab_program_.create_kernel("lay_slab"))
      .value(parameters)
      .arg(context_.grids)
      .arg(planes.light)
      .arg(slab.room.columns)
      .arg(slab.before)
      .arg(slab.errors)
      .run_grid(items_of(strips_of_eight(part)), row_pairs(part), 1);
  planes.used_grids = picture;
  return planes;
}

void Resolver::begin_slab(const Planes& planes, const SlabLight& slab) const {
  const shared::Grid& grid = context_.layout.grids.front();
  const std::size_t first = floats_before(grid);
  const std::size_t floats = std::size_t{context_.variant.planes()} * grid.plane_size;
  context_.device.timer.add(
      "resolve",
      context_.device.queue.enqueue_copy_buffer(planes.light.memory(), slab.before.memory(),
                                                first * sizeof(float), 0, floats * sizeof(float)),
      StageTimer::Kind::serial);
}

std::vector<float> Resolver::errors_of_slabs(const SlabLight& slab) const {
  const std::size_t eights = strips_of_eight(context_.layout.wanted.front());
  const auto rows = static_cast<std::size_t>(parameters_.height);
  const std::vector<float> of_eights = context_.device.pool.download(slab.errors, eights * rows);
  constexpr std::size_t side = BlockErrors::block_pixels;
  const auto columns = static_cast<std::size_t>(BlockErrors::blocks_along(parameters_.width));
  std::vector<float> blocks(
      columns * static_cast<std::size_t>(BlockErrors::blocks_along(parameters_.height)));
  for (std::size_t y = 0; y < rows; ++y) {
    for (std::size_t x = 0; x < eights; ++x) {
      float& block = blocks[y / side * columns + x * 8 / side];
      block = std::max(block, of_eights[y * eights + x]);
    }
  }
  return blocks;
}

Buffer<float> Resolver::find_deepest(const Planes& planes) const {
  static_assert(BlockErrors::block_pixels == ROWS_OF_BLOCK);
  const std::size_t eights = ceil_divide(static_cast<std::size_t>(parameters_.width), 8);
  const auto rows = static_cast<std::size_t>(BlockErrors::blocks_along(parameters_.height));
  auto deepest = context_.device.pool.get<float>(eights * rows, "depths of blocks");
  Launch(context_.device, "resolve", deepest_program_.create_kernel("find_deepest"))
      .value(parameters_)
      .arg(context_.grids)
      .arg(planes.light)
      .arg(deepest)
      .run_grid(eights, rows, 1);
  return deepest;
}

std::vector<float> Resolver::depths_of_blocks(const Buffer<float>& deepest) const {
  constexpr std::size_t eights_of_block = BlockErrors::block_pixels / 8;
  const std::size_t eights = ceil_divide(static_cast<std::size_t>(parameters_.width), 8);
  const auto columns = static_cast<std::size_t>(BlockErrors::blocks_along(parameters_.width));
  const auto rows = static_cast<std::size_t>(BlockErrors::blocks_along(parameters_.height));
  const std::vector<float> of_eights = context_.device.pool.download(deepest, eights * rows);
  std::vector<float> blocks(columns * rows, 1.0f);
  for (std::size_t i = 0; i < of_eights.size(); ++i) {
    float& block = blocks[i / eights * columns + i % eights / eights_of_block];
    block = std::min(block, of_eights[i]);
  }
  for (float& block : blocks)
    block = context_.plan.needs_sort() ? depth_behind(block, context_.plan.layers) : 1 - block;
  return blocks;
}

// The crop's part of the background's picture, a plane per channel, in rows of `stride`.
Buffer<float> Resolver::upload_background(std::size_t stride) const {
  const Rectangle& crop = context_.frame.crop;
  const std::size_t plane = stride * static_cast<std::size_t>(crop.height);
  std::vector<float> planes(3 * plane);
  for (int y = 0; y < crop.height; ++y) {
    for (int x = 0; x < crop.width; ++x) {
      const float* pixel = context_.frame.background_image->at(crop.x + x, crop.y + y);
      const std::size_t place = static_cast<std::size_t>(y) * stride + static_cast<std::size_t>(x);
      for (std::size_t c = 0; c < 3; ++c)
        planes[c * plane + place] = pixel[c];
    }
  }
  return context_.device.pool.upload(planes, "background");
}

Planes Resolver::to_picture(Planes light) const {
  constexpr std::uint32_t picture = 1;
  if ((light.used_grids & ~picture) != 0) collect(light, 0, room_for_collecting());
  light.used_grids = picture;
  return light;
}

Image Resolver::resolve(Planes light) const {
  const Planes planes = to_picture(std::move(light));
  if (context_.device.traits.shares_host_memory) {
    Image image = image_on_large_pages(parameters_.width, parameters_.height);
    resolve_in_place(planes, image);
    return image;
  }
  const std::size_t values = 4 * static_cast<std::size_t>(parameters_.width) *
                             static_cast<std::size_t>(parameters_.height);
  const auto pixels = context_.device.pool.get<float>(values, "image");
  write_pixels(planes, pixels.memory());
  context_.device.queue.flush();
  // While the device draws: the system takes milliseconds to clear the memory of a large picture.
  Image image = image_on_large_pages(parameters_.width, parameters_.height);
  context_.device.copies.read(pixels.memory(), image.pixels.data(), values * sizeof(float));
  return image;
}

// A device in the host's own memory writes the picture where it is wanted; mapping it makes
// what was written visible.
void Resolver::resolve_in_place(const Planes& planes, Image& image) const {
  compute::command_queue& queue = context_.device.queue;
  const std::size_t bytes = image.pixels.size() * sizeof(float);
  const compute::buffer pixels(context_.device.context, bytes,
                               CL_MEM_WRITE_ONLY | CL_MEM_USE_HOST_PTR, image.pixels.data());
  write_pixels(planes, pixels);
  void* const mapped = queue.enqueue_map_buffer(pixels, CL_MAP_READ, 0, bytes);
  queue.enqueue_unmap_buffer(pixels, mapped).wait();
}

void Resolver::write_pixels(const Planes& planes, const compute::buffer& pixels) const {
  DeviceContext& device = context_.device;
  const std::size_t width_strips = ceil_divide(static_cast<std::size_t>(parameters_.width), 8);
  shared::ResolveParameters parameters = parameters_;
  parameters.background_stride = static_cast<int>(8 * width_strips);
  const Buffer<float> background = context_.variant.background_image
                                       ? upload_background(8 * width_strips)
                                       : device.pool.get<float>(0, "unused");
  Launch(device, "resolve", program_.create_kernel("resolve"))
      .value(parameters)
      .arg(context_.grids)
      .arg(planes.light)
      .arg(background)
      .arg(pixels)
      .run_grid(items_of(width_strips), static_cast<std::size_t>(parameters_.height), 1);
}

}  // namespace splotchcl
