#include "tree/merged_drawing.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <limits>
#include <numeric>
#include <utility>
#include <vector>

#include "scene/ceil_divide.h"
#include "scene/hash.h"
#include "splotchcl/frame_check.h"
#include "tree/tree_cut.h"
#include "tree/tree_parts.h"

namespace splotchcl {
namespace {

// Fewer particles over a pixel do not gain. A splat of a cut takes as long as 24 to 34 particles,
// those by which it is verified included, and as long again where it fails.
constexpr double least_over_pixel = 50;
constexpr double most_that_pay = 1.0 / 24, most_that_pay_again = 1.0 / 48;  // over particles
constexpr double most_splats_again = 1.0 / 8;
constexpr double part_of_nodes = 0.62;      // of the tolerance
constexpr double verified_finer = 4;        // error of the cut to which a picture is compared
constexpr double verified_tolerance = 0.1;  // of the frame's, with which that is drawn
constexpr double most_found = 0.65;         // of the promise, on blocks that are verified
constexpr int most_cuts = 3;
// Two leave cells around peaks of light that take three times as much as is promised; a correction
// takes little, since nodes that were weighed are known.
constexpr int corrections = 4, corrections_of_finer = 3;
constexpr int blocks_of_region = 2;  // on each side
// Of each kind, an eighth of the picture at most: these take four times as many splats and more.
constexpr std::size_t most_regions = 8, fewest_regions = 2, regions_per_one = 16;

// Squares of blocks, as far as the crop reaches.
std::vector<Rectangle> all_regions(const Rectangle& crop) {
  constexpr int side = blocks_of_region * BlockErrors::block_pixels;
  std::vector<Rectangle> regions;
  for (int y = 0; y < crop.height; y += side) {
    for (int x = 0; x < crop.width; x += side) {
      regions.push_back({crop.x + x, crop.y + y, std::min(side, crop.width - x),
                         std::min(side, crop.height - y)});
    }
  }
  return regions;
}

float largest_alike(const Rectangle& region, const Rectangle& crop, const BlockErrors& alike) {
  float largest = 0;
  for (int y = region.y; y < region.y + region.height; y += BlockErrors::block_pixels) {
    for (int x = region.x; x < region.x + region.width; x += BlockErrors::block_pixels)
      largest = std::max(largest, alike.at(x - crop.x, y - crop.y));
  }
  return largest;
}

// Those where nodes would err most if they erred alike, and as many others that every camera
// chooses anew; of few all.
std::vector<Rectangle> verified_regions(const Frame& frame, const BlockErrors& alike) {
  std::vector<Rectangle> regions = all_regions(frame.crop);
  const std::size_t of_each_kind =
      std::clamp(regions.size() / regions_per_one, fewest_regions, most_regions);
  if (regions.size() <= 2 * of_each_kind) return regions;
  std::vector<std::pair<float, std::size_t>> by_error;
  for (std::size_t r = 0; r < regions.size(); ++r)
    by_error.emplace_back(-largest_alike(regions[r], frame.crop, alike), r);
  std::sort(by_error.begin(), by_error.end());
  WordHash hash;
  for (const double number : frame.camera.position.a)
    hash.add(number);
  for (const double number : frame.camera.forward.a)
    hash.add(number);
  std::vector<Rectangle> chosen;
  for (std::size_t r = 0; r < of_each_kind; ++r)
    chosen.push_back(regions[by_error[r].second]);
  std::vector<std::size_t> others;
  for (std::size_t r = of_each_kind; r < by_error.size(); ++r)
    others.push_back(by_error[r].second);
  for (std::size_t r = 0; r < of_each_kind && r < others.size(); ++r) {
    const std::uint64_t random = hash_of(hash.value() + r);
    std::swap(others[r], others[r + static_cast<std::size_t>(random % (others.size() - r))]);
    chosen.push_back(regions[others[r]]);
  }
  return chosen;
}

// In a part of the crop, over max(1, light).
double largest_difference(const Image& picture, const Image& finer, const Rectangle& crop,
                          const Rectangle& region) {
  double largest = 0;
  for (int y = region.y - crop.y; y < region.y - crop.y + region.height; ++y) {
    for (int x = region.x - crop.x; x < region.x - crop.x + region.width; ++x) {
      for (int c = 0; c < 3; ++c) {
        const double a = static_cast<double>(picture.at(x, y)[c]);
        const double b = static_cast<double>(finer.at(x, y)[c]);
        largest = std::max(largest, std::abs(a - b) / std::max(1.0, std::abs(b)));
      }
    }
  }
  return largest;
}

// Squares all over the picture, of a thirtieth of its area.
std::vector<Rectangle> sampled_regions(const Rectangle& crop) {
  constexpr int along = 4;
  constexpr double part_of_side = 0.18;
  std::vector<Rectangle> regions;
  for (int i = 0; i < along * along; ++i) {
    const int width = std::max(1, static_cast<int>(part_of_side * crop.width / along));
    const int height = std::max(1, static_cast<int>(part_of_side * crop.height / along));
    // Not all in a row.
    const double x = (i % along + 0.2 + 0.15 * (i / along)) / along;
    const double y = (i / along + 0.65 - 0.15 * (i % along)) / along;
    regions.push_back({crop.x + static_cast<int>(x * crop.width),
                       crop.y + static_cast<int>(y * crop.height), width, height});
  }
  return regions;
}

// Of nodes and particles, by those in a part of the picture.
double expected_splats(const Frame& frame) {
  const std::vector<Rectangle> regions = sampled_regions(frame.crop);
  const TreeCut cut = cut_tree(frame, {part_of_nodes * frame.tolerance, regions, 2, true});
  const double all = static_cast<double>(frame.crop.width) * frame.crop.height;
  double area = 0;
  for (const Rectangle& region : regions)
    area += static_cast<double>(region.width) * region.height;
  return static_cast<double>(cut.nodes + cut.particles) * all / area;
}

// Regions are drawn together: elsewhere that picture shows a part of its light. Of each region what
// the drawing differs by, over what is promised.
std::vector<double> verify(const Frame& frame, CutSettings settings,
                           const std::function<Image(const Frame&)>& draw, MergedDrawing& drawing) {
  settings.error /= verified_finer;
  settings.corrections = corrections_of_finer;
  TreeCut finer = cut_tree(frame, settings);
  finer.frame.tolerance = verified_tolerance * frame.tolerance;
  const Image exact = draw(finer.frame);
  drawing.visited += finer.visited;
  drawing.bytes += finer.bytes;
  drawing.found = 0;
  drawing.verified_blocks = 0;
  std::vector<double> differences;
  for (const Rectangle& region : settings.regions) {
    const double difference = largest_difference(drawing.image, exact, frame.crop, region);
    differences.push_back(difference / frame.tolerance);
    drawing.found = std::max(drawing.found, differences.back());
    drawing.verified_blocks +=
        BlockErrors::blocks_along(region.width) * BlockErrors::blocks_along(region.height);
  }
  return differences;
}

// Of the blocks of regions that failed, and of those where nodes would err by as much as there, if
// they erred alike.
void take_smaller_part(const Frame& frame, const BlockErrors& alike,
                       const std::vector<Rectangle>& regions,
                       const std::vector<double>& differences, double found, BlockErrors& parts) {
  float least = std::numeric_limits<float>::infinity();
  std::vector<Rectangle> failed;
  for (std::size_t r = 0; r < regions.size(); ++r) {
    if (differences[r] <= most_found) continue;
    least = std::min(least, largest_alike(regions[r], frame.crop, alike));
    failed.push_back(regions[r]);
  }
  constexpr int side = BlockErrors::block_pixels;
  for (int row = 0; row < parts.rows; ++row) {
    for (int column = 0; column < parts.columns; ++column) {
      const int x = frame.crop.x + side * column, y = frame.crop.y + side * row;
      const bool has_failed =
          std::any_of(failed.begin(), failed.end(), [x, y](const Rectangle& region) {
            return x >= region.x && x < region.x + region.width && y >= region.y &&
                   y < region.y + region.height;
          });
      const auto block = static_cast<std::size_t>(row * parts.columns + column);
      if (has_failed || alike.errors[block] >= least)
        parts.errors[block] *= static_cast<float>(std::max(0.2, 0.5 / found));
    }
  }
}

}  // namespace

bool has_particles_for_tree(const Frame& frame) {
  const double pixels = static_cast<double>(frame.width) * frame.height;
  return static_cast<double>(particle_count(frame)) / pixels > least_over_pixel;
}

bool tree_pays(const Frame& frame) {
  return has_served_component(frame) && has_particles_for_tree(frame) &&
         expected_splats(frame) < most_that_pay * static_cast<double>(particle_count(frame));
}

namespace {

bool has_other_colors(const TreePart& part) {
  return part.colors && (part.part->color >= 0 || part.part->intensity >= 0);
}

}  // namespace

std::string explain_tree(const Frame& frame) {
  const std::vector<TreePart> parts = tree_parts(frame);
  const bool is_sampled = std::any_of(parts.begin(), parts.end(), has_other_colors);
  const TreeCut cut = cut_tree(frame, {part_of_nodes * frame.tolerance, {}, corrections});
  return fmt::format(
      "tree: {} nodes and {} particles in place of {}, found among {} nodes, {:.0f} MB of the "
      "tree; "
      "by estimate they err by {:.2f} of the tolerance{}\n",
      cut.nodes, cut.particles, particle_count(frame), cut.visited,
      static_cast<double>(cut.bytes) / 1e6, cut.estimate / frame.tolerance,
      is_sampled ? "; colors are those of eight particles of each node: splotchcl tree --scene, "
                   "given this scene, keeps the mean of all, which takes fewer nodes"
                 : "");
}

std::optional<MergedDrawing> draw_merged(const Frame& frame,
                                         const std::function<Image(const Frame&)>& draw,
                                         bool has_to_pay) {
  MergedDrawing drawing;
  CutSettings settings{part_of_nodes * frame.tolerance, {}, corrections};
  settings.parts_of_error = BlockErrors(frame.crop.width, frame.crop.height);
  std::fill(settings.parts_of_error.errors.begin(), settings.parts_of_error.errors.end(), 1.0f);
  for (drawing.cuts = 1; drawing.cuts <= most_cuts; ++drawing.cuts) {
    TreeCut cut = cut_tree(frame, settings);
    const double splats = static_cast<double>(cut.nodes + cut.particles);
    const double particles = static_cast<double>(particle_count(frame));
    const bool is_first = drawing.cuts == 1;
    if (has_to_pay && splats > (is_first ? most_that_pay : most_that_pay_again) * particles)
      return std::nullopt;
    if (!is_first && splats > most_splats_again * particles) return std::nullopt;
    cut.frame.tolerance = (1 - part_of_nodes) * frame.tolerance;
    drawing.image = draw(cut.frame);
    drawing.nodes = cut.nodes;
    drawing.particles = cut.particles;
    drawing.visited += cut.visited;
    drawing.bytes += cut.bytes;
    drawing.estimate = cut.estimate / frame.tolerance;
    CutSettings of_regions = settings;
    of_regions.regions = verified_regions(frame, cut.alike);
    const auto differences = verify(frame, of_regions, draw, drawing);
    if (drawing.found <= most_found) return drawing;
    take_smaller_part(frame, cut.alike, of_regions.regions, differences, drawing.found,
                      settings.parts_of_error);
  }
  return std::nullopt;
}

}  // namespace splotchcl
