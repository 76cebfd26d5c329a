#include "scene/picked_particles.h"

#include <algorithm>
#include <utility>

namespace splotchcl {
namespace {

Column picked(const Column& column, std::size_t width, const std::vector<std::uint64_t>& places) {
  if (!column.is_array() || column.size() == 0) return column;
  const auto source = column.source();
  std::vector<float> values(width * places.size());
  for (std::size_t k = 0; k < places.size(); ++k) {
    const std::size_t first = width * static_cast<std::size_t>(places[k]);
    float* const to = values.data() + width * k;
    if (source) {
      source->make(first, first + width, to);
    } else {
      std::copy_n(column.data() + first, width, to);
    }
  }
  return Column::owning(std::move(values));
}

}  // namespace

Particles picked_particles(const Particles& particles, const std::vector<std::uint64_t>& places) {
  Particles some = particles;
  some.count = places.size();
  some.boxes = nullptr;
  for (Column* const column : {&some.position, &some.color_vector})
    *column = picked(*column, 3, places);
  for (Column* const column :
       {&some.smoothing_length, &some.weight, &some.color, &some.intensity, &some.sort_field})
    *column = picked(*column, 1, places);
  return some;
}

}  // namespace splotchcl
