#include "splotchcl/renderer.h"

#include <algorithm>
#include <chrono>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "certificate/certificate.h"
#include "device/drawn_picture.h"
#include "device/failing_parts.h"
#include "device/frame_checks.h"
#include "device/next_drawing.h"
#include "device/opencl/device_context.h"
#include "device/opencl/runtime_lock.h"
#include "device/pipeline.h"
#include "device/ranks/rank_share.h"
#include "parallel/thread_pool.h"
#include "ranks/exchange.h"
#include "ranks/spread_particles.h"
#include "splotchcl/error.h"

namespace splotchcl {
namespace {

void note_check(const Certificate& certificate, FrameCheck& check) {
  check.errors_of_promise.push_back(certificate.error_of_promise);
  check.worst = certificate.worst;
  check.blocks = certificate.blocks;
}

// What is known of splats once they are drawn.
struct DrawnSplats {
  CollectedSplats collected;
  DrawCounts counts;
};

// Ranks of one host take its devices in turn.
int device_of_rank(const Communicator* ranks) {
  return ranks == nullptr ? 0 : ranks->rank_on_host();
}

}  // namespace

struct Renderer::State {
  explicit State(const RendererOptions& options)
      : device(choose_device(options.device, device_of_rank(options.ranks.get()))),
        particles(device, options.columns_stay) {
    // The shape decides for all stages: a processor that is asked for groups runs the kernels and
    // the sizes of a GPU.
    if (options.shape != CompositeShape::automatic) {
      choose_shape(device.traits, options.shape == CompositeShape::rows);
    }
    device.traits.double_numbers &= options.use_double;
    if (options.memory_bytes > 0) device.limit_memory(options.memory_bytes);
    plan_options.certify = options.certify;
    plan_options.slabs = options.slabs;
    draws_slabs = device.traits.draws_slabs || options.slabs >= 0;
    progress = options.progress;
    device.programs.use_compilers(options.start_compiler);
  }

  void join_ranks(const RendererOptions& options);

  Image render(const Frame& frame, const FramePlan& plan);
  // A plan with what its parts that are to be tried turn out to need.
  FramePlan try_out(const Frame& frame, const FramePlan& plan);
  bool is_first() const { return !ranks || ranks->rank() == 0; }
  // Draws until the promise is kept.
  DrawnPicture draw_until_kept(const Frame& frame, const FramePlan& plan);
  // Draws those parts of a picture of `plan` again that do not keep the promise, by the plan
  // `of_parts`, where that takes less than all of it.
  bool mend(const Frame& frame, const FramePlan& plan, const FramePlan& of_parts,
            double pixels_of_part, DrawnPicture& picture);
  // Draws, and what was drawn.
  Image draw(const Frame& frame, const FramePlan& plan, DrawnSplats& splats);
  // What kernels still read belongs to the caller, who is told of what failed before.
  void finish_quietly();
  void note(const DrawCounts& counts);
  void note_processes();
  // What the first of several ranks knows becomes known to all.
  void share(Certificate& certificate) const;
  void share(Image& image) const;

