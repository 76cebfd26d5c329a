#include "device/stages/key_counter.h"

#include <algorithm>
#include <limits>
#include <numeric>
#include <utility>

#include "device/stages/clear_memory.h"
#include "device/stages/project_parameters.h"

namespace splotchcl {
namespace {

bool are_in(const shared::KeyBins& bins, const KeyWindow& window) {
  return bins.least <= bins.most && bins.most >= window.first >> shift_of_all_keys &&
         bins.least <= (window.end - 1) >> shift_of_all_keys;
}

bool is_everything(const KeyWindow& window) {
  return window.first == 0 && window.end == end_of_keys;
}

// What the device counts, in 32 bits.
class Bins {
 public:
  explicit Bins(DeviceContext& device)
      : device_(device), bins_(device.pool.get<std::uint32_t>(KEY_BINS, "counts of keys")) {
    clear();
  }

  const Buffer<std::uint32_t>& buffer() const { return bins_; }
  void clear() {
    clear_memory(device_, "project", bins_.memory(), 0, KEY_BINS * sizeof(std::uint32_t));
  }
  std::vector<std::uint32_t> values() const { return device_.pool.download(bins_, KEY_BINS); }

 private:
  DeviceContext& device_;
  const Buffer<std::uint32_t> bins_;
};

}  // namespace

KeyCounter::KeyCounter(const StageContext& context, const Projector& projector,
                       ParticleStore& particles, std::vector<ParticleChunk> chunks)
    : context_(context),
      projector_(projector),
      particles_(particles),
      chunks_(std::move(chunks)),
      bins_(chunks_.size()) {}

ParticleBuffers KeyCounter::particles_of(std::size_t chunk) const {
  return particles_in_view(context_, particles_, chunks_[chunk]);
}

std::uint64_t KeyCounter::most_splats_of(std::size_t chunk) const {
  return std::uint64_t{chunks_[chunk].count()} *
         static_cast<std::uint64_t>(context_.plan.splats_per_particle);
}

bool KeyCounter::has_keys_in(std::size_t chunk, const KeyWindow& window) const {
  return std::any_of(bins_[chunk].begin(), bins_[chunk].end(),
                     [&](const shared::KeyBins& block) { return are_in(block, window); });
}

void KeyCounter::note(std::size_t chunk, const ChunkKeys& keys) {
  bins_[chunk] = keys.bins;
  left_out_ += keys.left_out;
  counts_.visible += keys.particles.visible;
  counts_.bad += keys.particles.bad;
  counts_.too_sharp += keys.particles.too_sharp;
  counts_.around += keys.particles.around;
}

// So many chunks at a time as 32 bits allow.
CountedKeys KeyCounter::count(const KeyWindow& window, int shift) {
  const bool is_first = is_everything(window);
  CountedKeys counted{window, shift, std::vector<std::uint64_t>(KEY_BINS)};
  Bins bins(context_.device);
  std::uint64_t counted_splats = 0;
  const auto take = [&] {
    const std::vector<std::uint32_t> found = bins.values();
    for (std::size_t bin = 0; bin < found.size(); ++bin)
      counted.bins[bin] += found[bin];
  };
  for (std::size_t c = 0; c < chunks_.size(); ++c) {
    if (!is_first && !has_keys_in(c, window)) continue;
    if (counted_splats + most_splats_of(c) > std::numeric_limits<std::uint32_t>::max()) {
      take();
      bins.clear();
      counted_splats = 0;
    }
    counted_splats += most_splats_of(c);
    const ChunkKeys keys =
        projector_.count_keys(chunks_[c], particles_of(c), window, shift, bins.buffer());
    if (is_first) note(c, keys);
  }
  take();
  return counted;
}

std::uint64_t KeyCounter::count_in_chunk(std::size_t chunk, const KeyWindow& window) {
  if (!has_keys_in(chunk, window)) return 0;
  Bins bins(context_.device);
  projector_.count_keys(chunks_[chunk], particles_of(chunk), window, shift_of_all_keys,
                        bins.buffer());
  const std::vector<std::uint32_t> found = bins.values();
  return std::accumulate(found.begin(), found.end(), std::uint64_t{0});
}

std::vector<std::uint32_t> KeyCounter::blocks_without(std::size_t chunk,
                                                      const KeyWindow& window) const {
  std::vector<std::uint32_t> without;
  for (const shared::KeyBins& block : bins_[chunk])
    without.push_back(are_in(block, window) ? 0 : 1);
  return without;
}

}  // namespace splotchcl
