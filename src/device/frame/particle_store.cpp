#include "device/frame/particle_store.h"

#include <algorithm>
#include <cstring>
#include <iterator>
#include <string>
#include <utility>

#include "device/frame/shared.h"
#include "device/frame/variant.h"
#include "device/opencl/launch.h"
#include "parallel/for_blocks.h"
#include "scene/ceil_divide.h"
#include "scene/memory_advice.h"
#include "scene/particle_columns.h"
#include "splotchcl/error.h"

namespace splotchcl {
namespace {

// What the device has of the two snapshots: of the first in its own order, of the second as
// order_second_on_device() puts it. Strides are 0 where one value serves all, or none.
struct SnapshotColumns {
  compute::buffer first, second, first_velocity, second_velocity, place_in_second;
  int first_stride = 0, second_stride = 0, first_velocity_stride = 0, second_velocity_stride = 0;
};

void copy(const float (&from)[3], float (&to)[3]) {
  std::copy(std::begin(from), std::end(from), std::begin(to));
}

shared::InterpolateParameters parameters_of(const DeviceContext& device, const IdMatch& match,
                                            int values_per_particle) {
  shared::InterpolateParameters p{};
  p.in_first = static_cast<unsigned>(match.place_in_second.size());
  p.particles = static_cast<unsigned>(match.particles());
  p.particles_of_item = device.traits.interpolate_block;
  p.width = static_cast<unsigned>(values_per_particle);
  return p;
}

shared::PathParameters parameters_of(const PathNumbers& path, const SnapshotColumns& snapshots) {
  shared::PathParameters p{};
  copy(path.shift_high, p.shift_high);
  copy(path.shift_low, p.shift_low);
  copy(path.size_high, p.size_high);
  copy(path.size_low, p.size_low);
  copy(path.inverse_size, p.inverse_size);
  copy(path.lower, p.lower);
  copy(path.upper, p.upper);
  p.first_rate = path.first_rate;
  p.second_rate = path.second_rate;
  p.of_way = path.of_way;
  p.of_first_tangent = path.of_first_tangent;
  p.of_second_tangent = path.of_second_tangent;
  p.from_first = path.from_first;
  p.from_second = path.from_second;
  p.is_periodic = path.is_periodic;
  p.is_straight = path.is_straight;
  p.first_velocity_stride = snapshots.first_velocity_stride;
  p.second_velocity_stride = snapshots.second_velocity_stride;
  return p;
}

Launch launch_of(DeviceContext& device, const char* kernel) {
  const Program program = device.programs.get(
      program_source("kernels/interpolate/interpolate.cl", device.traits.lanes()));
  return Launch(device, "interpolate", program.create_kernel(kernel));
}

void run(Launch& launch, const shared::InterpolateParameters& p) {
  const std::size_t items = ceil_divide(p.particles, p.particles_of_item);
  if (p.particles_of_item > 1) {
    launch.run_items(items);
  } else {
    launch.run_grid(items, 1, 1);
  }
}

// Values of particles [first, end) in a column of `count` of them.
void read_ahead_of(const Column& column, std::size_t count, std::uint64_t first,
                   std::uint64_t end) {
  if (count == 0 || column.size() == 0) return;
  const std::size_t width = column.size() / count;
  read_ahead(column, width * static_cast<std::size_t>(first),
             width * static_cast<std::size_t>(end));
}

// A column of the second snapshot in the order of the particles between the two. Does not wait.
void order_second_on_device(DeviceContext& device, const IdMatch& match, int values_per_particle,
                            const compute::buffer& second, const compute::buffer& place_in_second,
                            const compute::buffer& appearing, const compute::buffer& ordered) {
  const shared::InterpolateParameters p = parameters_of(device, match, values_per_particle);
  Launch launch = launch_of(device, "order_second");
  launch.value(p).arg(second).arg(place_in_second).arg(appearing).arg(ordered);
  run(launch, p);
}

// Makes a column between two snapshots on the device, to the bits of interpolate(): the stage
// `interpolate`. Does not wait.
void interpolate_on_device(DeviceContext& device, const ColumnBetween& column,
                           const SnapshotColumns& snapshots, const compute::buffer& values) {
  shared::InterpolateParameters p =
      parameters_of(device, *column.match, column.values_per_particle);
  p.first_stride = snapshots.first_stride;
  p.second_stride = snapshots.second_stride;
  p.logarithmic = column.kind == ColumnBetween::Kind::logarithmic;
  p.fraction = column.fraction;
  p.vanishing = column.fades ? column.vanishing : 1.0F;
  p.appearing = column.fades ? column.appearing : 1.0F;
  const bool is_position = column.kind == ColumnBetween::Kind::position;
  Launch launch = launch_of(device, is_position ? "interpolate_positions" : "interpolate_values");
  launch.value(p);
  if (is_position) launch.value(parameters_of(column.path, snapshots));
  launch.arg(snapshots.first).arg(snapshots.second);
  if (is_position) launch.arg(snapshots.first_velocity).arg(snapshots.second_velocity);
  launch.arg(snapshots.place_in_second).arg(values);
  run(launch, p);
}

}  // namespace

compute::buffer ParticleStore::new_constant(float value) const {
  compute::buffer buffer(device_.context, sizeof(float));
  device_.queue.enqueue_write_buffer(buffer, 0, sizeof(float), &value);
  return buffer;
}

compute::buffer ParticleStore::constant(float value) {
  // By its bits: what is not a number is no key, as it is not less than any.
  std::uint32_t bits = 0;
  std::memcpy(&bits, &value, sizeof(bits));
  auto found = constants_.find(bits);
  if (found == constants_.end())
    found = constants_.emplace(bits, Constant{new_constant(value)}).first;
  found->second.frame = frame_;
  return found->second.buffer;
}

void ParticleStore::require_room(std::size_t bytes) const {
  const std::uint64_t largest = device_.traits.largest_buffer;
  if (bytes <= largest) return;
  throw DeviceError("device " + device_.device.name() + ": one field of the particles has " +
                    std::to_string(bytes >> 20) + " MiB, expected at most " +
                    std::to_string(largest >> 20) +
                    " MiB: draw a part of the particles, or another device (--device)");
}

const compute::buffer* ParticleStore::find(const Key& key) {
  const auto found = entries_.find(key);
  if (found == entries_.end()) return nullptr;
  Entry& entry = found->second;
  // Who draws arrays of its own may have changed them since the last frame.
  const bool is_copy = entry.kind == Kind::given && entry.bytes > 0;
  if (is_copy && !columns_stay_ && entry.frame != frame_) {
    device_.copies.write(entry.buffer, std::get<0>(key), static_cast<std::size_t>(entry.bytes));
  }
  entry.frame = frame_;
  entry.use = ++uses_;
  return &entry.buffer;
}

compute::buffer ParticleStore::keep(const Key& key, std::shared_ptr<const void> owner) {
  const void* const memory = std::get<0>(key);
  const std::size_t bytes = std::get<1>(key);
  require_room(bytes);
  Entry entry;
  entry.owner = std::move(owner);
  entry.frame = frame_;
  entry.use = ++uses_;
  if (device_.traits.shares_host_memory) {
    // OpenCL's interface takes host memory as non-const; a read-only buffer is not written.
    void* const at = const_cast<void*>(memory);
    entry.buffer =
        compute::buffer(device_.context, bytes, CL_MEM_READ_ONLY | CL_MEM_USE_HOST_PTR, at);
  } else {
    make_room(bytes);
    entry.buffer = compute::buffer(device_.context, bytes, CL_MEM_READ_ONLY);
    device_.copies.write(entry.buffer, memory, bytes);
    entry.bytes = bytes;
    device_bytes_ += bytes;
  }
  return entries_.emplace(key, std::move(entry)).first->second.buffer;
}

// Of a device that has not room for all of a frame's columns, those go that were wanted first: the
// next pass over the particles wants them last.
void ParticleStore::make_room(std::size_t bytes) {
  while (device_bytes_ + bytes > device_.memory.columns) {
    auto oldest = entries_.end();
    for (auto entry = entries_.begin(); entry != entries_.end(); ++entry) {
      if (entry->second.kind != Kind::given || entry->second.bytes == 0) continue;
      if (oldest == entries_.end() || entry->second.use < oldest->second.use) oldest = entry;
    }
    if (oldest == entries_.end()) return;
    device_bytes_ -= oldest->second.bytes;
    entries_.erase(oldest);
  }
}

compute::buffer ParticleStore::buffer_of(const Column& column, float value_if_absent, int& stride) {
  if (!column.is_array() || column.size() == 0) {
    stride = 0;
    return constant(column.is_uniform() ? column.uniform_value() : value_if_absent);
  }
  stride = 1;
  if (const auto between = interpolated(column)) return interpolated_buffer(between);
  const Key key = {column.data(), column.size() * sizeof(float), nullptr};
  if (const compute::buffer* const known = find(key)) return *known;
  return keep(key, std::make_shared<const Column>(column));
}

// Of a piece of an array, of which the rest may be on the device as well or not.
compute::buffer ParticleStore::buffer_of(const Column& column, std::size_t values_per_particle,
                                         const Piece& piece, float value_if_absent, int& stride) {
  const std::size_t first = piece.first * values_per_particle;
  const std::size_t end = piece.end * values_per_particle;
  const bool is_whole = first == 0 && end >= column.size();
  const auto source = column.source();
  if (!column.is_array() || (is_whole && !is_streamed(column)) || interpolated(column))
    return buffer_of(column, value_if_absent, stride);
  stride = 1;
  if (is_streamed(column)) return streamed_buffer(*source, values_per_particle, piece);
  const Key key = {column.data() + first, (end - first) * sizeof(float), nullptr};
  if (const compute::buffer* const known = find(key)) return *known;
  return keep(key, std::make_shared<const Column>(column));
}

compute::buffer ParticleStore::streamed_buffer(const ColumnSource& source,
                                               std::size_t values_per_particle,
                                               const Piece& piece) {
  const std::size_t width = values_per_particle;
  const auto size = static_cast<std::size_t>(piece.end - piece.first) * width;
  if (streamed_values_.size() < size) streamed_values_.resize(size);
  float* const values = streamed_values_.data();
  for (const Piece& seen : seen_) {
    for_blocks(seen.end - seen.first, streamed_particles, [&](std::size_t first, std::size_t last) {
      source.make((seen.first + first) * width, (seen.first + last) * width,
                  values + (seen.first + first - piece.first) * width);
    });
  }
  streamed_.push_back(device_.pool.upload(values, size, "chunk of a column"));
  return streamed_.back().memory();
}

// The stretches of a chunk whose blocks are not left out. A chunk of streamed columns is a piece.
void ParticleStore::list_seen(const Particles& particles, const Piece& chunk,
                              const ViewBounds* bounds) {
  seen_.clear();
  if (!particles.boxes || bounds == nullptr) {
    seen_.push_back(chunk);
    return;
  }
  const std::uint32_t length = device_.traits.project_block;
  const BlockBoxes::Boxes& boxes = boxes_.given(particles.boxes, particles.count, length, frame_);
  for (std::uint64_t first = chunk.first; first < chunk.end; first += length) {
    if (bounds->leave_out(boxes.at(static_cast<std::size_t>(first / length)))) continue;
    const std::uint64_t end = std::min<std::uint64_t>(chunk.end, first + length);
    if (!seen_.empty() && seen_.back().end == first) {
      seen_.back().end = end;
    } else {
      seen_.push_back({first, end});
    }
  }
  for (const Piece& seen : seen_) {
    for (const Column* const column : particles.columns())
      read_ahead_of(*column, particles.count, seen.first, seen.end);
  }
}

compute::buffer ParticleStore::buffer_of(const std::vector<std::uint32_t>& places,
                                         const std::shared_ptr<const IdMatch>& match) {
  if (places.empty()) return constant(0);
  const Key key = {places.data(), places.size() * sizeof(std::uint32_t), nullptr};
  if (const compute::buffer* const known = find(key)) return *known;
  return keep(key, match);
}

// The memory of a column of the last frame serves the next one, and that of the last pair.
ParticleStore::Entry ParticleStore::new_or_stale(Kind kind, std::size_t bytes) {
  const auto stale = std::find_if(entries_.begin(), entries_.end(), [&](const auto& entry) {
    return entry.second.kind == kind && entry.second.frame != frame_ && entry.second.bytes == bytes;
  });
  if (stale != entries_.end()) {
    Entry entry = std::move(stale->second);
    entries_.erase(stale);
    return entry;
  }
  require_room(bytes);
  Entry entry;
  entry.kind = kind;
  entry.bytes = bytes;
  entry.buffer = compute::buffer(device_.context, bytes, CL_MEM_READ_WRITE);
  device_bytes_ += bytes;
  return entry;
}

// The column itself is not wanted again: a device with memory of its own soon forgets it.
compute::buffer ParticleStore::ordered_buffer(const Column& second, int values_per_particle,
                                              const std::shared_ptr<const IdMatch>& match,
                                              int& stride) {
  if (!second.is_array() || second.size() == 0) return buffer_of(second, 0, stride);
  stride = 1;
  const Key key = {second.data(), 0, match.get()};
  if (const compute::buffer* const known = find(key)) return *known;
  int same = 0;
  const compute::buffer as_stored = buffer_of(second, 0, same);
  Entry entry = new_or_stale(
      Kind::ordered,
      match->particles() * static_cast<std::size_t>(values_per_particle) * sizeof(float));
  entry.owner =
      std::make_shared<const std::pair<Column, std::shared_ptr<const IdMatch>>>(second, match);
  entry.frame = frame_;
  order_second_on_device(device_, *match, values_per_particle, as_stored,
                         buffer_of(match->place_in_second, match),
                         buffer_of(match->appearing, match), entry.buffer);
  return entries_.emplace(key, std::move(entry)).first->second.buffer;
}

compute::buffer ParticleStore::interpolated_buffer(
    const std::shared_ptr<const InterpolatedColumn>& column) {
  const ColumnBetween& between = column->interpolation();
  // Before the column itself is looked for: what it is made from stays on the device with it.
  SnapshotColumns snapshots;
  snapshots.first = buffer_of(between.first, 0, snapshots.first_stride);
  snapshots.first_velocity = buffer_of(between.first_velocity, 0, snapshots.first_velocity_stride);
  snapshots.place_in_second = buffer_of(between.match->place_in_second, between.match);
  const int width = between.values_per_particle;
  snapshots.second = ordered_buffer(between.second, width, between.match, snapshots.second_stride);
  snapshots.second_velocity = ordered_buffer(between.second_velocity, width, between.match,
                                             snapshots.second_velocity_stride);
  const Key key = {column.get(), 0, nullptr};
  if (const compute::buffer* const known = find(key)) return *known;
  Entry entry = new_or_stale(Kind::between, column->size() * sizeof(float));
  entry.owner = column;
  entry.frame = frame_;
  interpolate_on_device(device_, between, snapshots, entry.buffer);
  return entries_.emplace(key, std::move(entry)).first->second.buffer;
}

// Those that are made as they are wanted make room for the next component's.
bool ParticleStore::are_whole(const Particles& particles) const {
  if (has_streamed_column(particles)) return false;
  const Piece piece = piece_of(particles, {0, 0, 0});
  return piece.end == particles.count;
}

// Whole columns where they can be: a second frame finds them.
ParticleStore::Piece ParticleStore::piece_of(const Particles& particles,
                                             const ParticleChunk& chunk) const {
  if (has_streamed_column(particles)) return {chunk.first, chunk.end};
  // Kernels number the particles of a buffer by 32 bits.
  constexpr std::uint64_t most = std::uint64_t{1} << 31;
  const std::uint64_t largest = std::min(most, device_.traits.largest_buffer / (3 * sizeof(float)));
  if (particles.count <= largest) return {0, particles.count};
  const std::uint64_t chunk_length = particles_per_chunk(particles.count, device_.traits);
  const std::uint64_t length = std::max<std::uint64_t>(1, largest / chunk_length) * chunk_length;
  const std::uint64_t first = chunk.first / length * length;
  return {first, std::min<std::uint64_t>(particles.count, first + length)};
}

ParticleBuffers ParticleStore::get(const Particles& particles, const ParticleChunk& chunk,
                                   const ViewBounds* bounds) {
  const Piece piece = piece_of(particles, chunk);
  // What lies beyond would be read from behind the buffers.
  if (chunk.first < piece.first || chunk.end > piece.end) {
    throw DeviceError("found a chunk of particles " + std::to_string(chunk.first) + " to " +
                      std::to_string(chunk.end) + " across pieces of columns, expected it within " +
                      std::to_string(piece.first) + " to " + std::to_string(piece.end));
  }
  list_seen(particles, {chunk.first, chunk.end}, bounds);
  return get_piece(particles, piece);
}

ParticleBuffers ParticleStore::get_piece(const Particles& particles, const Piece& piece) {
  const bool is_whole = piece.end - piece.first == particles.count;
  const auto columns = particles.columns();
  if (!is_whole && std::any_of(columns.begin(), columns.end(),
                               [](const Column* column) { return interpolated(*column); })) {
    throw DeviceError("device " + device_.device.name() + ": found " +
                      std::to_string(particles.count) +
                      " particles between two snapshots, expected at most " +
                      std::to_string(piece.end - piece.first) +
                      ": draw a part of them, or a moment that a snapshot has");
  }
  // Commands that read them come before those that will write their memory.
  streamed_.clear();
  ParticleBuffers buffers;
  buffers.first = piece.first;
  int position_stride = 0;
  const auto scalars = [&](const Column& column, float value_if_absent, int& stride) {
    return buffer_of(column, 1, piece, value_if_absent, stride);
  };
  buffers.position = buffer_of(particles.position, 3, piece, 0, position_stride);
  buffers.smoothing_length =
      scalars(particles.smoothing_length, 0, buffers.smoothing_length_stride);
  buffers.weight = scalars(particles.weight, 1, buffers.weight_stride);
  buffers.color = scalars(particles.color, 0, buffers.color_stride);
  buffers.intensity = scalars(particles.intensity, 1, buffers.intensity_stride);
  buffers.sort_field = scalars(particles.sort_field, 0, buffers.sort_stride);
  buffers.own_color = buffer_of(particles.color_vector, 3, piece, 1, buffers.own_color_stride);
  if (particles.boxes) {
    buffers.boxes =
        &boxes_.given(particles.boxes, particles.count, device_.traits.project_block, frame_);
  } else if (columns_stay_ && is_whole)
    buffers.boxes = boxes_.find(device_, particles, buffers, frame_);
  return buffers;
}

void ParticleStore::end_frame(std::uint64_t number) {
  boxes_.forget_before(number);
  for (auto constant = constants_.begin(); constant != constants_.end();) {
    const bool is_asked_for = constant->second.frame >= number;
    constant = is_asked_for ? std::next(constant) : constants_.erase(constant);
  }
  for (auto entry = entries_.begin(); entry != entries_.end();) {
    if (entry->second.frame >= number) {
      ++entry;
      continue;
    }
    device_bytes_ -= entry->second.bytes;
    entry = entries_.erase(entry);
  }
}

void set_strides(const ParticleBuffers& particles, shared::ProjectLaunch& launch) {
  launch.smoothing_length_stride = particles.smoothing_length_stride;
  launch.weight_stride = particles.weight_stride;
  launch.color_stride = particles.color_stride;
  launch.intensity_stride = particles.intensity_stride;
  launch.sort_stride = particles.sort_stride;
  launch.own_color_stride = particles.own_color_stride;
}

Launch& pass_columns(Launch& launch, const ParticleBuffers& particles) {
  return launch.arg(particles.position)
      .arg(particles.smoothing_length)
      .arg(particles.weight)
      .arg(particles.color)
      .arg(particles.intensity)
      .arg(particles.sort_field)
      .arg(particles.own_color);
}

}  // namespace splotchcl
