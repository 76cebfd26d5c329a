#include "splotchcl/renderer.h"

#include <algorithm>
#include <atomic>
#include <chrono>
#include <cstdint>
#include <mutex>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "certificate/certificate.h"
#include "device/drawings.h"
#include "device/frame_checks.h"
#include "device/opencl/device_context.h"
#include "device/opencl/runtime_lock.h"
#include "device/pipeline.h"
#include "device/ranks/rank_share.h"
#include "parallel/for_blocks.h"
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

struct DrawnSplats {
  ReadSplats read;
  DrawCounts counts;
};

void add_times(const std::vector<StageTime>& times, std::vector<StageTime>& sums) {
  for (const StageTime& time : times) {
    const auto sum = std::find_if(sums.begin(), sums.end(),
                                  [&](const StageTime& s) { return s.stage == time.stage; });
    if (sum == sums.end()) {
      sums.push_back(time);
    } else {
      sum->seconds += time.seconds;
    }
  }
}

// Ranks of one host take its devices in turn.
int device_of_rank(const Communicator* ranks) {
  return ranks == nullptr ? 0 : ranks->rank_on_host();
}

}  // namespace

struct Renderer::State {
  class Rendering;

  explicit State(const RendererOptions& options)
      : device(choose_device(options.device, device_of_rank(options.ranks.get()))),
        particles(device, options.columns_stay) {
    // The shape decides for all stages: a processor that is asked for groups runs the kernels and
    // the sizes of a GPU.
    if (options.shape != CompositeShape::automatic) {
      device.traits.choose_shape(options.shape == CompositeShape::rows);
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
  // By this plan, or null: by the one that it chooses.
  Image render(const Frame& frame, const FramePlan* plan, RenderStats& of_frame);
  // What kernels still read belongs to the caller, who is told of what failed before.
  void finish_quietly();

  // Of the device, its memory and its particles: one frame at a time has them.
  std::mutex of_device;
  DeviceContext device;
  ParticleStore particles;
  RenderStats stats;  // for who asks for none of its own
  PlanOptions plan_options;
  bool draws_slabs = true;
  std::function<void(double)> progress;
  std::shared_ptr<Communicator> ranks;  // null: one process
  ThreadPool threads;                   // of the host's part of frames
  // The frame that ended last, whose particles are to be forgotten when the device is free.
  std::atomic<std::uint64_t> ended{0};
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
                   traits.shape_name() + (traits.double_numbers ? "" : ", no doubles"),
               "choose the same everywhere with --device");
}

void Renderer::State::finish_quietly() {
  try {
    device.queue.finish();
  } catch (const compute::opencl_error&) {
  }
  device.timer.clear();
}

// One frame on its way. While the device draws it, others may be planned or checked.
class Renderer::State::Rendering {
 public:
  Rendering(State& state, const Frame& frame, RenderStats& stats)
      : state_(state), frame_(frame), stats_(stats) {
    stats_ = {};
  }

  FramePlan first_plan() {
    const auto start = std::chrono::steady_clock::now();
    FramePlan plan;
    const auto make = [&] { plan = Renderer::first_plan(frame_, state_.plan_options); };
    if (frame_.spread) {
      frame_.spread->agree_on([&] {
        check_ranks(frame_, state_.ranks.get());
        make();
      });
    } else {
      make();
    }
    note_span("plan", start);
    return plan;
  }

  Image render(const FramePlan& plan) {
    check_frame(frame_);
    check_ranks(frame_, state_.ranks.get());
    const auto start = std::chrono::steady_clock::now();
    const double host_start = thread_seconds();
    stats_.device = state_.device.device.name();

    const FetchedParticles fetched(frame_, plan, state_.device.traits);
    const bool in_order = plan.slabs > 0 && !state_.draws_slabs;
    const FramePlan first = in_order ? in_order_plan(frame_, plan) : plan;
    DrawnPicture picture = draw_until_kept(frame_, try_out(first));
    stats_.check.is_bound = plan.certify && picture.certificate.is_bound;
    Image image = std::move(picture.image);
    share(image);
    end();
    stats_.total_seconds =
        std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
    note_processes();
    const double host_seconds =
        thread_seconds() - host_start - stats_.build_seconds - check_seconds_;
    stats_.serial.push_back({"check", check_seconds_});
    stats_.serial.push_back({"host", std::max(0.0, host_seconds)});
    return image;
  }

 private:
  bool is_first() const { return !state_.ranks || state_.ranks->rank() == 0; }

  // A plan with what its parts that are to be tried turn out to need.
  // Others may need more than these parts, of which more is asked for that.
  FramePlan try_out(const FramePlan& plan) {
    constexpr double part_of_promise = 0.25;
    constexpr int edge_blocks = 1;
    FramePlan tried = plan;
    for (const Rectangle& crop : plan.tried_parts) {
      Frame part = frame_;
      part.crop = crop;
      DrawnSplats splats;
      const Image image = draw(part, tried, splats);
      if (splats.counts.too_sharp > 0) break;
      FramePlan stricter = tried;
      stricter.shares.promise *= part_of_promise;
      Certificate certificate;
      if (is_first())
        certificate = certify(splats.read.gathered(), image, part, stricter, edge_blocks);
      share(certificate);
      if (!certificate.keeps_promise())
        tried = refine_plan(frame_, tried, with_all_octaves(certificate.needs));
    }
    tried.tried_parts.clear();
    return tried;
  }

