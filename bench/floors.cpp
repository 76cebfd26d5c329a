#include "floors.h"

#include <algorithm>

#include "device/frame/shared.h"

namespace splotchcl::bench {
namespace {

constexpr double word = 4;
// Lines of the cache that are written are read first.
constexpr double written = 2;
// x, y and z say that a particle is out of view.
constexpr double position_bytes = 3 * word;
// Of a splat in the order of depth.
constexpr double place_bytes = word;
// Which tiles a splat touches, as a projection of sums leaves it to binning.
constexpr double tiles_bytes = word;
// A pass of the sort for each digit of the keys' upper word. Keys are spread over all of its bits
// before (sorter.cpp), so that no digit is the same for all of many splats.
constexpr double sort_passes = 8 * word / SORT_DIGIT_BITS;
constexpr double pair_bytes = word + place_bytes;
// Red, green, blue and alpha of a finished picture.
constexpr double picture_bytes = 4 * word;

struct StageBytes {
  double frame = 0, chunk = 0;
};

StageBytes project(const FrameCounts& counts) {
  StageBytes bytes;
  bytes.frame = counts.particles * position_bytes +
                counts.splats * std::max(0.0, counts.particle_bytes - position_bytes);
  if (counts.is_ordered)
    bytes.frame += written * counts.splats * (counts.splat_bytes + counts.key_bytes + place_bytes);
  else
    bytes.chunk = written * counts.splats * (counts.splat_bytes + tiles_bytes);
  return bytes;
}

// A pass counts its digits, and then moves the pairs.
StageBytes sort(const FrameCounts& counts) {
  return {sort_passes * counts.splats * (word + pair_bytes + written * pair_bytes), 0};
}

StageBytes bin(const FrameCounts& counts) {
  StageBytes bytes;
  bytes.chunk = written * counts.entries() * counts.entry_bytes;
  if (counts.is_ordered)
    bytes.frame = counts.splats * (place_bytes + counts.splat_bytes);
  else
    bytes.chunk += counts.splats * (counts.splat_bytes + tiles_bytes);
  return bytes;
}

StageBytes certify(const FrameCounts& counts) {
  return {0, counts.entries() * counts.entry_bytes};
}

StageBytes composite(const FrameCounts& counts) {
  return {written * counts.pixels * counts.planes * word, counts.entries() * counts.entry_bytes};
}

// A slab changes the planes in place: what is written has been read.
StageBytes resolve(const FrameCounts& counts) {
  const double planes = counts.pixels * counts.planes * word;
  return {counts.slabs * 2 * planes + planes + written * counts.pixels * picture_bytes, 0};
}

StageFloor floor_of(const char* stage, const StageBytes& bytes, const MachineRates& rates) {
  StageFloor floor;
  floor.stage = stage;
  floor.frame_bytes = bytes.frame;
  floor.chunk_bytes = bytes.chunk;
  floor.byte_seconds = bytes.frame / rates.memory_bandwidth + bytes.chunk / rates.chunk_bandwidth;
  return floor;
}

}  // namespace

double chunk_bytes(const FrameCounts& counts) {
  return counts.entries() * counts.entry_bytes / std::max(1.0, counts.chunks);
}

double multiply_adds_of(const FrameCounts& counts) {
  constexpr double pixels_of_part = 8, of_sums = 3, of_layers = 9;
  return pixels_of_part *
         (of_sums * counts.summed.row_parts + of_layers * counts.layered.row_parts);
}

double StageFloor::seconds() const {
  return std::max(byte_seconds, operation_seconds);
}

std::vector<StageFloor> floors_of(const FrameCounts& counts, const MachineRates& rates) {
  std::vector<StageFloor> floors = {floor_of("project", project(counts), rates)};
  if (counts.is_ordered) floors.push_back(floor_of("sort", sort(counts), rates));
  floors.push_back(floor_of("bin", bin(counts), rates));
  if (counts.is_collected) floors.push_back(floor_of("certify", certify(counts), rates));
  floors.push_back(floor_of("composite", composite(counts), rates));
  floors.back().operation_seconds = multiply_adds_of(counts) / rates.multiply_adds;
  floors.push_back(floor_of("resolve", resolve(counts), rates));
  return floors;
}

}  // namespace splotchcl::bench
