#include "splotchcl/renderer.h"

#include <algorithm>
#include <chrono>
#include <limits>
#include <string>
#include <vector>

#include "device/binner.h"
#include "device/compositor.h"
#include "device/device_context.h"
#include "device/frame_layout.h"
#include "device/particle_buffers.h"
#include "device/projector.h"
#include "device/resolver.h"
#include "device/sorter.h"
#include "splotchcl/error.h"

namespace splotchcl {
namespace {

void check_frame(const Frame& frame) {
  const Rectangle& crop = frame.crop;
  if (crop.width < 1 || crop.height < 1 || crop.x < 0 || crop.y < 0 ||
      crop.x > frame.width - crop.width || crop.y > frame.height - crop.height) {
    throw UsageError("crop: found " + std::to_string(crop.x) + "," + std::to_string(crop.y) + "," +
                     std::to_string(crop.width) + "," + std::to_string(crop.height) +
                     ", expected a part of the picture, which is " + std::to_string(frame.width) +
                     " x " + std::to_string(frame.height) + " pixels");
  }
  if (const Image* const background = frame.background_image.get();
      background != nullptr &&
      (background->width != frame.width || background->height != frame.height)) {
    throw UsageError("background_image: found " + std::to_string(background->width) + " x " +
                     std::to_string(background->height) + " pixels, expected the picture's " +
                     std::to_string(frame.width) + " x " + std::to_string(frame.height));
  }
  std::uint64_t total = 0;
  for (const DrawnComponent& component : frame.components)
    total += component.particles.count;
  constexpr std::uint64_t most = std::numeric_limits<std::uint32_t>::max() - (1u << 20);
  if (total > most) {
    throw DataError("found " + std::to_string(total) + " particles, expected at most " +
                    std::to_string(most) + " in one frame: draw a subset");
  }
  if (frame.components.size() > 0xffff) {
    throw UsageError("found " + std::to_string(frame.components.size()) +
                     " components, expected at most 65535");
  }
}

}  // namespace

struct Renderer::State {
  explicit State(const RendererOptions& options)
      : device(choose_device(options.device)), particles(device) {
    rows = options.shape == CompositeShape::automatic ? device.traits.rows
                                                      : options.shape == CompositeShape::rows;
    // The shape decides for all stages: a processor that is asked for groups also projects one
    // particle at a time, as a GPU does.
    device.traits.rows = rows;
    device.traits.double_numbers &= options.use_double;
  }

  Image render(const Frame& frame);
  Image draw(const Frame& frame, const Plan& plan);
  void draw_sums(const Frame& frame, Projector& projector, Binner& binner, Compositor& compositor);
  void draw_blocks(const SplatBlocks& blocks, Binner& binner, Compositor& compositor);
  void draw_ordered(const Frame& frame, Projector& projector, Binner& binner,
                    Compositor& compositor);

