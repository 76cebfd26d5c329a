#include "load/periodic_wrap.h"

#include <vector>

#include "load/component_boxes.h"
#include "parallel/for_blocks.h"
#include "scene/streamed_column.h"
#include "splotchcl/error.h"

namespace splotchcl {

BoxSides periodic_box(const PeriodicSettings& settings, const SnapshotInfo& snapshot) {
  if (settings.box) return *settings.box;
  if (snapshot.box_size) return *snapshot.box_size;
  throw UsageError("key periodic.wrap: found true, but " +
                   (snapshot.files.empty() ? "the snapshot" : snapshot.files.front().string()) +
                   " does not say the size of a box, expected one; set periodic.box");
}

bool is_in_the_box(const Component& component) {
  return component.snapshot.empty() && !component.placement.moves();
}

void wrap_around(const Vec3& center, const BoxSides& box, Particles& particles, bool streams) {
  const Column& position = particles.position;
  if (!position.is_array()) return;
  const Vec3 shift = particles.origin - center;  // from stored positions to distances from it
  const auto wrap = [position, shift, box](std::size_t begin, std::size_t end, float* out) {
    const ColumnStretch stretch(position, begin, end);
    for (std::size_t i = begin; i < end; ++i) {
      const double distance = static_cast<double>(stretch[i]) + shift.a[i % 3];
      *out++ = static_cast<float>(nearest_image(distance, box[i % 3]));
    }
  };
  if (streams || is_streamed(position)) {
    particles.position = make_column(position.size(), true, wrap);
  } else {
    std::vector<float> wrapped(position.size());
    for_blocks(position.size(), 3 << 16, [&](std::size_t begin, std::size_t end) {
      wrap(begin, end, wrapped.data() + begin);
    });
    particles.position = Column::owning(std::move(wrapped));
  }
  if (particles.boxes) particles.boxes = wrapped_boxes(*particles.boxes, shift, box);
  particles.origin = center;
}

}  // namespace splotchcl
