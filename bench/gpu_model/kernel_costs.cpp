#include "gpu_model/kernel_costs.h"

#include <algorithm>
#include <cmath>
#include <map>

#include "device/frame/shared.h"
#include "splotchcl/error.h"

namespace splotchcl::bench {
namespace {

constexpr double word = 4;
constexpr double group = GROUP_ITEMS;
// What one gather of a splat brings along.
constexpr double sector = 32;
constexpr double scan_steps = 8, scan_barriers = 18;  // in a group of 256 items
// Of a batch of 32 splats (tile_batch.cl).
constexpr double batch = 32, axes = 32, parts = 8;

// All launches of one kernel.
struct Launches {
  double items, count;
  const FrameWork& work;
  double groups() const { return items / group; }
};
using Cost = KernelCost (*)(const Launches&);

// Structures begin at any word, but those of as many bytes as a sector.
double gathered(double bytes) {
  if (std::fmod(bytes, sector) == 0) return bytes;
  return sector * (1 + (bytes - word) / sector);
}

// Two passes over all particles, of which the second writes splats. Counted with Oclgrind, a
// particle takes some 500 operations.
KernelCost project(const Launches& l) {
  const double keys = l.work.is_ordered ? 10 : 0;
  KernelCost cost;
  cost.bytes_read = l.items * l.work.particle_bytes + 2 * word * l.groups();
  cost.bytes_written = l.work.splats * (l.work.splat_bytes + keys) + word * l.groups();
  cost.operations = l.items * 500;
  cost.chain = l.work.splats_per_particle + scan_steps;
  cost.barriers = static_cast<int>(scan_barriers) + 1;
  return cost;
}

KernelCost scan_reduce(const Launches& l) {
  return {l.items * SCAN_VALUES_OF_ITEM * word, l.groups() * word, l.items * 70,
          SCAN_VALUES_OF_ITEM + scan_steps, static_cast<int>(scan_barriers)};
}

// Every group adds up the sums of those before it, of 2048 at most.
KernelCost scan_stretches(const Launches& l) {
  const double groups_before = 0.5 * l.groups() / l.count;
  return {l.items * SCAN_VALUES_OF_ITEM * word + l.groups() * groups_before * word,
          l.items * SCAN_VALUES_OF_ITEM * word, l.items * 160,
          3 * SCAN_VALUES_OF_ITEM + 2 * scan_steps, static_cast<int>(2 * scan_barriers)};
}

KernelCost sort_count(const Launches& l) {
  return {l.items * SORT_PAIRS_OF_ITEM * word, l.items * word, l.items * 70, SORT_PAIRS_OF_ITEM, 2};
}

// Two splits by four bits, each of which counts, scans and moves.
KernelCost sort_scatter(const Launches& l) {
  const double pairs = l.items * SORT_PAIRS_OF_ITEM;
  return {pairs * 2 * word + l.items * word, pairs * 2 * word, l.items * 900,
          3 * SORT_PAIRS_OF_ITEM + 2 * (2 * SORT_PAIRS_OF_ITEM + 48 + scan_steps),
          2 * (3 + static_cast<int>(scan_barriers)) + 3};
}

KernelCost sort_range(const Launches& l) {
  return {l.items * SORT_PAIRS_OF_ITEM * word, 0, l.items * 70, SORT_PAIRS_OF_ITEM, 2};
}

KernelCost sort_join_ends(const Launches& l) {
  return {l.items * 6, l.items * word, l.items * 12, 1, 0};
}

// Runs are rare: what they cost is not counted.
KernelCost sort_short_runs(const Launches& l) {
  return {l.items * 2 * word, 0, l.items * 12, SORT_SHORT_RUN * SORT_SHORT_RUN, 0};
}

KernelCost sort_take_ends(const Launches& l) {
  return {l.items * (word + sector), l.items * 2 * word, l.items * 10, 1, 0};
}

KernelCost sort_take_pairs(const Launches& l) {
  return {l.items * (word + 2 * sector), l.items * 2 * word, l.items * 10, 1, 0};
}

// A slot's splat is gathered where it was sorted; counts are added to in the cache.
KernelCost bin_find_tiles(const Launches& l) {
  const double splat = l.work.is_ordered ? word + gathered(l.work.splat_bytes) : l.work.splat_bytes;
  return {l.work.splats * splat, l.work.splats * (sizeof(shared::SplatTiles) + 2 * word),
          l.items * 150, FEW_TILES, 0};
}

KernelCost bin_add_counts(const Launches& l) {
  return {l.items * COPIES_OF_COUNTS * word, l.items * word, l.items * 2 * COPIES_OF_COUNTS,
          COPIES_OF_COUNTS, 0};
}

KernelCost bin_count_entries(const Launches& l) {
  return {l.items * sizeof(shared::SplatTiles), l.items * word, l.items * 30, 1, 0};
}

// Neighbors have the same slot or the next one, so that a group reads its slots once, and in a
// search for each of its ends a sector for each step. Then items search between these, in the
// cache.
KernelCost bin_emit(const Launches& l) {
  const double steps = std::ceil(std::log2(std::max(2.0, l.work.chunk)));
  const double in_group = std::log2(group);
  return {(l.work.splats + l.groups()) * (sizeof(shared::SplatTiles) + 2 * word) +
              l.groups() * 2 * steps * sector,
          l.work.entries * 2 * word, l.items * (60 + 10 * in_group) + l.groups() * 32 * 10 * steps,
          steps + in_group, 1};
}

KernelCost bin_make_entries(const Launches& l) {
  return {l.work.entries * (2 * word + gathered(l.work.splat_bytes)),
          l.work.entries * l.work.entry_bytes, l.items * 250, 1 + l.work.entry_bytes / word, 1};
}

// What a group does for a batch of 8 splats of extended numbers: each of its 32 items takes eight
// pixels of each splat.
KernelCost composite_extended(const Launches& l) {
  const double pixels = l.items * 8 * l.work.planes * word;
  const double longest = std::min(l.work.segment_length, l.work.longest_list);
  KernelCost cost;
  cost.bytes_read = l.work.entries * (word + gathered(l.work.extended_splat_bytes)) + pixels;
  cost.bytes_written = pixels;
  cost.operations = l.work.entries * (axes * 1000 + group * 300);
  cost.chain = longest * (1 + 1.0 / 8 + 1);
  cost.barriers = static_cast<int>(3 * std::ceil(longest / 8));
  return cost;
}

// Per entry both axes, which parts of the tile it touches, and its fetch; per part and pixel which
// splat is next (5), its axes (5), its light (4) and its layer: each of three channels, what is
// not thin with what decides that and whether it is there at all (6). An operation of local memory
// counts as any other.
KernelCost composite(const Launches& l) {
  if (l.work.is_extended) return composite_extended(l);
  const FrameWork& work = l.work;
  const double pixels = l.items * work.planes * word;
  const double plain_entries = work.entries - work.mean_entries - work.bright_entries;
  const double of_pixel = 5 + 5 + 4;
  const double of_layers = work.thin_parts * (work.is_ordered ? 1 + 3 * 4 : 3) +
                           work.series_parts * (6 + 3 * 12) + work.full_parts * (6 + 3 * 40) +
                           work.slab_parts * 6;
  KernelCost cost;
  cost.bytes_read = work.entries * work.entry_bytes + pixels;
  cost.bytes_written = pixels;
  cost.operations =
      axes * (plain_entries * 26 + work.mean_entries * 59 + work.bright_entries * 120) +
      work.entries * (parts * 25 + 80 + work.entry_bytes / word * 5) +
      32 * (work.drawn_parts() * of_pixel + of_layers) + work.entries / batch * group * 40;
  // Rounds over its splats, and of each batch those of its own.
  cost.chain = std::min(work.segment_length, work.longest_list) * (1 + 6 / batch);
  cost.barriers = static_cast<int>(4 * std::ceil(cost.chain / batch)) + 3;
  return cost;
}

// The stretches that one cut list has in a chunk, at most.
double most_segments(const FrameWork& work) {
  return std::max(1.0, std::ceil(work.longest_list / work.segment_length));
}

// Only what is cut is joined.
KernelCost join(const Launches& l) {
  const double of_stretch = l.work.tile_pixels * l.work.planes * word;
  return {l.work.partial_tiles * 2 * of_stretch, l.work.partial_tiles * of_stretch,
          l.work.partial_tiles * l.work.tile_pixels * 60, most_segments(l.work), 0};
}

// What an entry adds; for each batch of 256 a look at 8 words of each of 256 cells. A splat counts
// in one of its tiles: two bits there, and where all of a batch add to one cell, 32 items wait for
// the one that adds them up: that is counted, for peaks and for endings.
KernelCost collect(const Launches& l) {
  const double cells = l.items * word;
  const double longest = std::min(l.work.segment_length, l.work.longest_list);
  return {l.work.entries * l.work.entry_bytes + cells, cells,
          l.work.entries * (120 + 8 * 5) + l.work.splats * (10 + 2 * 32 * 5),
          longest * (1 + 9 / group), static_cast<int>(2 * std::ceil(longest / group)) + 1};
}

KernelCost collect_segments(const Launches& l) {
  const double cells = l.work.partial_tiles * group;
  return {2 * cells * word, cells * word, cells * 8, most_segments(l.work), 0};
}

// Work-items take eight pixels. Weights of a blur are at most MOST_BLUR_WEIGHTS, and neighbors
// share what they read.
KernelCost blur(const Launches& l) {
  return {l.items * 8 * word * 2, l.items * 8 * word, l.items * 8 * 20, MOST_BLUR_WEIGHTS, 0};
}

KernelCost refine_columns(const Launches& l) {
  return {l.items * 8 * word * 2, l.items * 8 * word * 2, l.items * 8 * 25, 10, 0};
}

// Two rows of eight pixels, as lay_slab.
KernelCost refine_rows(const Launches& l) {
  return {2 * l.items * 8 * word * 2, 2 * l.items * 8 * word * 2, 2 * l.items * 8 * 25, 11, 0};
}

// Sums interpolated by ten weights, of which neighbors share the rows, and laid among what is
// there.
KernelCost lay_slab(const Launches& l) {
  const double planes = 2 * l.items * 8 * word * 6;
  return {planes * 2.5, planes * 2, 2 * l.items * 8 * 3 * 90, 3 * 11, 0};
}

KernelCost resolve(const Launches& l) {
  return {l.items * 8 * word * l.work.planes, l.items * 8 * word * 4, l.items * 8 * 40, 8, 0};
}

const std::map<std::string, Cost>& costs() {
  static const std::map<std::string, Cost> all = {{"project", project},
                                                  {"scan_reduce", scan_reduce},
                                                  {"scan_stretches", scan_stretches},
                                                  {"sort_count", sort_count},
                                                  {"sort_scatter", sort_scatter},
                                                  {"sort_range", sort_range},
                                                  {"sort_join_ends", sort_join_ends},
                                                  {"sort_short_runs", sort_short_runs},
                                                  {"sort_take_ends", sort_take_ends},
                                                  {"sort_take_pairs", sort_take_pairs},
                                                  {"bin_find_tiles", bin_find_tiles},
                                                  {"bin_add_counts", bin_add_counts},
                                                  {"bin_count_entries", bin_count_entries},
                                                  {"bin_emit", bin_emit},
                                                  {"bin_make_entries", bin_make_entries},
                                                  {"composite", composite},
                                                  {"join", join},
                                                  {"join_extended", join},
                                                  {"collect", collect},
                                                  {"collect_segments", collect_segments},
                                                  {"blur_columns", blur},
                                                  {"blur_rows", blur},
                                                  {"refine_columns", refine_columns},
                                                  {"refine_rows", refine_rows},
                                                  {"lay_slab", lay_slab},
                                                  {"resolve", resolve}};
  return all;
}

}  // namespace

KernelCost cost_of(const std::string& kernel, double items, double launches,
                   const FrameWork& work) {
  const auto found = costs().find(kernel);
  if (found == costs().end()) {
    throw UsageError("the model knows no kernel " + kernel +
                     ": add what it costs to bench/gpu_model/kernel_costs.cpp");
  }
  return found->second({items, launches, work});
}

std::set<std::string> known_kernels() {
  std::set<std::string> names;
  for (const auto& [name, cost] : costs())
    names.insert(name);
  return names;
}

double longest_chain(const std::string& kernel, const FrameWork& work) {
  // Of a sort's scatter, of a short run of equal keys, and of the weights of a blur.
  constexpr double of_any_frame = SORT_SHORT_RUN * SORT_SHORT_RUN;
  const double largest = std::max(
      {2.0, work.particles * work.splats_per_particle, work.entries, work.tiles, work.pixels});
  double of_chunk = 0;
  if (kernel == "composite" || kernel == "collect")
    of_chunk = 2.5 * work.segment_length;
  else if (kernel == "join" || kernel == "join_extended" || kernel == "collect_segments")
    of_chunk = work.chunk / work.segment_length;
  return of_any_frame + 2 * std::log2(largest) + of_chunk;
}

}  // namespace splotchcl::bench
