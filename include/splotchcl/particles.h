#pragma once

#include <cstddef>
#include <memory>
#include <utility>
#include <vector>

#include "splotchcl/vector.h"

namespace splotchcl {

// Values of one quantity: one per particle, one for all, or none at all.
// The memory may be a vector, a mapped file, or a simulation's own array; whoever
// owns it is kept alive by the column. Copies are cheap and share the memory.
class Column {
 public:
  Column() = default;  // absent

  static Column uniform(float value) {
    Column column;
    column.uniform_ = value;
    column.is_uniform_ = true;
    return column;
  }
  static Column owning(std::vector<float> values) {
    auto owner = std::make_shared<const std::vector<float>>(std::move(values));
    const float* data = owner->data();
    const std::size_t size = owner->size();
    return Column(std::move(owner), data, size);
  }
  // `owner` (may be null for memory that outlives the column) keeps `data` alive.
  Column(std::shared_ptr<const void> owner, const float* data, std::size_t size)
      : owner_(std::move(owner)), data_(data), size_(size), is_array_(true) {}

  bool is_absent() const { return !is_uniform_ && !is_array_; }
  bool is_uniform() const { return is_uniform_; }
  bool is_array() const { return is_array_; }
  float uniform_value() const { return uniform_; }
  const float* data() const { return data_; }
  std::size_t size() const { return size_; }  // values in the array, 0 otherwise
  float operator[](std::size_t i) const { return is_array_ ? data_[i] : uniform_; }

 private:
  std::shared_ptr<const void> owner_;
  const float* data_ = nullptr;
  std::size_t size_ = 0;
  float uniform_ = 0;
  bool is_uniform_ = false;
  bool is_array_ = false;
};

// The particles of one component: structure of arrays, as the device takes them.
// Only what the scene needs is present.
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
  Column intensity;   // the intensity field before scaling; absent: 1
  Column sort_field;  // only when the scene sorts by a field
};

}  // namespace splotchcl
