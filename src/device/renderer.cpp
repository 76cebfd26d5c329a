#include "splotchcl/renderer.h"

#include <algorithm>
#include <chrono>
#include <limits>
#include <string>

#include "certificate/certificate.h"
#include "certificate/picture_light.h"
#include "device/opencl/device_context.h"
#include "device/opencl/runtime_lock.h"
#include "device/pipeline.h"
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
  const std::uint64_t total = particle_count(frame);
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

void note_check(const Certificate& certificate, FrameCheck& check) {
  check.errors_of_promise.push_back(certificate.error_of_promise);
  check.worst = certificate.worst;
  check.blocks = certificate.blocks;
}

// What is known of splats once they are drawn.
struct DrawnSplats {
  CollectedSplats collected;
  bool are_too_sharp = false;  // some, for the plan's precision
};

// The plan of the next drawing of a frame that did not keep its promise in `drawings` of them.
FramePlan next_plan(const Frame& frame, const FramePlan& plan, const Certificate& certificate,
                    std::size_t drawings) {
  // What converges does so in a step or two.
  constexpr std::size_t most_drawings = 4;
  if (drawings >= most_drawings) return extend_plan(frame, plan);
  if (!plan.certify) return refine_plan(frame, plan, certificate.needs);
  // Bounds fall more slowly than what is shared out: by no less than 4 at a time.
  return tighten_plan(frame, plan, std::clamp(2 * certificate.error_of_promise, 4.0, 1000.0));
}

}  // namespace

struct Renderer::State {
  explicit State(const RendererOptions& options)
      : device(choose_device(options.device)), particles(device) {
    // The shape decides for all stages: a processor that is asked for groups runs the kernels and
    // the sizes of a GPU.
    if (options.shape != CompositeShape::automatic) {
      choose_shape(device.traits, options.shape == CompositeShape::rows);
    }
    device.traits.double_numbers &= options.use_double;
    certifies = options.certify;
    progress = options.progress;
  }

  Image render(const Frame& frame, const FramePlan& plan);
  // Draws, and what was drawn.
  Image draw(const Frame& frame, const FramePlan& plan, DrawnSplats& splats);

  DeviceContext device;
  ParticleStore particles;
  RenderStats stats;
  bool certifies = false;
  std::function<void(double)> progress;
};

Image Renderer::State::render(const Frame& frame, const FramePlan& plan) {
  check_frame(frame);
  const auto start = std::chrono::steady_clock::now();
  const double built_before = device.programs.build_seconds();
  stats = {};
  stats.device = device.device.name();
  stats.note = device.programs.note();
  device.timer.clear();
  device.pool.reset_peak();
  particles.begin_frame();

  stats.check.is_bound = plan.certify;
  FramePlan drawn = plan;
  Image image;
  while (true) {
    DrawnSplats splats;
    image = draw(frame, drawn, splats);
    if (splats.are_too_sharp) {
      stats.drawn_most_exactly = true;
      drawn = extend_plan(frame, drawn);
      continue;
    }
    const Certificate certificate = drawn.is_extended()
                                        ? certify_extended(image, frame)
                                        : certify(splats.collected, image, frame, drawn);
    note_check(certificate, stats.check);
    if (drawn.is_extended() || certificate.keeps_promise()) break;
    drawn = next_plan(frame, drawn, certificate, stats.check.errors_of_promise.size());
  }
  particles.end_frame();
  stats.device_bytes = device.pool.peak_bytes() + particles.device_bytes();
  stats.stages = device.timer.times();
  stats.build_seconds = device.programs.build_seconds() - built_before;
  device.timer.clear();
  stats.total_seconds =
      std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
  return image;
}

Image Renderer::State::draw(const Frame& frame, const FramePlan& plan, DrawnSplats& splats) {
  Pipeline pipeline(device, particles, frame, plan, progress);
  Image image = pipeline.draw();
  splats.are_too_sharp = pipeline.counts().too_sharp > 0;
  if (!splats.are_too_sharp) splats.collected = pipeline.collected();
  device.queue.finish();
  stats.particles = pipeline.counts().particles;
  stats.drawn_particles = pipeline.counts().visible;
  stats.bad_particles = pipeline.counts().bad;
  stats.tile_entries = pipeline.counts().tile_entries;
  return image;
}

Renderer::Renderer(const RendererOptions& options) {
  const auto lock = lock_runtime();
  try {
    state_ = std::make_unique<State>(options);
  } catch (const compute::opencl_error& error) {
    throw DeviceError("cannot open the OpenCL device: " + error.error_string() +
                      "; see that its driver works, or choose another device");
  }
}
Renderer::~Renderer() = default;
Renderer::Renderer(Renderer&&) noexcept = default;
Renderer& Renderer::operator=(Renderer&&) noexcept = default;

Image Renderer::render(const Frame& frame) {
  check_frame(frame);
  PlanOptions options;
  options.certify = state_->certifies;
  return render(frame, make_plan(frame, options));
}

Image Renderer::render(const Frame& frame, const FramePlan& plan) {
  try {
    return state_->render(frame, plan);
  } catch (const compute::opencl_error& error) {
    throw DeviceError("device " + state_->device.device.name() +
                      " failed: " + error.error_string() +
                      "; draw fewer particles or a smaller picture, or choose another device");
  } catch (...) {
    // What kernels still read belongs to the caller.
    state_->device.queue.finish();
    throw;
  }
}

const RenderStats& Renderer::stats() const {
  return state_->stats;
}

}  // namespace splotchcl
