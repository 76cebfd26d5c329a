#pragma once

#include <chrono>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <memory>
#include <string>
#include <vector>

#include "splotchcl/communicator.h"
#include "splotchcl/frame.h"
#include "splotchcl/frame_check.h"
#include "splotchcl/image.h"
#include "splotchcl/plan.h"
#include "splotchcl/program_compiler.h"

namespace splotchcl {

struct DeviceInfo {
  std::string name, platform, driver;
  bool is_gpu = false;
  int compute_units = 0;
  std::uint64_t memory_bytes = 0;
  bool is_default = false;  // what a Renderer without a name would use
};

// Never throws for want of a device: the list is empty then.
std::vector<DeviceInfo> list_devices();

// The library that finds devices, as far as it says: name, version, file.
std::string opencl_loader();

// What to tell a user whose machine has no OpenCL device.
std::string no_device_advice();

// The kernels that draw, and the sizes of their blocks, tiles and chunks: those for processors or
// those for GPUs. Both run on either; pictures of the two differ by roundings.
enum class CompositeShape {
  automatic,  // groups on a GPU, rows elsewhere
  rows,       // for processors: a work-item walks a block or a tile, eight lanes at a time
  groups,     // for GPUs: a work-item per particle, entry or pixel, in work-groups
};

struct RendererOptions {
  std::string device;  // part of a device's name, any case; empty: a GPU, else the CPU
  CompositeShape shape = CompositeShape::automatic;
  // Tolerance 0 computes in double precision. Where the device does not have it, or this is false,
  // frames that need it end with a DeviceError.
  bool use_double = true;
  // Frames are drawn again until a bound, not an estimate, says that they keep their tolerance:
  // FrameCheck.
  bool certify = false;
  // PlanOptions, for tests. Below 0 the shape for GPUs draws a plan's slabs in order.
  int slabs = -1;
  // Of the device, for an ordered frame's splats, lists and planes together; columns of particles
  // are counted apart. A frame with more splats than have room is drawn in windows of its depth, to
  // the same bits. 0: three quarters of what a processor's machine has left, half of a GPU's
  // memory.
  std::uint64_t memory_bytes = 0;
  // The values of columns never change while the columns live, as those of files. Blocks of
  // particles are then looked at once for where they lie, when they are drawn a second time, and
  // those out of view are not projected. Pictures have the same bits.
  bool columns_stay = false;
  // Ranks that draw each frame together: all make the same renderer and draw the same frames with
  // it, and all have the picture, of the same bits that one process gives. They need devices of the
  // same kind: those of one host take different ones, where it has several. Null: this process
  // alone.
  std::shared_ptr<Communicator> ranks = nullptr;
  // Told from part to part of a frame how much of it is drawn, from 0 to 1, once for each time that
  // the frame is drawn; not for frames of one part. What it throws ends the drawing; the next frame
  // is drawn as if nothing had been. Must not use the renderer.
  std::function<void(double fraction)> progress = {};
  // Where many programs have to be compiled, some are by these, one for each core but one at most.
  // Only on a processor, through PoCL, and only where compiled programs are kept from run to run.
  // Empty: this process compiles all.
  StartCompiler start_compiler = {};
};

struct StageTime {
  std::string stage;  // project, sort, bin, composite, resolve, ...
  double seconds = 0;
};

// When a part of a frame's work began and ended, by the host's clock.
struct TimeSpan {
  std::string what;  // a stage, or the host's work: plan, draw (launching and reading), check, ...
  bool is_on_device = false;
  std::chrono::steady_clock::time_point begin, end;
};

// What one of several ranks did for a frame.
struct ProcessStats {
  std::string host;
  std::uint64_t particles = 0;   // that it projected, of its share
  std::uint64_t splats = 0;      // that it composited
  std::uint64_t sent_bytes = 0;  // to others: splats, planes
  double seconds = 0;            // from the first to the last of them, waiting included
};

struct RenderStats {
  std::string device;
  std::uint64_t particles = 0;      // in the components
  std::uint64_t bad_particles = 0;  // left out: as reference::count_bad counts them
  std::uint64_t drawn_particles = 0;
  std::uint64_t tile_entries = 0;  // splats summed over tiles
  // Blocks of particles that were not projected, since none of them is in view; of data that was
  // drawn in the frame before.
  std::uint64_t blocks_left_out = 0;
  // An ordered frame was drawn in so many windows of its depth; 0: in one piece.
  std::uint64_t windows = 0;
  // Particles were too sharp for the plan's precision: drawn again in extended precision.
  bool drawn_most_exactly = false;
  std::uint64_t device_bytes = 0;  // largest total of device buffers, mapped input excluded
  double build_seconds = 0;        // of the total: compiling kernels, or finding them compiled
  double total_seconds = 0;
  std::vector<StageTime> stages;
  // What more cores would not shorten, part by part: of each stage the commands that one thread
  // runs on a processor, `copies` between the host's memory and the device's, and the calling
  // thread's processor time for `check` (with its share of what several threads do there) and in
  // the `host` for all else. Commands are timed by the device's clock, which runs on while a busy
  // machine lets them wait. Where kernels were compiled, `host` is too small.
  std::vector<StageTime> serial;
  // Of each command of the device, whose clock is set by when commands were given to it, a few
  // microseconds late; and of the host's parts. Each in the order in which they began.
  std::vector<TimeSpan> spans;
  FrameCheck check;
  std::vector<ProcessStats> processes;  // by rank, the same at all; none where one process drew
  std::string note;                     // what the user should know of the device; empty: nothing
};

// Draws frames on one OpenCL device. Keeps compiled kernels and buffers between frames.
// Throws DeviceError. Without ranks, several threads may call render(): the device draws one frame
// at a time, while other frames are planned or checked, each by the thread that calls.
class Renderer {
 public:
  explicit Renderer(const RendererOptions& options = {});
  ~Renderer();
  Renderer(Renderer&&) noexcept;
  Renderer& operator=(Renderer&&) noexcept;

  // The same frame gives the same bits on the same device.
  Image render(const Frame& frame);
  // The same with a plan that was made of this frame already (plan.h).
  Image render(const Frame& frame, const FramePlan& plan);
  // The same, with what this frame took.
  Image render(const Frame& frame, RenderStats& stats);
  Image render(const Frame& frame, const FramePlan& plan, RenderStats& stats);

  // The plan with which render(frame) begins, for a frame whose particles are all here: looks at a
  // sample of them, on all cores or by the calling thread alone, and needs no device. Throws
  // UsageError where the frame's parts do not fit.
  static FramePlan first_plan(const Frame& frame, const PlanOptions& options,
                              bool on_all_cores = true);

  // Of the last frame that was drawn without stats of its own; no other thread may draw one.
  const RenderStats& stats() const;

 private:
  struct State;
  std::unique_ptr<State> state_;
};

}  // namespace splotchcl
