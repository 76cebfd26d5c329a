#include "device/stages/part_sorter.h"

#include <algorithm>
#include <utility>

#include "device/frame/specialization.h"
#include "device/opencl/launch.h"

namespace splotchcl {
namespace {

// How many splats each part has, of all blocks.
std::vector<std::uint64_t> count_splats(BufferPool& pool, const SplatParts& parts) {
  const std::size_t part_count = parts.keys.size();
  const std::vector<std::uint32_t> starts =
      pool.download(parts.first_slots, static_cast<std::size_t>(parts.first_slots.size()));
  std::vector<std::uint64_t> splats(part_count);
  for (std::size_t block = 0; block < parts.block_count; ++block) {
    const std::uint32_t* of_block = starts.data() + block * (part_count + 1);
    for (std::size_t part = 0; part < part_count; ++part)
      splats[part] += of_block[part + 1] - of_block[part];
  }
  return splats;
}

shared::PartOfKeys make_part(const KeyPart& keys, std::uint32_t first_place,
                             std::uint32_t first_scratch) {
  shared::PartOfKeys part{};
  part.first_key = static_cast<std::uint32_t>(keys.first);
  part.last_key = static_cast<std::uint32_t>(keys.end - 1);
  while (part.zeros < 31 && ((part.last_key - part.first_key) << part.zeros) >> 31 == 0)
    ++part.zeros;
  part.first_place = first_place;
  part.first_scratch = first_scratch;
  return part;
}

}  // namespace

// Some parts for each thread at a time: their scratch memory serves the next ones.
std::vector<PartSorter::Group> PartSorter::cut_in_groups(
    const std::vector<std::uint64_t>& splats_of_parts) const {
  const std::uint32_t at_a_time = parts_at_a_time(device_.traits);
  std::vector<Group> groups;
  for (std::uint32_t part = 0; part < splats_of_parts.size(); ++part) {
    if (part % at_a_time == 0) groups.push_back({part, part, 0});
    groups.back().end = part + 1;
    groups.back().splats += splats_of_parts[part];
  }
  return groups;
}

SortedSplats PartSorter::sort(KeyedSplats keyed) const {
  BufferPool& pool = device_.pool;
  const SplatParts& parts = *keyed.parts;
  const std::vector<std::uint64_t> splats = count_splats(pool, parts);
  const std::vector<Group> groups = cut_in_groups(splats);
  std::vector<shared::PartOfKeys> of_keys(splats.size());
  std::uint32_t place = 0;
  std::uint64_t most = 0;
  for (const Group& group : groups) {
    most = std::max(most, group.splats);
    const std::uint32_t first_place = place;
    for (std::uint32_t part = group.first; part < group.end; ++part) {
      of_keys[part] = make_part(parts.keys[part], place, place - first_place);
      place += static_cast<std::uint32_t>(splats[part]);
    }
  }
  const auto of_keys_buffer = pool.upload(of_keys, "parts of keys");
  const auto scratch = pool.get<std::uint64_t>(2 * most, "parts that are sorted");
  SortedSplats sorted;
  sorted.order = pool.get<std::uint32_t>(keyed.count, "order");
  shared::PartSortParameters parameters{};
  parameters.part_count = static_cast<std::uint32_t>(splats.size());
  parameters.block_count = parts.block_count;
  parameters.scratch_half = static_cast<std::uint32_t>(most);
  parameters.has_ends = keyed.key_ends.size() > 0;
  const Program program = device_.programs.get(Specialization::sort_parts());
  for (const Group& group : groups) {
    parameters.first_part = group.first;
    parameters.sorted_parts = group.end - group.first;
    Launch(device_, "sort", program.create_kernel("sort_parts"))
        .value(parameters)
        .arg(of_keys_buffer)
        .arg(parts.first_slots)
        .arg(keyed.keys)
        .arg(keyed.key_ends)
        .arg(scratch)
        .arg(sorted.order)
        .run_pieces(parameters.sorted_parts);
  }
  sorted.splats = std::move(keyed.splats);
  sorted.count = keyed.count;
  return sorted;
}

}  // namespace splotchcl
