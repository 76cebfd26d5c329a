#include "device/stages/window_projector.h"

#include <algorithm>
#include <limits>
#include <utility>

#include "device/frame/splat_capacity.h"
#include "device/opencl/clear_memory.h"
#include "device/opencl/launch.h"

namespace splotchcl {
namespace {

constexpr int first_shift = 32;

bool has_keys_in(const shared::KeyBins& bins, const KeyWindow& window) {
  return bins.least <= bins.most && bins.most >= window.first >> first_shift &&
         bins.least <= (window.end - 1) >> first_shift;
}

bool is_everything(const KeyWindow& window) {
  return window.first == 0 && window.end == end_of_keys;
}

}  // namespace

std::uint64_t splat_capacity(const StageContext& context) {
  return splat_capacity(context.plan, context.specialization, context.layout, context.device.traits,
                        context.device.memory.total);
}

WindowProjector::WindowProjector(const StageContext& context, const Projector& projector,
                                 const Sorter& sorter, ParticleStore& particles)
    : context_(context),
      projector_(projector),
      sorter_(sorter),
      particles_(particles),
      chunks_(particle_chunks(context.frame, context.device.traits)),
      capacity_(splat_capacity(context)),
      bins_(chunks_.size()) {}

ParticleBuffers WindowProjector::particles_of(const ParticleChunk& chunk) const {
  return particles_.get(context_.frame.components[chunk.component].particles, chunk);
}

std::uint64_t WindowProjector::most_splats_of(const ParticleChunk& chunk) const {
  return std::uint64_t{chunk.count()} *
         static_cast<std::uint64_t>(context_.plan.splats_per_particle);
}

void WindowProjector::count_keys() {
  const CountedKeys counted = count({}, first_shift);
  if (counts_.too_sharp > 0) return;
  const auto count_again = [this](const KeyWindow& window, int shift) {
    return count(window, shift);
  };
  for (const KeyWindow& window : choose_windows(counted, capacity_, count_again))
    add_steps(window);
  // Clouds around the camera may be all that there is.
  if (steps_.empty()) steps_.push_back({});
}

// The device counts in 32 bits, so many chunks at a time as that allows.
CountedKeys WindowProjector::count(const KeyWindow& window, int shift) {
  DeviceContext& device = context_.device;
  const bool is_first = is_everything(window);
  CountedKeys counted{window, shift, std::vector<std::uint64_t>(KEY_BINS)};
  const auto bins = device.pool.get<std::uint32_t>(KEY_BINS, "counts of keys");
  std::uint64_t counted_splats = 0;
  const auto clear = [&] {
    clear_memory(device, "project", bins.memory(), 0, KEY_BINS * sizeof(std::uint32_t));
    counted_splats = 0;
  };
  const auto take = [&] {
    const std::vector<std::uint32_t> found = device.pool.download(bins, KEY_BINS);
    for (std::size_t bin = 0; bin < found.size(); ++bin)
      counted.bins[bin] += found[bin];
  };
  clear();
  for (std::size_t c = 0; c < chunks_.size(); ++c) {
    const ParticleChunk& chunk = chunks_[c];
    const auto is_in = [&](const shared::KeyBins& block) { return has_keys_in(block, window); };
    if (!is_first && std::none_of(bins_[c].begin(), bins_[c].end(), is_in)) continue;
    if (counted_splats + most_splats_of(chunk) > std::numeric_limits<std::uint32_t>::max()) {
      take();
      clear();
    }
    counted_splats += most_splats_of(chunk);
    const ChunkKeys keys = projector_.count_keys(chunk, particles_of(chunk), window, shift, bins);
    if (!is_first) continue;
    bins_[c] = keys.bins;
    left_out_ += keys.left_out;
    counts_.visible += keys.particles.visible;
    counts_.bad += keys.particles.bad;
    counts_.too_sharp += keys.particles.too_sharp;
    counts_.around += keys.particles.around;
  }
  take();
  return counted;
}

// Splats of one key are in the order of their particles, and may be drawn chunk by chunk.
void WindowProjector::add_steps(const KeyWindow& window) {
  if (window.splats <= capacity_) {
    steps_.push_back({window, 0, chunks_.size()});
    return;
  }
  for (std::size_t c = 0; c < chunks_.size(); ++c) {
    const std::uint64_t most = most_splats_of(chunks_[c]);
    const bool has_room = !steps_.empty() && steps_.back().end_chunk == c &&
                          steps_.back().window.first == window.first &&
                          steps_.back().window.splats + most <= capacity_;
    if (!has_room) steps_.push_back({{window.first, window.end, 0}, c, c});
    steps_.back().window.splats += most;
    steps_.back().end_chunk = c + 1;
  }
}

std::vector<std::uint32_t> WindowProjector::blocks_without(std::size_t chunk,
                                                           const KeyWindow& window) const {
  std::vector<std::uint32_t> without;
  for (const shared::KeyBins& block : bins_[chunk])
    without.push_back(has_keys_in(block, window) ? 0 : 1);
  return without;
}

std::uint64_t WindowProjector::end_of_step(std::size_t step) const {
  return step + 1 < steps_.size() ? steps_[step + 1].window.first : end_of_keys;
}

SortedSplats WindowProjector::next(std::size_t step, SortedSplats sorted, std::uint32_t first,
                                   const MoreSplats& more) const {
  const Step& wanted = steps_[step];
  const std::uint64_t end = end_of_step(step);
  const std::uint32_t carried = sorted.count - first;
  // What is left is put aside first: two windows have no room at one time.
  KeyedSplats left;
  if (carried > 0) {
    left = projector_.keyed_memory(carried);
    carry(sorted, first, left);
  }
  sorted = {std::move(left.splats), std::move(left.order), carried};
  KeyedSplats keyed = projector_.keyed_memory(
      carried + static_cast<std::uint32_t>(wanted.window.splats) + more.count(end));
  if (carried > 0) carry(sorted, 0, keyed);
  std::uint32_t slot = carried;
  for (std::size_t c = wanted.first_chunk; c < wanted.end_chunk; ++c) {
    const std::vector<std::uint32_t> without = blocks_without(c, wanted.window);
    if (std::count(without.begin(), without.end(), 0u) == 0) continue;
    slot += projector_.project_window(chunks_[c], particles_of(chunks_[c]), wanted.window, without,
                                      keyed, slot);
  }
  keyed.count = slot;
  more.append(end, keyed);
  return sorter_.sort(std::move(keyed));
}

void WindowProjector::carry(const SortedSplats& sorted, std::uint32_t first,
                            const KeyedSplats& keyed) const {
  DeviceContext& device = context_.device;
  const compute::program program = device.programs.get(Specialization::carry());
  const auto copy = [&](const Buffer<std::byte>& from, const Buffer<std::byte>& to,
                        std::size_t splat_bytes) {
    Launch(device, "sort", program.create_kernel("carry_splats"))
        .value(static_cast<cl_uint>(first))
        .value(static_cast<cl_uint>(splat_bytes / sizeof(cl_uint)))
        .value(static_cast<cl_uint>(keyed.key_ends.size() > 0))
        .arg(sorted.order)
        .arg(from)
        .arg(to)
        .arg(keyed.keys)
        .arg(keyed.key_ends)
        .arg(keyed.order)
        .run_items(sorted.count - first);
  };
  const Specialization& specialization = context_.specialization;
  copy(sorted.splats.splats, keyed.splats.splats, specialization.splat_bytes());
  if (specialization.is_extended())
    copy(sorted.splats.extended, keyed.splats.extended, specialization.extended_splat_bytes());
}

}  // namespace splotchcl