  Certificate check(const Frame& frame, const FramePlan& plan, const DrawnSplats& splats,
                    const Image& image) {
    const auto start = std::chrono::steady_clock::now();
    const double before = thread_seconds();
    Certificate certificate;
    if (is_first()) {
      const CollectedSplats collected = splats.read.gathered();
      certificate = plan.is_extended() ? certify_extended(collected, image, frame, plan)
                                       : certify(collected, image, frame, plan);
    }
    share(certificate);
    check_seconds_ += thread_seconds() - before;
    note_span("check", start);
    note_check(certificate, stats_.check);
    return certificate;
  }

  // Draws until the promise is kept.
  DrawnPicture draw_until_kept(const Frame& frame, const FramePlan& plan) {
    FramePlan drawn = plan;
    for (std::size_t drawings = 1;; ++drawings) {
      DrawnSplats splats;
      DrawnPicture picture;
      picture.image = draw(frame, drawn, splats);
      note(splats.counts);
      if (splats.counts.too_sharp > 0) {
        stats_.drawn_most_exactly = true;
        drawn = extend_plan(frame, drawn);
        continue;
      }
      picture.certificate = check(frame, drawn, splats, picture.image);
      if (drawn.is_extended() || picture.certificate.keeps_promise()) return picture;
      const bool in_slabs = drawn.slabs > 0;
      const FramePlan of_parts = in_slabs ? in_order_plan(frame, drawn)
                                          : next_plan(frame, drawn, picture.certificate, drawings);
      const double pixels = pixels_of_part(frame, drawn, splats.counts);
      if (mend(frame, drawn, of_parts, pixels, picture)) {
        note(splats.counts);
        note_check(picture.certificate, stats_.check);
        return picture;
      }
      drawn = in_slabs ? next_plan(frame, drawn, picture.certificate, drawings) : of_parts;
    }
  }

  // Draws those parts of a picture of `plan` again that do not keep the promise, by the plan
  // `of_parts`, where that takes less than all of it.
  bool mend(const Frame& frame, const FramePlan& plan, const FramePlan& of_parts,
            double pixels_of_part, DrawnPicture& picture) {
    // Drawing all of the picture again takes no longer than that: what fails is more crowded than
    // the rest, which counts more where pixels of their own cost little.
    const double largest_pixel_count = plan.needs_sort() ? 0.7 : 0.5;
    const Image& image = picture.image;
    Certificate& certificate = picture.certificate;
    const std::vector<Rectangle> parts = failing_parts(certificate.blocks, plan.shares.promise,
                                                       image.width, image.height, pixels_of_part);
    double pixels = pixels_of_part * static_cast<double>(parts.size());
    for (const Rectangle& part : parts)
      pixels += static_cast<double>(part.width) * part.height;
    if (parts.empty() || pixels > largest_pixel_count * image.width * image.height) return false;
    FrameCheck check = std::move(stats_.check);
    std::vector<ErrorParts> worst = {certificate.worst_kept};
    for (const Rectangle& part : parts) {
      Frame frame_of_part = frame;
      frame_of_part.crop = {frame.crop.x + part.x, frame.crop.y + part.y, part.width, part.height};
      stats_.check = {};
      paste(draw_until_kept(frame_of_part, of_parts), part, picture);
      worst.push_back(stats_.check.worst);
    }
    stats_.check = std::move(check);
    const std::vector<float>& errors = certificate.blocks.errors;
    certificate.error_of_promise =
        static_cast<double>(*std::max_element(errors.begin(), errors.end())) / plan.shares.promise;
    certificate.worst = worst_within(worst, certificate.error_of_promise);
    return true;
  }

  Image draw(const Frame& frame, const FramePlan& plan, DrawnSplats& splats) {
    const auto asked = std::chrono::steady_clock::now();
    const std::lock_guard turn(state_.of_device);
    const auto start = std::chrono::steady_clock::now();
    constexpr std::chrono::microseconds worth_telling(50);
    if (start - asked > worth_telling) note_span("wait", asked);
    try {
      state_.particles.end_frame(state_.ended);
      if (number_ == 0) number_ = state_.particles.begin_frame();
      Image image = draw_on_device(frame, plan, splats);
      note_span("draw", start);
      return image;
    } catch (...) {
      state_.finish_quietly();
      throw;
    }
  }

