// Clouds of nearly one place and width have their discs' ends in the same pixels. Clouds are
// collected in cells that are as wide as they are, half an octave of widths each, and a cell
// is held against the ring of cells where its clouds end: what counts is how much brighter it
// is than what it lies in, since in even light the ends of some fall on the middles of others.
#include "scene/plan/crowding.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <unordered_map>
#include <vector>

#include "scene/constants.h"
#include "scene/plan/cloud_sample.h"

namespace splotchcl {
namespace {

// Fewer are covered by the two dozen ends in one pixel that the budget has room for.
constexpr double fewest = 24;

// Of a sample: fewer may have met in a cell by chance.
constexpr int fewest_in_sample = 8;

// Light in one cell, relative to the ring around it, whose ends stay within the budget without
// more ado: discs end where a cloud has fallen to less than 2e-3 of its peak.
constexpr double harmless = 0.5;

struct Cell {
  std::int32_t level = 0, x = 0, y = 0;
  bool operator==(const Cell& other) const {
    return level == other.level && x == other.x && y == other.y;
  }
};

struct CellHash {
  std::size_t operator()(const Cell& cell) const {
    std::uint64_t hash = static_cast<std::uint32_t>(cell.x) * 0x9e3779b97f4a7c15ull;
    hash = (hash ^ static_cast<std::uint32_t>(cell.y)) * 0xbf58476d1ce4e5b9ull;
    hash = (hash ^ static_cast<std::uint32_t>(cell.level)) * 0x94d049bb133111ebull;
    return static_cast<std::size_t>(hash ^ (hash >> 31));
  }
};

struct Content {
  double light = 0;  // or depth, whichever is more: of all clouds, at their centres
  double count = 0;
  int samples = 0;
};

using Cells = std::unordered_map<Cell, Content, CellHash>;

Cell cell_of(const SampledCloud& cloud) {
  // Whatever is narrower than a pixel fills it.
  const double level = std::floor(2 * std::log2(std::max(cloud.sigma, 1.0)));
  const double side = std::exp2(0.5 * level);
  const double x = std::floor(cloud.x / side), y = std::floor(cloud.y / side);
  return {static_cast<std::int32_t>(level), static_cast<std::int32_t>(x),
          static_cast<std::int32_t>(y)};
}

Cells collect(const std::vector<SampledCloud>& sample) {
  Cells cells;
  for (const SampledCloud& cloud : sample) {
    Content& content = cells[cell_of(cloud)];
    content.light += cloud.weight * cloud.light;
    content.count += cloud.weight;
    ++content.samples;
  }
  return cells;
}

// Around a cell, where its clouds end.
double light_of_ring(const Cell& cell, const Cells& cells) {
  constexpr std::array<std::array<int, 2>, 8> steps = {
      {{3, 0}, {2, 2}, {0, 3}, {-2, 2}, {-3, 0}, {-2, -2}, {0, -3}, {2, -2}}};
  double light = 0;
  for (const auto& [x, y] : steps) {
    const auto found = cells.find({cell.level, cell.x + x, cell.y + y});
    if (found != cells.end()) light += found->second.light;
  }
  return light / static_cast<double>(steps.size());
}

// Some of a crowd may be a little narrower or wider than the widths of its cell.
constexpr double width_margin = 1.2;

void add(double light, std::int32_t level, Crowd& crowd) {
  const double narrowest = level == 0 ? 0 : std::exp2(0.5 * level) / width_margin;
  const double widest = std::exp2(0.5 * (level + 1)) * width_margin;
  const bool is_first = crowd.light == 0;
  crowd.light = std::max(crowd.light, light);
  crowd.narrowest_sigma = is_first ? narrowest : std::min(crowd.narrowest_sigma, narrowest);
  crowd.widest_sigma = std::max(crowd.widest_sigma, widest);
}

}  // namespace

Crowd find_crowd(const Frame& frame) {
  Crowd crowd;
  if (static_cast<double>(particle_count(frame)) < fewest) return crowd;
  const std::vector<SampledCloud> sample = sample_clouds(frame);
  const Cells cells = collect(sample);
  const bool is_of_all = sample.empty() || sample.front().weight == 1;
  const int least = is_of_all ? 1 : fewest_in_sample;
  for (const auto& [cell, content] : cells) {
    if (content.light <= harmless || content.samples < least || content.count < fewest) continue;
    // A cloud lights pi cells of its own width, so an even field's light is so much more.
    const double around = std::max(1.0, pi * light_of_ring(cell, cells));
    if (content.light <= harmless * around) continue;
    // A crowd on a corner of four cells has a quarter in each.
    add(4 * content.light / around, cell.level, crowd);
  }
  return crowd;
}

}  // namespace splotchcl
