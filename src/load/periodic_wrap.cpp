#include "load/periodic_wrap.h"

#include <cmath>
#include <vector>

#include "parallel/for_blocks.h"
#include "splotchcl/error.h"

namespace splotchcl {

double periodic_box(const PeriodicSettings& settings, const SnapshotInfo& snapshot) {
  const double box = settings.box.value_or(snapshot.box_size.value_or(0));
  if (box > 0 && std::isfinite(box)) return box;
  throw UsageError("key periodic.wrap: found true, but " +
                   (snapshot.files.empty() ? "the snapshot" : snapshot.files.front().string()) +
                   " does not say the size of a box, expected one; set periodic.box");
}

bool is_in_the_box(const Component& component) {
  return component.snapshot.empty() && !component.placement.moves();
}

void wrap_around(const Vec3& center, double box, Particles& particles) {
  const Column& position = particles.position;
  if (!position.is_array()) return;
  std::vector<float> wrapped(position.size());
  double shift[3];  // from stored positions to distances from the center
  for (std::size_t axis = 0; axis < 3; ++axis)
    shift[axis] = particles.origin.a[axis] - center.a[axis];
  const auto wrap = [&](std::size_t first, std::size_t last) {
    for (std::size_t i = 3 * first; i < 3 * last; ++i) {
      const double distance = static_cast<double>(position.data()[i]) + shift[i % 3];
      wrapped[i] = static_cast<float>(distance - box * std::nearbyint(distance / box));
    }
  };
  for_blocks(position.size() / 3, 1 << 16, wrap);
  particles.position = Column::owning(std::move(wrapped));
  particles.origin = center;
}

}  // namespace splotchcl