  Image draw_on_device(const Frame& frame, const FramePlan& plan, DrawnSplats& splats) {
    DeviceContext& device = state_.device;
    if (plan.is_extended()) require_doubles(device);
    const double built_before = device.programs.build_seconds();
    device.pool.reset_peak();
    std::optional<FrameRanks> of_frame;
    if (state_.ranks) of_frame.emplace(FrameRanks{*state_.ranks, work_});
    Pipeline pipeline(device, state_.particles, frame, plan, state_.progress,
                      of_frame ? &*of_frame : nullptr);
    Image image = pipeline.draw();
    splats.counts = pipeline.counts();
    if (of_frame) work_ = of_frame->work;
    device.queue.finish();
    const double before = thread_seconds();
    if (splats.counts.too_sharp == 0 && is_first()) splats.read = pipeline.read_collected();
    check_seconds_ += thread_seconds() - before;
    take_account(built_before);
    return image;
  }

  // Of what the device has done for the frame since the last time.
  void take_account(double built_before) {
    DeviceContext& device = state_.device;
    add_times(device.timer.times(), stats_.stages);
    add_times(device.timer.serial_times(), stats_.serial);
    const std::vector<TimeSpan> spans = device.timer.spans();
    stats_.spans.insert(stats_.spans.end(), spans.begin(), spans.end());
    device.timer.clear();
    stats_.device_bytes =
        std::max(stats_.device_bytes, device.pool.peak_bytes() + state_.particles.device_bytes());
    stats_.note = device.programs.note();
    stats_.build_seconds += device.programs.build_seconds() - built_before;
  }

  // Without waiting for the frame that the device may be drawing.
  void end() {
    state_.ended = number_;
    const std::unique_lock turn(state_.of_device, std::try_to_lock);
    if (turn) state_.particles.end_frame(number_);
  }

  void note_span(const char* what, std::chrono::steady_clock::time_point begin) {
    stats_.spans.push_back({what, false, begin, std::chrono::steady_clock::now()});
  }

  void note(const DrawCounts& counts) {
    stats_.particles = counts.particles;
    stats_.drawn_particles = counts.visible;
    stats_.bad_particles = counts.bad;
    stats_.tile_entries = counts.tile_entries;
    stats_.blocks_left_out = counts.blocks_left_out;
    stats_.windows = counts.windows;
  }

  void note_processes() {
    if (!state_.ranks) return;
    const std::vector<std::string> hosts = gather_texts(*state_.ranks, state_.ranks->host());
    const std::vector<std::uint64_t> projected = gather_values(*state_.ranks, work_.particles);
    const std::vector<std::uint64_t> composited = gather_values(*state_.ranks, work_.splats);
    const std::vector<std::uint64_t> sent = gather_values(*state_.ranks, work_.sent_bytes);
    const auto microseconds = static_cast<std::uint64_t>(1e6 * stats_.total_seconds);
    const std::vector<std::uint64_t> times = gather_values(*state_.ranks, microseconds);
    for (std::size_t r = 0; r < hosts.size(); ++r) {
      stats_.processes.push_back(
          {hosts[r], projected[r], composited[r], sent[r], 1e-6 * static_cast<double>(times[r])});
    }
  }

  // What the first of several ranks knows becomes known to all.
  void share(Certificate& certificate) const {
    if (!state_.ranks) return;
    broadcast_value(*state_.ranks, certificate.error_of_promise);
    broadcast_value(*state_.ranks, certificate.worst);
    broadcast_value(*state_.ranks, certificate.worst_kept);
    broadcast_value(*state_.ranks, certificate.needs);
    broadcast_value(*state_.ranks, certificate.needs_extended);
    broadcast_value(*state_.ranks, certificate.is_bound);
    broadcast_value(*state_.ranks, certificate.blocks.columns);
    broadcast_value(*state_.ranks, certificate.blocks.rows);
    broadcast_values(*state_.ranks, certificate.blocks.errors);
  }

  // All go on from the same picture: to its exposure, or to what is drawn next.
  void share(Image& image) const {
    if (state_.ranks) broadcast_values(*state_.ranks, image.pixels);
  }

  State& state_;
  const Frame& frame_;
  RenderStats& stats_;
  std::uint64_t number_ = 0;  // as particles are kept by; 0: nothing has been drawn
  double check_seconds_ = 0;  // of the frame, by the thread that draws
  RankWork work_;             // this one's, for the frame
};

Image Renderer::State::render(const Frame& frame, const FramePlan* plan, RenderStats& of_frame) {
  require_runtime();
  const ThreadPool::Scope scope(threads);
  Rendering rendering(*this, frame, of_frame);
  const FramePlan drawn = plan != nullptr ? *plan : rendering.first_plan();
  try {
    return rendering.render(drawn);
  } catch (const compute::opencl_error& error) {
    throw DeviceError("device " + device.device.name() + " failed: " + error.error_string() +
                      "; draw fewer particles or a smaller picture, or choose another device");
  }
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
  return state_->render(frame, nullptr, state_->stats);
}

Image Renderer::render(const Frame& frame, const FramePlan& plan) {
  return state_->render(frame, &plan, state_->stats);
}

Image Renderer::render(const Frame& frame, RenderStats& stats) {
  return state_->render(frame, nullptr, stats);
}

Image Renderer::render(const Frame& frame, const FramePlan& plan, RenderStats& stats) {
  return state_->render(frame, &plan, stats);
}

const RenderStats& Renderer::stats() const {
  return state_->stats;
}

}  // namespace splotchcl
