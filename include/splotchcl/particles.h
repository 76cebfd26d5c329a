#pragma once

#include <array>
#include <cstddef>
#include <memory>
#include <utility>
#include <vector>

#include "splotchcl/vector.h"

namespace splotchcl {

class Column;

// What makes the values of a column when they are first wanted. Devices make those of the kinds
// that they know by themselves, to the same bits, so that the host need not.
class ColumnSource {
 public:
  virtual ~ColumnSource() = default;
  virtual std::size_t size() const = 0;  // values
  // Values [begin, end); each is the same however it is asked for. Several threads may ask.
  virtual void make(std::size_t begin, std::size_t end, float* values) const = 0;
  virtual Column make_all() const;
  // All of them are too many to be held: who can asks for them stretch by stretch.
  virtual bool is_streamed() const { return false; }
  // They lie somewhere as they are: who wants few copies these, and not all.
  virtual bool is_copy() const { return false; }
};

// Values of one quantity: one per particle, one for all, or none at all.
// The memory may be a vector, a mapped file, or a simulation's own array; whoever
// owns it is kept alive by the column. Copies are cheap and share the memory.
class Column {
 public:
  Column() = default;  // absent

  // One value for all.
  static Column uniform(float value) {
    Column column;
    column.uniform_ = value;
    column.is_uniform_ = true;
    return column;
  }
  // These values, one after the other.
  static Column owning(std::vector<float> values) {
    auto owner = std::make_shared<const std::vector<float>>(std::move(values));
    const float* data = owner->data();
    const std::size_t size = owner->size();
    return Column(std::move(owner), data, size);
  }
  // `owner` (may be null for memory that outlives the column) keeps `data` alive.
  Column(std::shared_ptr<const void> owner, const float* data, std::size_t size)
      : owner_(std::move(owner)), data_(data), size_(size), is_array_(true) {}
  // An array whose values are made when they are first wanted: all at once for data(), one by one
  // for [], until so many have been that all are made. Copies share them. Several threads may ask.
  static Column made_by(std::shared_ptr<const ColumnSource> source);

  bool is_absent() const { return !is_uniform_ && !is_array_; }
  bool is_uniform() const { return is_uniform_; }
  bool is_array() const { return is_array_; }
  // Of a uniform column.
  float uniform_value() const { return uniform_; }
  const float* data() const { return is_made_ ? made() : data_; }  // of an array, else null
  std::size_t size() const { return size_; }  // values in the array, 0 otherwise
  // Value i of an array, else the uniform one; of an absent column 0.
  float operator[](std::size_t i) const {
    return is_made_ ? made(i) : is_array_ ? data_[i] : uniform_;
  }
  // Of made_by(), else null.
  std::shared_ptr<const ColumnSource> source() const;

 private:
  const float* made() const;
  float made(std::size_t i) const;

  std::shared_ptr<const void> owner_;
  const float* data_ = nullptr;
  std::size_t size_ = 0;
  float uniform_ = 0;
  bool is_uniform_ = false;
  bool is_array_ = false;
  bool is_made_ = false;  // the owner is what makes the values
};

// A box around particles, as their column of positions has them, and the largest of their smoothing
// lengths. Of none: lower above upper.
struct ParticleBox {
  float lower[3], upper[3];
  float largest_smoothing_length;
};

// Boxes around particles that follow each other, block by block: known before their values are
// read, so that those out of view need not be (docs/large.md, An index).
struct ParticleBoxes {
  std::size_t block_particles = 1;
  std::vector<ParticleBox> boxes;

  // Around the blocks that particles [first, end) lie in.
  ParticleBox around(std::size_t first, std::size_t end) const;
};

class TreeOfComponent;

// The particles of one component: structure of arrays, as the device takes them. Columns are
// arrays of `count` values, or as said, or uniform where one value serves all. Only what the
// scene needs is present. Lengths, masses and densities are in the snapshot's units. A particle
// is bad, left out of every picture and counted, where a value of it is not finite, its
// smoothing length not above 0, its weight or a channel of its own color below 0.
struct Particles {
  std::size_t count = 0;
  Vec3 origin = {{0, 0, 0}};  // true position = origin + position, added in double
  Column position;            // 3 * count: x y z of each particle, relative to origin
  Column smoothing_length;    // h, the kernel's support radius, > 0
  Column weight;  // mass or density, as WeightModel says; for constant a factor, absent: 1
  Column color;   // the palette's scalar before scaling; absent: position 0
  // 3 * count: red, green, blue of each particle, >= 0, factors on the palette's emission
  // and on what it absorbs, unless the palette has absorption of its own. Absent: 1 1 1.
  Column color_vector;
  Column intensity;                            // the intensity field before scaling; absent: 1
  Column sort_field;                           // only when the scene sorts by a field
  std::shared_ptr<const ParticleBoxes> boxes;  // null: not known
  // The same particles, merged (docs/tree.md); null: there is no tree, or it serves no such scene.
  std::shared_ptr<const TreeOfComponent> tree;

  // All of them, present or not.
  std::array<const Column*, 7> columns() const {
    return {&position, &smoothing_length, &weight, &color, &color_vector, &intensity, &sort_field};
  }
};

}  // namespace splotchcl
