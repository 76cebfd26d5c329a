#pragma once

#include <cstdint>
#include <map>
#include <memory>
#include <tuple>
#include <vector>

#include "between/interpolation.h"
#include "device/frame/block_boxes.h"
#include "device/frame/chunks.h"
#include "device/frame/shared.h"
#include "device/opencl/device_context.h"
#include "device/opencl/launch.h"
#include "scene/memory_advice.h"
#include "splotchcl/particles.h"

namespace splotchcl {

// The device's view of one component's columns, or of a piece of them. On a device that shares the
// host's memory the buffers lie in the columns themselves and cost nothing.
struct ParticleBuffers {
  std::uint64_t first = 0;  // the particle of the component that is the buffers' first
  compute::buffer position, smoothing_length, weight, color, intensity, sort_field, own_color;
  int smoothing_length_stride = 0, weight_stride = 0, color_stride = 0, intensity_stride = 0,
      sort_stride = 0, own_color_stride = 0;
  // Of all blocks of the component, until the frame ends; null where they are not known.
  const BlockBoxes::Boxes* boxes = nullptr;
};

// Keeps columns on the device from frame to frame: a second frame of data that stay moves nothing,
// one of arrays that may have changed writes them anew. A column is known by its memory, which it
// keeps alive. Columns between two snapshots are made on the device from theirs, which stay as long
// as frames between them are drawn. Columns that one buffer of the device does not hold are there
// in pieces, and those whose values are made as they are wanted in chunks, one at a time.
class ParticleStore {
 public:
  // `columns_stay` as in RendererOptions.
  explicit ParticleStore(DeviceContext& device, bool columns_stay = false)
      : device_(device), columns_stay_(columns_stay) {}

  // A piece in which the chunk lies, which is one of particle_chunks() or of particles_of_rank().
  // Values that are made as they are wanted are not made for blocks of particles that `bounds`,
  // which may be null, leave out: those are bad particles then.
  ParticleBuffers get(const Particles& particles, const ParticleChunk& chunk,
                      const ViewBounds* bounds = nullptr);
  // Whether get() of a chunk returns all particles, which stay beside those of other components.
  bool are_whole(const Particles& particles) const;
  // Bytes on the device, without those that lie in the caller's memory.
  std::uint64_t device_bytes() const { return device_bytes_; }
  // The frame's number. One may begin before others have ended, which are drawn by turns.
  std::uint64_t begin_frame() { return ++frame_; }
  // Forgets columns that neither this frame nor one that began later has asked for.
  void end_frame(std::uint64_t number);

 private:
  enum class Kind {
    given,    // by the host
    ordered,  // of a second snapshot, in the order of a pair's particles
    between,  // two snapshots
  };
  struct Entry {
    std::shared_ptr<const void> owner;  // of the memory that the buffer stands for
    compute::buffer buffer;
    std::uint64_t bytes = 0;
    std::uint64_t frame = 0;
    std::uint64_t use = 0;  // grows from one to the next
    Kind kind = Kind::given;
  };
  struct Constant {
    compute::buffer buffer;
    std::uint64_t frame = 0;
  };
  // Where it lies and how many bytes it has; of what the device makes, its source and 0; of a
  // column that it has put in another order, where it lies and the order.
  using Key = std::tuple<const void*, std::size_t, const IdMatch*>;

  // Particles [first, end).
  struct Piece {
    std::uint64_t first = 0, end = 0;
  };
  Piece piece_of(const Particles& particles, const ParticleChunk& chunk) const;
  ParticleBuffers get_piece(const Particles& particles, const Piece& piece);
  compute::buffer buffer_of(const Column& column, std::size_t values_per_particle,
                            const Piece& piece, float value_if_absent, int& stride);
  compute::buffer buffer_of(const Column& column, float value_if_absent, int& stride);
  compute::buffer streamed_buffer(const ColumnSource& source, std::size_t values_per_particle,
                                  const Piece& piece);
  void list_seen(const Particles& particles, const Piece& chunk, const ViewBounds* bounds);
  void make_room(std::size_t bytes);
  compute::buffer constant(float value);
  compute::buffer new_constant(float value) const;
  // That of an entry, which is wanted by this frame then; null where there is none.
  const compute::buffer* find(const Key& key);
  compute::buffer keep(const Key& key, std::shared_ptr<const void> owner);
  compute::buffer buffer_of(const std::vector<std::uint32_t>& places,
                            const std::shared_ptr<const IdMatch>& match);
  compute::buffer ordered_buffer(const Column& second, int values_per_particle,
                                 const std::shared_ptr<const IdMatch>& match, int& stride);
  compute::buffer interpolated_buffer(const std::shared_ptr<const InterpolatedColumn>& column);
  void require_room(std::size_t bytes) const;
  Entry new_or_stale(Kind kind, std::size_t bytes);

  DeviceContext& device_;
  bool columns_stay_;
  std::map<Key, Entry> entries_;
  std::map<std::uint32_t, Constant> constants_;  // by the bits of their value
  std::vector<Buffer<float>> streamed_;          // of the last chunk
  LargeVector<float> streamed_values_;           // room for a column's, on their way to the device
  std::vector<Piece> seen_;                      // stretches of it that are in view
  BlockBoxes boxes_;
  std::uint64_t device_bytes_ = 0;
  std::uint64_t frame_ = 0;
  std::uint64_t uses_ = 0;
};

// What kernels that read columns of particles take (kernels/project/load.cl): the strides, among
// the parameters, and the buffers, from positions to sort fields. The particles' own colors are an
// argument of their own, where a component has some.
void set_strides(const ParticleBuffers& particles, shared::ProjectLaunch& launch);
Launch& pass_columns(Launch& launch, const ParticleBuffers& particles);

}  // namespace splotchcl