  DeviceContext device;
  ParticleStore particles;
  RenderStats stats;
  double check_seconds = 0;  // of the frame, by the thread that draws
  PlanOptions plan_options;
  bool draws_slabs = true;
  std::function<void(double)> progress;
  std::shared_ptr<Communicator> ranks;  // null: one process
  RankWork work;                        // this one's, for the frame
  ThreadPool threads;                   // of the host's part of frames
};

// Ranks of one host share its memory.
void Renderer::State::join_ranks(const RendererOptions& options) {
  if (!options.ranks || options.ranks->size() < 2) return;
  ranks = options.ranks;
  if (options.memory_bytes == 0 && device.traits.shares_host_memory)
    device.limit_memory(device.memory.total / static_cast<std::uint64_t>(ranks->size_on_host()));
  const DeviceTraits& traits = device.traits;
  require_same(*ranks, "device",
               device.device.name() + ", driver " + device.device.driver_version() + ", " +
                   shape_name(traits) + (traits.double_numbers ? "" : ", no doubles"),
               "choose the same everywhere with --device");
}

Image Renderer::State::render(const Frame& frame, const FramePlan& plan) {
  check_frame(frame);
  check_ranks(frame, ranks.get());
  const auto start = std::chrono::steady_clock::now();
  const double host_start = thread_seconds();
  const double built_before = device.programs.build_seconds();
  stats = {};
  check_seconds = 0;
  stats.device = device.device.name();
  stats.note = device.programs.note();
  device.timer.clear();
  device.pool.reset_peak();
  particles.begin_frame();

  work = {};
  const FetchedParticles fetched(frame, plan, device.traits);
  const bool in_order = plan.slabs > 0 && !draws_slabs;
  const FramePlan first = in_order ? in_order_plan(frame, plan) : plan;
  DrawnPicture picture = draw_until_kept(frame, try_out(frame, first));
  stats.check.is_bound = plan.certify && picture.certificate.is_bound;
  Image image = std::move(picture.image);
  share(image);
  particles.end_frame();
  stats.device_bytes = device.pool.peak_bytes() + particles.device_bytes();
  stats.stages = device.timer.times();
  stats.build_seconds = device.programs.build_seconds() - built_before;
  stats.total_seconds =
      std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
  note_processes();
  const double host_seconds = thread_seconds() - host_start - stats.build_seconds - check_seconds;
  stats.serial = device.timer.serial_times();
  stats.serial.push_back({"check", check_seconds});
  stats.serial.push_back({"host", std::max(0.0, host_seconds)});
  device.timer.clear();
  return image;
}

// Others may need more than these parts, of which more is asked for that.
FramePlan Renderer::State::try_out(const Frame& frame, const FramePlan& plan) {
  constexpr double part_of_promise = 0.25;
  constexpr int edge_blocks = 1;
  FramePlan tried = plan;
  for (const Rectangle& crop : plan.tried_parts) {
    Frame part = frame;
    part.crop = crop;
    DrawnSplats splats;
    const Image image = draw(part, tried, splats);
    if (splats.counts.too_sharp > 0) break;
    FramePlan stricter = tried;
    stricter.shares.promise *= part_of_promise;
    Certificate certificate;
    if (is_first()) certificate = certify(splats.collected, image, part, stricter, edge_blocks);
    share(certificate);
    if (!certificate.keeps_promise())
      tried = refine_plan(frame, tried, with_all_octaves(certificate.needs));
  }
  tried.tried_parts.clear();
  return tried;
}

DrawnPicture Renderer::State::draw_until_kept(const Frame& frame, const FramePlan& plan) {
  FramePlan drawn = plan;
  for (std::size_t drawings = 1;; ++drawings) {
    DrawnSplats splats;
    DrawnPicture picture;
    picture.image = draw(frame, drawn, splats);
    note(splats.counts);
    if (splats.counts.too_sharp > 0) {
      stats.drawn_most_exactly = true;
      drawn = extend_plan(frame, drawn);
      continue;
    }
    const double before = thread_seconds();
    if (is_first()) {
      picture.certificate = drawn.is_extended()
                                ? certify_extended(splats.collected, picture.image, frame, drawn)
                                : certify(splats.collected, picture.image, frame, drawn);
    }
    share(picture.certificate);
    check_seconds += thread_seconds() - before;
    note_check(picture.certificate, stats.check);
    if (drawn.is_extended() || picture.certificate.keeps_promise()) return picture;
    const bool in_slabs = drawn.slabs > 0;
    const FramePlan of_parts = in_slabs ? in_order_plan(frame, drawn)
                                        : next_plan(frame, drawn, picture.certificate, drawings);
    const double pixels = pixels_of_part(frame, drawn, splats.counts);
    if (mend(frame, drawn, of_parts, pixels, picture)) {
      note(splats.counts);
      note_check(picture.certificate, stats.check);
      return picture;
    }
    drawn = in_slabs ? next_plan(frame, drawn, picture.certificate, drawings) : of_parts;
  }
}

bool Renderer::State::mend(const Frame& frame, const FramePlan& plan, const FramePlan& of_parts,
                           double pixels_of_part, DrawnPicture& picture) {
  // Drawing all of the picture again takes no longer than that: what fails is more crowded than the
  // rest, which counts more where pixels of their own cost little.
  const double largest_pixel_count = plan.needs_sort() ? 0.7 : 0.5;
  const Image& image = picture.image;
  Certificate& certificate = picture.certificate;
  const std::vector<Rectangle> parts = failing_parts(certificate.blocks, plan.shares.promise,
                                                     image.width, image.height, pixels_of_part);
  double pixels = pixels_of_part * static_cast<double>(parts.size());
  for (const Rectangle& part : parts)
    pixels += static_cast<double>(part.width) * part.height;
  if (parts.empty() || pixels > largest_pixel_count * image.width * image.height) return false;
  FrameCheck check = std::move(stats.check);
  std::vector<ErrorParts> worst = {certificate.worst_kept};
  for (const Rectangle& part : parts) {
    Frame frame_of_part = frame;
    frame_of_part.crop = {frame.crop.x + part.x, frame.crop.y + part.y, part.width, part.height};
    stats.check = {};
    paste(draw_until_kept(frame_of_part, of_parts), part, picture);
    worst.push_back(stats.check.worst);
  }
  stats.check = std::move(check);
  const std::vector<float>& errors = certificate.blocks.errors;
  certificate.error_of_promise =
      static_cast<double>(*std::max_element(errors.begin(), errors.end())) / plan.shares.promise;
  certificate.worst = worst_within(worst, certificate.error_of_promise);
  return true;
}

Image Renderer::State::draw(const Frame& frame, const FramePlan& plan, DrawnSplats& splats) {
  if (plan.is_extended()) require_doubles(device);
  std::optional<FrameRanks> of_frame;
  if (ranks) of_frame.emplace(FrameRanks{*ranks, work});
  Pipeline pipeline(device, particles, frame, plan, progress, of_frame ? &*of_frame : nullptr);
  Image image = pipeline.draw();
  splats.counts = pipeline.counts();
  if (of_frame) work = of_frame->work;
  device.queue.finish();
  const double before = thread_seconds();
  if (splats.counts.too_sharp == 0 && is_first()) splats.collected = pipeline.collected();
  check_seconds += thread_seconds() - before;
  return image;
}

void Renderer::State::finish_quietly() {
  try {
    device.queue.finish();
  } catch (const compute::opencl_error&) {
  }
}

void Renderer::State::note(const DrawCounts& counts) {
  stats.particles = counts.particles;
  stats.drawn_particles = counts.visible;
  stats.bad_particles = counts.bad;
  stats.tile_entries = counts.tile_entries;
  stats.blocks_left_out = counts.blocks_left_out;
  stats.windows = counts.windows;
}

void Renderer::State::note_processes() {
  if (!ranks) return;
  const std::vector<std::string> hosts = gather_texts(*ranks, ranks->host());
  const std::vector<std::uint64_t> projected = gather_values(*ranks, work.particles);
  const std::vector<std::uint64_t> composited = gather_values(*ranks, work.splats);
  const std::vector<std::uint64_t> sent = gather_values(*ranks, work.sent_bytes);
  const auto microseconds = static_cast<std::uint64_t>(1e6 * stats.total_seconds);
  const std::vector<std::uint64_t> times = gather_values(*ranks, microseconds);
  for (std::size_t r = 0; r < hosts.size(); ++r) {
    stats.processes.push_back(
        {hosts[r], projected[r], composited[r], sent[r], 1e-6 * static_cast<double>(times[r])});
  }
}

void Renderer::State::share(Certificate& certificate) const {
  if (!ranks) return;
  broadcast_value(*ranks, certificate.error_of_promise);
  broadcast_value(*ranks, certificate.worst);
  broadcast_value(*ranks, certificate.worst_kept);
  broadcast_value(*ranks, certificate.needs);
  broadcast_value(*ranks, certificate.needs_extended);
  broadcast_value(*ranks, certificate.is_bound);
  broadcast_value(*ranks, certificate.blocks.columns);
  broadcast_value(*ranks, certificate.blocks.rows);
  broadcast_values(*ranks, certificate.blocks.errors);
}

// All go on from the same picture: to its exposure, or to what is drawn next.
void Renderer::State::share(Image& image) const {
  if (ranks) broadcast_values(*ranks, image.pixels);
}

Renderer::Renderer(const RendererOptions& options) {
  agree(options.ranks.get(), [&] {
    try {
      const auto lock = lock_runtime();
      state_ = std::make_unique<State>(options);
    } catch (const compute::opencl_error& error) {
      throw DeviceError("cannot open the OpenCL device: " + error.error_string() +
                        "; see that its driver works, or choose another device");
    }
  });
  // Others may wait for the runtime, and this one for them.
  state_->join_ranks(options);
}
// To free what OpenCL has would wait without end in a forked process, whose memory goes anyway.
Renderer::~Renderer() {
  if (is_forked_from_runtime()) static_cast<void>(state_.release());
}
Renderer::Renderer(Renderer&&) noexcept = default;
Renderer& Renderer::operator=(Renderer&& other) noexcept {
  std::swap(state_, other.state_);
  return *this;
}

Image Renderer::render(const Frame& frame) {
  require_runtime();
  const ThreadPool::Scope scope(state_->threads);
  if (!frame.spread) return render(frame, first_plan(frame, state_->plan_options));
  FramePlan plan;
  frame.spread->agree_on([&] {
    check_ranks(frame, state_->ranks.get());
    plan = first_plan(frame, state_->plan_options);
  });
  return render(frame, plan);
}

Image Renderer::render(const Frame& frame, const FramePlan& plan) {
  require_runtime();
  const ThreadPool::Scope scope(state_->threads);
  try {
    return state_->render(frame, plan);
  } catch (const compute::opencl_error& error) {
    state_->finish_quietly();
    throw DeviceError("device " + state_->device.device.name() +
                      " failed: " + error.error_string() +
                      "; draw fewer particles or a smaller picture, or choose another device");
  } catch (...) {
    state_->finish_quietly();
    throw;
  }
}

const RenderStats& Renderer::stats() const {
  return state_->stats;
}

}  // namespace splotchcl