  DeviceContext device;
  ParticleStore particles;
  bool rows = true;
  RenderStats stats;
};

Image Renderer::State::render(const Frame& frame) {
  check_frame(frame);
  const Plan plan = make_plan_from_particles(frame);
  if (plan.needs_exact_places) {
    Frame most_exact = frame;
    most_exact.tolerance = 0;
    return draw(most_exact, make_plan(most_exact));
  }
  return draw(frame, plan);
}

Image Renderer::State::draw(const Frame& frame, const Plan& plan) {
  const auto start = std::chrono::steady_clock::now();
  const double built_before = device.programs.build_seconds();
  stats = {};
  stats.device = device.device.name();
  device.timer.clear();
  device.buffers.reset_peak();
  particles.begin_frame();

  const FrameLayout layout = make_layout(frame, plan, rows);
  const compute::buffer grids = device.buffers.upload("grids", layout.grids);
  Projector projector(device, frame, layout, grids);
  Binner binner(device, layout, frame, plan, grids);
  Compositor compositor(device, layout, frame, plan, grids, rows);
  Resolver resolver(device, layout, frame, plan, grids);

  compositor.clear();
  if (plan.needs_sort) {
    draw_ordered(frame, projector, binner, compositor);
  } else {
    draw_sums(frame, projector, binner, compositor);
  }
  Image image = resolver.resolve(compositor.planes(), compositor.used_grids());
  device.queue.finish();
  particles.end_frame();

  stats.drawn_particles = projector.visible_particles();
  stats.bad_particles = projector.bad_particles();
  stats.device_bytes = device.buffers.peak_bytes() + particles.device_bytes();
  stats.stages = device.timer.times();
  stats.build_seconds = device.programs.build_seconds() - built_before;
  device.timer.clear();
  stats.total_seconds =
      std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
  return image;
}

// Order does not matter: particles pass through in chunks, and the working memory is a
// chunk's, however many there are.
void Renderer::State::draw_sums(const Frame& frame, Projector& projector, Binner& binner,
                                Compositor& compositor) {
  const std::uint32_t chunk = device.traits.chunk_blocks * device.traits.project_block;
  for (std::size_t c = 0; c < frame.components.size(); ++c) {
    const DrawnComponent& component = frame.components[c];
    const auto count = static_cast<std::uint32_t>(component.particles.count);
    stats.particles += count;
    const ParticleBuffers buffers = particles.get(component.particles);
    for (std::uint32_t first = 0; first < count; first += std::min(chunk, count - first)) {
      const SplatBlocks blocks =
          projector.project_chunk(component, static_cast<std::uint32_t>(c), buffers, first,
                                  first + std::min(chunk, count - first));
      draw_blocks(blocks, binner, compositor);
      projector.collect_counts(blocks);
    }
  }
}

void Renderer::State::draw_blocks(const SplatBlocks& blocks, Binner& binner,
                                  Compositor& compositor) {
  std::uint32_t length = blocks.stride;
  for (std::uint32_t first = 0; first < blocks.stride;) {
    TileLists lists;
    length = std::min(length, blocks.stride - first);
    if (!binner.bin_blocks(blocks, first, length, lists)) {
      if (length == 1) {
        throw DeviceError("one splat of each block needs " + std::to_string(lists.entry_count) +
                          " tile entries, more than fit: draw fewer pixels (--crop)");
      }
      length /= 2;
      continue;
    }
    stats.tile_entries += lists.entry_count;
    compositor.composite(lists);
    first += length;
  }
}

// Splats of the whole frame are sorted, then composited nearest first, chunk by chunk.
void Renderer::State::draw_ordered(const Frame& frame, Projector& projector, Binner& binner,
                                   Compositor& compositor) {
  std::vector<ParticleBuffers> buffers;
  for (const DrawnComponent& component : frame.components) {
    stats.particles += component.particles.count;
    buffers.push_back(particles.get(component.particles));
  }
  // The last frame's lists make room for the sort.
  device.buffers.release("tile entries");
  const std::uint32_t count = projector.project_all(frame.components, buffers);
  if (count == 0) return;
  Sorter sorter(device);
  const Sorter::Pairs sorted =
      sorter.sort({device.buffers.get("keys", 0), device.buffers.get("order", 0)}, count);
  // What the sort alone needed makes room for the lists.
  sorter.release_buffers();

  std::uint32_t length = device.traits.chunk_blocks * device.traits.project_block;
  for (std::uint32_t first = 0; first < count;) {
    TileLists lists;
    length = std::min(length, count - first);
    if (!binner.bin_order(sorted.values, first, length, lists)) {
      length /= 2;  // one splat always fits: it meets every tile at most once
      continue;
    }
    stats.tile_entries += lists.entry_count;
    compositor.composite(lists);
    first += length;
  }
}

Renderer::Renderer(const RendererOptions& options) {
  try {
    state_ = std::make_unique<State>(options);
  } catch (const compute::opencl_error& error) {
    throw DeviceError("cannot open the OpenCL device: " + error.error_string());
  }
}
Renderer::~Renderer() = default;
Renderer::Renderer(Renderer&&) noexcept = default;
Renderer& Renderer::operator=(Renderer&&) noexcept = default;

Image Renderer::render(const Frame& frame) {
  try {
    return state_->render(frame);
  } catch (const compute::opencl_error& error) {
    throw DeviceError("device " + state_->device.device.name() +
                      " failed: " + error.error_string());
  }
}

const RenderStats& Renderer::stats() const {
  return state_->stats;
}

}  // namespace splotchcl
