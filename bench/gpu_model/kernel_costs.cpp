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
// Of a batch of 32 splats (composite_groups.cl).
constexpr double batch = 32, axes = 32, parts = 8;

// All launches of one kernel.
struct Launches {
  double items, count;
  const FrameWork& work;
  double groups() const { return items / group; }
};
using Cost = KernelCost (*)(const Launches&);

double gathered(double bytes) {
  return sector * std::ceil((bytes + sector / 2) / sector);
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

KernelCost scan_stretches(const Launches& l) {
  return {l.items * SCAN_VALUES_OF_ITEM * word, l.items * SCAN_VALUES_OF_ITEM * word, l.items * 110,
          2 * SCAN_VALUES_OF_ITEM + scan_steps, static_cast<int>(scan_barriers)};
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

KernelCost bin_count_entries(const Launches& l) {
  return {l.items * sizeof(shared::SplatTiles), l.items * word, l.items * 60, 1, 0};
}

// The first steps of the search, and those around a group's own entries, are in the cache.
KernelCost bin_emit(const Launches& l) {
  const double steps = std::ceil(std::log2(std::max(2.0, l.work.chunk)));
  return {l.work.entries * (sizeof(shared::SplatTiles) + 3 * word), l.work.entries * 2 * word,
          l.items * (60 + 10 * steps), steps, 0};
}

KernelCost bin_make_entries(const Launches& l) {
  return {l.work.entries * (2 * word + gathered(l.work.splat_bytes)),
          l.work.entries * l.work.entry_bytes, l.items * 250, 1 + l.work.entry_bytes / word, 1};
}

// Per entry both axes, which parts of the tile it touches, and its fetch; per part and pixel the
// layer: three channels of five operations, or of one, and what is read of local memory.
KernelCost composite(const Launches& l) {
  const double of_pixel = l.work.is_ordered ? 33 : 17;
  const double pixels = l.items * l.work.planes * word;
  KernelCost cost;
  cost.bytes_read = l.work.entries * l.work.entry_bytes + pixels;
  cost.bytes_written = pixels;
  cost.operations = l.work.entries * (axes * 40 + parts * 25 + l.work.entry_bytes / word * 5) +
                    l.work.drawn_parts * 32 * of_pixel + l.work.entries / batch * group * 40;
  // Rounds over its splats, and of each batch those of its own.
  cost.chain = std::min(l.work.segment_length, l.work.longest_list) * (1 + 6 / batch);
  cost.barriers = static_cast<int>(4 * std::ceil(cost.chain / batch)) + 3;
  return cost;
}

// Only what is cut is joined; in frames with some such lists that is little.
double cut_segments(const FrameWork& work) {
  return std::max(1.0, std::ceil(work.longest_list / work.segment_length));
}

KernelCost join(const Launches& l) {
  const double pixels = l.items * l.work.planes * word;
  return {2 * pixels, pixels, l.items * 60, cut_segments(l.work), 0};
}

// A step per splat of a batch of 256, for each of 256 cells.
KernelCost collect(const Launches& l) {
  const double cells = l.items * word;
  const double longest = std::min(l.work.segment_length, l.work.longest_list);
  return {l.work.entries * l.work.entry_bytes + cells, cells, l.work.entries * (120 + group * 4),
          longest * (1 + 1 / group), static_cast<int>(2 * std::ceil(longest / group))};
}

KernelCost collect_segments(const Launches& l) {
  return {2 * l.items * word, l.items * word, l.items * 8, cut_segments(l.work), 0};
}

// Work-items take eight pixels. Weights of a blur are at most MOST_BLUR_WEIGHTS, and neighbors
// share what they read.
KernelCost blur(const Launches& l) {
  return {l.items * 8 * word * 2, l.items * 8 * word, l.items * 8 * 20, MOST_BLUR_WEIGHTS, 0};
}

KernelCost refine(const Launches& l) {
  return {l.items * 8 * word * 2, l.items * 8 * word * 2, l.items * 8 * 25, 10, 0};
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
                                                  {"bin_count_entries", bin_count_entries},
                                                  {"bin_emit", bin_emit},
                                                  {"bin_make_entries", bin_make_entries},
                                                  {"composite", composite},
                                                  {"join", join},
                                                  {"collect", collect},
                                                  {"collect_segments", collect_segments},
                                                  {"blur_columns", blur},
                                                  {"blur_rows", blur},
                                                  {"refine_columns", refine},
                                                  {"refine_rows", refine},
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

}  // namespace splotchcl::bench
