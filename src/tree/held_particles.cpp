#include "tree/held_particles.h"

#include <algorithm>
#include <mutex>

namespace splotchcl {

CellCounts count_cells(const TreeSource& source, const TreeCube& cube, int level) {
  const std::size_t cells = std::size_t{1} << (3 * level);
  CellCounts counts;
  counts.particles.resize(cells);
  counts.of_stretches.resize(stretches_of(source));
  std::mutex of_counts;
  for_source(source, [&](const TreeStretch& stretch, std::size_t begin, std::size_t end) {
    std::vector<std::uint32_t> own(cells, 0);
    CellCounts::Range range = {cells, 0};
    for (std::size_t i = begin; i < end; ++i) {
      if (!stretch.is_good(i)) continue;
      const std::size_t cell = cell_at(morton_key(stretch.place(i, cube)), level);
      ++own[cell];
      range.first = std::min(range.first, cell);
      range.end = std::max(range.end, cell + 1);
    }
    counts.of_stretches[begin / streamed_particles] = range;
    const std::lock_guard lock(of_counts);
    for (std::size_t cell = range.first; cell < range.end; ++cell)
      counts.particles[cell] += own[cell];
  });
  return counts;
}

HeldParticles hold(const TreeSource& source, const TreeCube& cube, int level,
                   const CellCounts& counts, std::size_t first, std::size_t last) {
  const std::size_t stretches = stretches_of(source);
  std::vector<std::vector<KeyedParticle>> found(stretches);
  const auto may_have_some = [&](std::size_t s) {
    return counts.of_stretches[s].meets(first, last);
  };
  for_some_stretches(source, may_have_some,
                     [&](const TreeStretch& stretch, std::size_t begin, std::size_t end) {
                       std::vector<KeyedParticle>& own = found[begin / streamed_particles];
                       for (std::size_t i = begin; i < end; ++i) {
                         if (!stretch.is_good(i)) continue;
                         const std::uint64_t key = morton_key(stretch.place(i, cube));
                         const std::size_t cell = cell_at(key, level);
                         if (cell >= first && cell < last)
                           own.push_back({key, static_cast<std::uint32_t>(i)});
                       }
                     });
  std::vector<std::size_t> begins(stretches + 1, 0);
  for (std::size_t s = 0; s < stretches; ++s)
    begins[s + 1] = begins[s] + found[s].size();
  HeldParticles held;
  const std::size_t size = begins[stretches];
  held.keyed.resize(size);
  held.place.resize(size);
  held.position.resize(size);
  held.h.resize(size);
  held.flux.resize(size);
  held.values.resize(size * source.fields.size());
  const auto has_some = [&](std::size_t s) { return !found[s].empty(); };
  for_some_stretches(
      source, has_some, [&](const TreeStretch& stretch, std::size_t begin, std::size_t) {
        const std::size_t s = begin / streamed_particles;
        for (std::size_t f = 0; f < found[s].size(); ++f) {
          const std::size_t to = begins[s] + f, i = found[s][f].place;
          held.keyed[to] = {found[s][f].key, static_cast<std::uint32_t>(to)};
          held.place[to] = found[s][f].place;
          for (std::size_t axis = 0; axis < 3; ++axis)
            held.position[to][axis] = stretch.position(i, axis);
          held.h[to] = static_cast<float>(stretch.h(i));
          held.flux[to] = stretch.flux(i);
          const MemberValues values = stretch.values(i);
          std::copy_n(values.begin(), source.fields.size(),
                      held.values.begin() + static_cast<std::ptrdiff_t>(to * source.fields.size()));
        }
      });
  sort_by_key(held.keyed);
  return held;
}

}  // namespace splotchcl
