#include "tree/held_particles.h"

#include <algorithm>
#include <mutex>

namespace splotchcl {

std::vector<std::uint64_t> count_cells(const TreeSource& source, const TreeCube& cube, int level) {
  const std::size_t cells = std::size_t{1} << (3 * level);
  std::vector<std::uint64_t> counts(cells, 0);
  std::mutex of_counts;
  for_source(source, [&](const TreeStretch& stretch, std::size_t begin, std::size_t end) {
    std::vector<std::uint32_t> own(cells, 0);
    for (std::size_t i = begin; i < end; ++i) {
      if (stretch.is_good(i)) ++own[cell_at(morton_key(stretch.place(i, cube)), level)];
    }
    const std::lock_guard lock(of_counts);
    for (std::size_t cell = 0; cell < cells; ++cell)
      counts[cell] += own[cell];
  });
  return counts;
}

HeldParticles hold(const TreeSource& source, const TreeCube& cube, int level, std::size_t first,
                   std::size_t last, std::uint64_t count) {
  const std::size_t stretches =
      ceil_divide(static_cast<std::size_t>(source.count), streamed_particles);
  std::vector<std::vector<KeyedParticle>> found(stretches);
  for_source(source, [&](const TreeStretch& stretch, std::size_t begin, std::size_t end) {
    std::vector<KeyedParticle>& own = found[begin / streamed_particles];
    for (std::size_t i = begin; i < end; ++i) {
      if (!stretch.is_good(i)) continue;
      const std::uint64_t key = morton_key(stretch.place(i, cube));
      const std::size_t cell = cell_at(key, level);
      if (cell >= first && cell < last) own.push_back({key, static_cast<std::uint32_t>(i)});
    }
  });
  std::vector<std::size_t> begins(stretches + 1, 0);
  for (std::size_t s = 0; s < stretches; ++s)
    begins[s + 1] = begins[s] + found[s].size();
  HeldParticles held;
  const auto size = static_cast<std::size_t>(count);
  held.keyed.resize(size);
  held.place.resize(size);
  held.position.resize(size);
  held.h.resize(size);
  held.flux.resize(size);
  held.values.resize(size * source.fields.size());
  for_source(source, [&](const TreeStretch& stretch, std::size_t begin, std::size_t) {
    const std::size_t s = begin / streamed_particles;
    for (std::size_t f = 0; f < found[s].size(); ++f) {
      const std::size_t to = begins[s] + f, i = found[s][f].place;
      held.keyed[to] = {found[s][f].key, static_cast<std::uint32_t>(to)};
      held.place[to] = found[s][f].place;
      for (std::size_t axis = 0; axis < 3; ++axis)
        held.position[to][axis] = stretch.position(i, axis);
      held.h[to] = static_cast<float>(stretch.h(i));
      held.flux[to] = stretch.flux(i);
      const FieldValues values = stretch.values(i);
      std::copy_n(values.begin(), source.fields.size(),
                  held.values.begin() + static_cast<std::ptrdiff_t>(to * source.fields.size()));
    }
  });
  sort_by_key(held.keyed);
  return held;
}

}  // namespace splotchcl
