#include "device/frame/particle_store.h"

#include <algorithm>
#include <string>
#include <utility>

#include "device/frame/column_interpolator.h"
#include "splotchcl/error.h"

namespace splotchcl {

compute::buffer ParticleStore::constant(float value) {
  const auto found = constants_.find(value);
  if (found != constants_.end()) return found->second;
  compute::buffer buffer(device_.context, sizeof(float));
  device_.queue.enqueue_write_buffer(buffer, 0, sizeof(float), &value);
  constants_.emplace(value, buffer);
  return buffer;
}

void ParticleStore::require_room(std::size_t bytes) const {
  const std::uint64_t largest = device_.device.max_memory_alloc_size();
  if (bytes <= largest) return;
  throw DeviceError("device " + device_.device.name() + ": one field of the particles has " +
                    std::to_string(bytes >> 20) + " MiB, expected at most " +
                    std::to_string(largest >> 20) +
                    " MiB: draw a part of the particles, or another device (--device)");
}

const compute::buffer* ParticleStore::find(const Key& key) {
  const auto found = entries_.find(key);
  if (found == entries_.end()) return nullptr;
  found->second.frame = frame_;
  return &found->second.buffer;
}

compute::buffer ParticleStore::keep(const Key& key, std::shared_ptr<const void> owner) {
  const void* const memory = std::get<0>(key);
  const std::size_t bytes = std::get<1>(key);
  require_room(bytes);
  Entry entry;
  entry.owner = std::move(owner);
  entry.frame = frame_;
  // OpenCL's interface takes host memory as non-const; a read-only buffer is not written.
  void* const at = const_cast<void*>(memory);
  if (device_.traits.shares_host_memory) {
    entry.buffer =
        compute::buffer(device_.context, bytes, CL_MEM_READ_ONLY | CL_MEM_USE_HOST_PTR, at);
  } else {
    entry.buffer =
        compute::buffer(device_.context, bytes, CL_MEM_READ_ONLY | CL_MEM_COPY_HOST_PTR, at);
    entry.bytes = bytes;
    device_bytes_ += bytes;
  }
  return entries_.emplace(key, std::move(entry)).first->second.buffer;
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

ParticleBuffers ParticleStore::get(const Particles& particles) {
  ParticleBuffers buffers;
  int position_stride = 0;
  buffers.position = buffer_of(particles.position, 0, position_stride);
  buffers.smoothing_length =
      buffer_of(particles.smoothing_length, 0, buffers.smoothing_length_stride);
  buffers.weight = buffer_of(particles.weight, 1, buffers.weight_stride);
  buffers.color = buffer_of(particles.color, 0, buffers.color_stride);
  buffers.intensity = buffer_of(particles.intensity, 1, buffers.intensity_stride);
  buffers.sort_field = buffer_of(particles.sort_field, 0, buffers.sort_stride);
  buffers.own_color = buffer_of(particles.color_vector, 1, buffers.own_color_stride);
  if (columns_stay_) buffers.boxes = boxes_.find(device_, particles, buffers, frame_);
  return buffers;
}

void ParticleStore::end_frame() {
  boxes_.forget_all_but(frame_);
  for (auto entry = entries_.begin(); entry != entries_.end();) {
    if (entry->second.frame == frame_) {
      ++entry;
      continue;
    }
    device_bytes_ -= entry->second.bytes;
    entry = entries_.erase(entry);
  }
}

}  // namespace splotchcl
