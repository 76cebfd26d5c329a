#include "load/spread_sizes.h"

#include <fmt/format.h>

#include <cstddef>
#include <utility>
#include <vector>

#include "scene/streamed_column.h"
#include "smoothing/smoothing_lengths.h"
#include "splotchcl/error.h"

namespace splotchcl {
namespace {

// In the memory of each rank.
Column held(const Column& column) {
  std::vector<float> values(column.size());
  for_stretches(values.size(), [&](std::size_t begin, std::size_t end) {
    column.source()->make(begin, end, values.data() + begin);
  });
  return Column::owning(std::move(values));
}

}  // namespace

Column find_spread_sizes(SpreadParticles& spread, int type, const Column& own_position,
                         std::uint64_t first, const MissingSizes& how,
                         const std::optional<BoxSides>& periodic_box) {
  const std::size_t own_count = own_position.size() / 3;
  const Column of_all = spread.spread(own_position, own_count, 3);
  const std::size_t count = of_all.size() / 3;
  if (count > most_spread_neighbors) {
    throw DataError(fmt::format(
        "found {} particles of type {} without smoothing lengths, expected at most {} for a search "
        "of neighbours among particles that are spread over processes, which each of them holds; "
        "set the field smoothing_length, or density and mass, or size.fixed",
        count, type, most_spread_neighbors));
  }
  const Column position = held(of_all);
  const Column lengths = find_smoothing_lengths(position, count, periodic_box, how.neighbors, {},
                                                search_share(&spread.ranks()));
  const auto begin = static_cast<std::size_t>(first);
  std::vector<float> own(own_count);
  for (std::size_t i = 0; i < own_count; ++i)
    own[i] = lengths[begin + i];
  return Column::owning(std::move(own));
}

}  // namespace splotchcl
