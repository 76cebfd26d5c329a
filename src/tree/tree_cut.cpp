#include "tree/tree_cut.h"

#include <algorithm>
#include <array>
#include <boost/qvm/vec_operations.hpp>
#include <cmath>
#include <cstddef>
#include <limits>
#include <memory>
#include <optional>
#include <utility>

#include "parallel/for_blocks.h"
#include "scene/constants.h"
#include "scene/particle_columns.h"
#include "scene/particle_rules.h"
#include "scene/projection.h"
#include "splotchcl/error.h"
#include "splotchcl/frame_check.h"
#include "tree/error_cells.h"
#include "tree/field_colors.h"
#include "tree/node_bytes.h"
#include "tree/pixel_response.h"

namespace splotchcl {
namespace {

// Of the error that is left at a level, so much may be taken by the nodes that are kept there.
constexpr double part_kept_at_a_level = 0.3;
// A node alone may err by this many of its own standard deviations.
constexpr double most_of_one_node = 5;
// Nearer to the camera than so many times their reach, or widths, nodes are opened.
constexpr double nearest_reaches = 20, nearest_widths = 12;
constexpr double standard_deviations = 6;
constexpr double reach_in_sigma = 7;  // no cloud is drawn farther

// What the fields of a node's members make of its light.
struct NodeColor {
  std::array<float, 3> mean = {1, 1, 1};
  double variance = 0;   // of the mean, since only some members are known
  double deviation = 0;  // of members
};

// A part of a component that has one tree, and what is the same for all of its nodes.
struct TreePart {
  std::size_t component = 0;
  const TreeOfComponent::Part* part = nullptr;
  const TreeOfComponent* of_component = nullptr;
  const DrawnComponent* drawn = nullptr;
  std::optional<FieldPlaces> color_places, intensities;  // of the fields that are used
  std::optional<PaletteWay> palette;
  double deviation_per_h = 0;  // in lengths
  double light_per_flux = 0;   // times pixels per length squared: the sum over pixels
  double least_amplitude = 0;  // of absorption, over brightness
};

struct Item {
  std::uint32_t node = 0;
  std::array<std::uint32_t, 3> cell{};
};

enum class Fate : std::uint8_t { unseen, open, weighed };

struct Weighed {
  float error2 = 0;  // of its own, squared, added up over pixels
  float area = 1;    // pixels that it is spread over
  float light = 0;
  std::uint32_t cell = 0;  // of its scale
  std::uint8_t scale = 0;
  Fate fate = Fate::unseen;
  std::array<float, 3> color{};
};

// Of one level of one part.
struct Frontier {
  std::size_t part = 0;
  std::vector<Item> items;
  std::vector<Weighed> weighed;
};

// A number for each cell of each scale.
using CellNumbers = std::vector<std::vector<double>>;

// What nodes of a level may err by to be kept: variances of a pixel.
struct LevelLimits {
  CellNumbers promised;    // of all nodes of a cell together
  CellNumbers thresholds;  // of one node, as long as there is something left
};

// What becomes a component.
struct DrawnNodes {
  std::vector<float> position, smoothing_length, weight, color;
  std::vector<std::uint64_t> particles;  // of the component
};

class Cutter {
 public:
  Cutter(const Frame& frame, const CutSettings& settings)
      : frame_(frame),
        settings_(settings),
        regions_(settings.regions.empty() ? std::vector<Rectangle>{frame.crop} : settings.regions),
        errors_(frame.crop.width, frame.crop.height),
        alike_(frame.crop.width, frame.crop.height),
        light_(frame.crop.width, frame.crop.height),
        nodes_(frame.components.size()) {
    has_sums_ = std::all_of(frame.components.begin(), frame.components.end(), [](const auto& c) {
      return c.absorption.kind == Absorption::Kind::none;
    });
    for (std::size_t c = 0; c < frame.components.size(); ++c) {
      if (is_served(frame, frame.components[c])) add_parts(c);
    }
  }

  TreeCut cut() {
    std::vector<Frontier> frontiers;
    for (std::size_t p = 0; p < parts_.size(); ++p) {
      if (parts_[p].part->tree->levels.empty()) continue;
      frontiers.push_back({p, {Item{}}, {}});
    }
    for (std::size_t level = 0; !frontiers.empty(); ++level) {
      for (Frontier& frontier : frontiers)
        weigh(frontier, level);
      const LevelLimits limits = decide(frontiers);
      std::vector<Frontier> next;
      for (const Frontier& frontier : frontiers) {
        Frontier opened = take(frontier, level, limits);
        if (!opened.items.empty()) next.push_back(std::move(opened));
      }
      frontiers = std::move(next);
    }
    return finished();
  }

 private:
  void add_parts(std::size_t c) {
    const DrawnComponent& drawn = frame_.components[c];
    const TreeOfComponent& tree = *drawn.particles.tree;
    for (const TreeOfComponent::Part& part : tree.parts) {
      TreePart added;
      added.component = c;
      added.part = &part;
      added.of_component = &tree;
      added.drawn = &drawn;
      added.palette.emplace(drawn.palette);
      if (part.color >= 0) added.color_places.emplace(drawn.color);
      if (part.intensity >= 0) added.intensities.emplace(drawn.intensity);
      const double width = frame_.kernel.width * drawn.size_factor;
      added.deviation_per_h = width / std::sqrt(2.0);
      const double factor = drawn.weight == WeightModel::mass ? 1
                            : drawn.weight == WeightModel::constant
                                ? pi * width * frame_.kernel.width
                                : std::pow(pi, 1.5) * width * width * width;
      added.light_per_flux = factor * drawn.brightness / drawn.reference_column;
      if (drawn.absorption.kind == Absorption::Kind::factor && drawn.brightness > 0)
        added.least_amplitude = drawn.absorption.factor / drawn.brightness;
      parts_.push_back(std::move(added));
    }
  }

  void weigh(Frontier& frontier, std::size_t level) {
    frontier.weighed.resize(frontier.items.size());
    visited_ += frontier.items.size();
    const TreePart& part = parts_[frontier.part];
    for_blocks(frontier.items.size(), 1024, [&](std::size_t first, std::size_t last) {
      for (std::size_t i = first; i < last; ++i)
        frontier.weighed[i] = weigh(part, frontier.items[i], level);
    });
  }

  // In the tree's cube.
  static Vec3 place_in_cube(const TreeNode& node, const Item& item, double cell) {
    Vec3 place = {{0, 0, 0}};
    for (std::size_t axis = 0; axis < 3; ++axis) {
      place.a[axis] =
          cell * (item.cell[axis] + (static_cast<double>(node.place[axis]) + 0.5) * 0x1p-16);
    }
    return place;
  }

  // Where it is drawn; nothing where its members are drawn at different images.
  std::optional<Vec3> place_of(const TreePart& part, const Vec3& in_cube, double reach) const {
    const TreeOfType& tree = *part.part->tree;
    Vec3 place = {{0, 0, 0}};
    for (std::size_t axis = 0; axis < 3; ++axis) {
      place.a[axis] = tree.origin.a[axis] + tree.side * in_cube.a[axis];
      const double period = part.of_component->period.a[axis];
      if (!(period > 0)) continue;
      const double center = part.of_component->center.a[axis];
      double d = place.a[axis] - center;
      d -= period * std::round(d / period);
      if (std::abs(d) + reach > 0.5 * period) return std::nullopt;
      place.a[axis] = center + d;
    }
    return place;
  }

  Weighed weigh(const TreePart& part, const Item& item, std::size_t level) const {
    const TreeOfType& tree = *part.part->tree;
    const TreeNode& node = tree.levels[level].nodes[item.node];
    const double cell = std::ldexp(1.0, -static_cast<int>(level));
    const double reach = tree.side * cell * rough_of_bits(node.reach);
    const double widest =
        tree.side * part.deviation_per_h * std::sqrt(2.0) * smoothing_of_bits(node.widest);
    Weighed weighed;
    weighed.fate = Fate::open;
    const auto place = place_of(part, place_in_cube(node, item, cell), reach);
    if (!place) return weighed;
    using namespace boost::qvm;
    const CameraFrame& camera = frame_.camera;
    const Vec3 offset = *place - camera.position;
    const Vec3 from = {
        {dot(offset, camera.right), dot(offset, camera.down), dot(offset, camera.forward)}};
    if (is_near(from, reach, widest)) {
      if (is_behind(from, reach)) weighed.fate = Fate::unseen;
      return weighed;
    }
    const auto projected = project_point(from, camera, frame_.projection);
    if (!projected || is_at_limit(projected->depth, reach)) return weighed;
    if (is_unseen(*projected, reach, widest)) {
      weighed.fate = Fate::unseen;
      return weighed;
    }
    weigh_error(part, node, tree.levels[level], item.node, cell, *projected, weighed);
    return weighed;
  }

  // Members would lie at other depths, and be larger or smaller, than the node.
  bool is_near(const Vec3& from, double reach, double widest) const {
    if (frame_.projection == Projection::orthographic) return false;
    const bool is_flat =
        frame_.projection == Projection::perspective || frame_.projection == Projection::cube;
    const double distance = is_flat ? from.a[2] : boost::qvm::mag(from);
    return distance < nearest_reaches * reach || distance < nearest_widths * widest + reach;
  }
  bool is_behind(const Vec3& from, double reach) const {
    return frame_.projection == Projection::perspective && from.a[2] + reach < 0;
  }
  // All members have to be within limits, or none.
  bool is_at_limit(double depth, double reach) const {
    if (frame_.near_limit && std::abs(depth - *frame_.near_limit) <= 1.01 * reach) return true;
    return frame_.far_limit && std::abs(depth - *frame_.far_limit) <= 1.01 * reach;
  }
  bool is_beyond_limits(double depth) const {
    return (frame_.near_limit && depth < *frame_.near_limit) ||
           (frame_.far_limit && depth > *frame_.far_limit);
  }

  bool is_unseen(const Projected& at, double reach, double widest) const {
    if (is_beyond_limits(at.depth)) return true;
    if (frame_.projection != Projection::perspective &&
        frame_.projection != Projection::orthographic)
      return false;
    const double scale = 1.06 * at.pixels_per_length;
    const double pixels =
        scale * (reach + reach_in_sigma * widest) + 10 * frame_.kernel.footprint_pixels + 2 +
        0.06 * (std::abs(at.x - frame_.camera.center_x) + std::abs(at.y - frame_.camera.center_y)) *
            (frame_.projection == Projection::perspective
                 ? std::min(1.0, 20 * reach / std::max(at.depth, 1e-300))
                 : 0);
    return std::none_of(regions_.begin(), regions_.end(), [&](const Rectangle& region) {
      return at.x + pixels >= region.x && at.x - pixels <= region.x + region.width &&
             at.y + pixels >= region.y && at.y - pixels <= region.y + region.height;
    });
  }

  NodeColor color_of(const TreePart& part, const TreeLevel& level, std::uint64_t node) const {
    NodeColor color;
    const std::size_t fields = part.part->tree->fields.size();
    if (part.part->color < 0 && part.part->intensity < 0) {
      color.mean = part.palette->color(0);
      return color;
    }
    const SampledField* const sampled = level.fields + node * fields;
    std::array<float, sampled_members> places{}, factors;
    factors.fill(1);
    for (std::size_t k = 0; k < sampled_members; ++k) {
      if (part.color_places) places[k] = (*part.color_places)(sampled[part.part->color].ordered(k));
      if (part.intensities)
        factors[k] = (*part.intensities)(sampled[part.part->intensity].ordered(k));
    }
    constexpr float share = 1.0f / sampled_members;
    color.mean = {0, 0, 0};
    std::array<float, 3> squares{};
    float variance = 0;
    for (std::size_t k = 0; k < sampled_members; ++k) {
      const std::array<float, 3> member = part.palette->color(places[k]);
      for (std::size_t c = 0; c < 3; ++c) {
        const float value = member[c] * factors[k];
        color.mean[c] += value * share;
        squares[c] += value * value * share;
      }
      const std::size_t before = k > 0 ? k - 1 : k;
      const std::size_t after = k + 1 < sampled_members ? k + 1 : k;
      // Between neighbours lies what the eighth may hold.
      const float spread = part.palette->spread(places[before], places[after]) *
                               std::max({factors[before], factors[k], factors[after]}) +
                           std::abs(factors[after] - factors[before]);
      variance += spread * spread / 8 * share * share;
    }
    color.variance = static_cast<double>(variance);
    for (std::size_t c = 0; c < 3; ++c) {
      const float spread2 = std::max(0.0f, squares[c] - color.mean[c] * color.mean[c]);
      color.deviation = std::max(color.deviation, static_cast<double>(std::sqrt(spread2)));
    }
    return color;
  }

  void weigh_error(const TreePart& part, const TreeNode& node, const TreeLevel& level,
                   std::uint64_t number, double cell, const Projected& at, Weighed& weighed) const {
    const double scale = at.pixels_per_length * part.part->tree->side;
    const double footprint = frame_.kernel.footprint_pixels;
    const double size = length_of_bits(node.size) * part.deviation_per_h * scale;
    const PixelResponse response = pixel_response(std::sqrt(footprint * footprint + size * size));
    const double light = static_cast<double>(node.flux) * part.light_per_flux *
                         at.pixels_per_length * at.pixels_per_length;
    const NodeColor color = color_of(part, level, number);
    auto amplitude = static_cast<double>(std::max({color.mean[0], color.mean[1], color.mean[2]}));
    amplitude *= std::max(1.0, part.least_amplitude);
    const auto square = [](double x) { return x * x; };
    const double root_of_third = rough_of_bits(node.third) * cell * scale;
    const double uneven = square(rough_of_bits(node.uneven) * cell * scale);
    const double third = root_of_third * square(root_of_third);
    const double fourth = square(square(rough_of_bits(node.fourth) * cell * scale));
    const double place = length_of_bits(node.deviation) * scale;
    // A node errs by no more than all of its light, here and there.
    const double shape = std::min(2 * response.value, square(uneven) * response.second / 20 +
                                                          square(third) * response.third / 360 +
                                                          square(fourth) * response.fourth / 8640);
    const double of_colors =
        color.variance * response.value + square(color.deviation * place) * response.first / 3;
    weighed.error2 = static_cast<float>(
        square(light) *
        (square(amplitude) * shape + of_colors * square(std::max(1.0, part.least_amplitude))));
    weighed.area = static_cast<float>(response.area);
    weighed.scale = static_cast<std::uint8_t>(
        errors_.scale_of(2 * std::sqrt(square(footprint) + square(place) + square(size))));
    weighed.cell = static_cast<std::uint32_t>(
        errors_.cell_at(weighed.scale, at.x - frame_.crop.x, at.y - frame_.crop.y));
    weighed.light = static_cast<float>(light * amplitude);
    weighed.color = color.mean;
    weighed.fate = Fate::weighed;
  }

  // Its part of the variance of a pixel of its cell.
  double variance_of(const Weighed& node) const {
    const double pixels = errors_.pixels(node.scale);
    return static_cast<double>(node.error2) / (pixels * pixels);
  }

  // What six standard deviations may be in each cell, squared and over 36.
  CellNumbers allowed(const std::vector<Frontier>& frontiers) const {
    ErrorCells light = light_;
    for (const Frontier& frontier : frontiers) {
      for (const Weighed& node : frontier.weighed) {
        if (node.fate == Fate::weighed) add_light(node, light);
      }
    }
    CellNumbers allowed = light.least_totals();
    for (std::vector<double>& cells : allowed) {
      for (double& cell : cells) {
        const double promise = settings_.error * (has_sums_ ? std::max(1.0, 0.5 * cell) : 1);
        cell = std::pow(promise / standard_deviations, 2);
      }
    }
    return allowed;
  }
  void add_light(const Weighed& node, ErrorCells& light) const {
    const double pixels = light.pixels(node.scale);
    light.at(node.scale, node.cell) += static_cast<double>(node.light) / (pixels * pixels);
  }

  // The variance up to which nodes of a cell are kept at this level: those that err least, as long
  // as they take their part of what is left.
  LevelLimits decide(const std::vector<Frontier>& frontiers) const {
    constexpr int bins = 24;  // octaves of variance below all that is left
    LevelLimits limits{allowed(frontiers), {}};
    const CellNumbers& promised = limits.promised;
    const auto used = errors_.totals();
    CellNumbers left(promised.size()), sums(promised.size());
    for (std::size_t s = 0; s < promised.size(); ++s) {
      left[s].resize(promised[s].size());
      for (std::size_t cell = 0; cell < left[s].size(); ++cell)
        left[s][cell] = std::max(0.0, promised[s][cell] - used[s][cell]);
      sums[s].assign(promised[s].size() * bins, 0);
    }
    const auto bin_of = [&](double variance, double all) {
      if (!(variance > 0)) return 0;
      if (!(all > 0)) return bins;
      return std::clamp(std::ilogb(variance / all) + bins + 1, 0, bins);
    };
    for (const Frontier& frontier : frontiers) {
      for (const Weighed& node : frontier.weighed) {
        if (node.fate != Fate::weighed) continue;
        const std::size_t cell = node.cell;
        const double variance = variance_of(node);
        const int bin = bin_of(variance, left[node.scale][cell]);
        if (bin < bins) sums[node.scale][cell * bins + static_cast<std::size_t>(bin)] += variance;
      }
    }
    CellNumbers& thresholds = limits.thresholds;
    thresholds.resize(promised.size());
    for (std::size_t s = 0; s < left.size(); ++s) {
      thresholds[s].assign(left[s].size(), 0);
      for (std::size_t cell = 0; cell < left[s].size(); ++cell) {
        double sum = 0;
        int bin = 0;
        while (bin < bins && (sum += sums[s][cell * bins + static_cast<std::size_t>(bin)]) <=
                                 part_kept_at_a_level * left[s][cell])
          ++bin;
        thresholds[s][cell] = std::ldexp(left[s][cell], bin - bins - 1);
      }
    }
    return limits;
  }

  bool is_kept(const Weighed& node, const LevelLimits& limits) const {
    const double variance = variance_of(node);
    if (!(variance > 0)) return true;
    constexpr double deviations = standard_deviations / most_of_one_node;
    const double most = deviations * deviations * limits.promised[node.scale][node.cell];
    const double largest = static_cast<double>(node.error2) / static_cast<double>(node.area);
    return variance < limits.thresholds[node.scale][node.cell] && largest <= most;
  }

  Frontier take(const Frontier& frontier, std::size_t level, const LevelLimits& limits) {
    Frontier next{frontier.part, {}, {}};
    next.items.reserve(4 * frontier.items.size());
    for (std::size_t i = 0; i < frontier.items.size(); ++i) {
      const Weighed& node = frontier.weighed[i];
      if (node.fate == Fate::unseen) continue;
      if (node.fate == Fate::weighed && is_kept(node, limits)) {
        keep(frontier, i, level);
      } else {
        open(frontier, i, level, next.items);
      }
    }
    return next;
  }

  void keep(const Frontier& frontier, std::size_t i, std::size_t level) {
    const Weighed& node = frontier.weighed[i];
    errors_.at(node.scale, node.cell) += variance_of(node);
    const double pixels = errors_.pixels(node.scale);
    alike_.at(node.scale, node.cell) +=
        std::sqrt(static_cast<double>(node.error2) * static_cast<double>(node.area)) /
        (pixels * pixels);
    add_light(node, light_);
    draw_node(parts_[frontier.part], frontier.items[i], level, node);
    ++kept_;
  }

  void draw_node(const TreePart& part, const Item& item, std::size_t level,
                 const Weighed& weighed) {
    const TreeOfType& tree = *part.part->tree;
    const TreeNode& node = tree.levels[level].nodes[item.node];
    const double cell = std::ldexp(1.0, -static_cast<int>(level));
    const Vec3 place = place_of(part, place_in_cube(node, item, cell), 0).value_or(Vec3{{0, 0, 0}});
    DrawnNodes& drawn = nodes_[part.component];
    const Vec3& origin = part.drawn->particles.origin;
    for (std::size_t axis = 0; axis < 3; ++axis)
      drawn.position.push_back(static_cast<float>(place.a[axis] - origin.a[axis]));
    const double deviation = length_of_bits(node.deviation) * tree.side;
    const double own = length_of_bits(node.size) * part.deviation_per_h * tree.side;
    const double h = std::sqrt(deviation * deviation + own * own) / part.deviation_per_h;
    drawn.smoothing_length.push_back(static_cast<float>(h));
    const double flux = static_cast<double>(node.flux);
    const double weight = part.drawn->weight == WeightModel::mass       ? flux
                          : part.drawn->weight == WeightModel::constant ? flux / h
                                                                        : flux / (h * h * h);
    drawn.weight.push_back(static_cast<float>(weight));
    drawn.color.insert(drawn.color.end(), weighed.color.begin(), weighed.color.end());
  }

  void open(const Frontier& frontier, std::size_t i, std::size_t level_number,
            std::vector<Item>& next) {
    const TreePart& part = parts_[frontier.part];
    const TreeOfType& tree = *part.part->tree;
    const TreeLevel& level = tree.levels[level_number];
    const Item& item = frontier.items[i];
    std::uint64_t child = level.first_child(item.node);
    const std::uint8_t mask = level.children[item.node];
    for (unsigned octant = 0; octant < 8; ++octant) {
      if ((mask >> octant & 1U) == 0) continue;
      if (level_number + 1 >= tree.levels.size() || child >= tree.levels[level_number + 1].count)
        refuse_damaged();
      Item opened;
      opened.node = static_cast<std::uint32_t>(child++);
      for (std::size_t axis = 0; axis < 3; ++axis)
        opened.cell[axis] = 2 * item.cell[axis] + (octant >> axis & 1U);
      next.push_back(opened);
    }
    const std::uint64_t first = level.first_loose_particle(item.node);
    const std::uint64_t count = level.loose[item.node];
    if (count > tree.order_count || first > tree.order_count - count) refuse_damaged();
    for (std::uint64_t loose = first; loose < first + count; ++loose) {
      const std::uint64_t place = tree.order[loose];
      if (place >= tree.count) refuse_damaged();
      nodes_[part.component].particles.push_back(part.part->first + place);
    }
  }

  [[noreturn]] static void refuse_damaged() {
    throw DataError(
        "the tree of merged particles: found numbers that do not fit together, expected those that "
        "splotchcl tree wrote; write it again, or draw with --tree never");
  }

  TreeCut finished() {
    TreeCut cut;
    cut.frame = frame_;
    cut.frame.components.clear();
    for (std::size_t c = 0; c < frame_.components.size(); ++c) {
      const DrawnComponent& component = frame_.components[c];
      if (!is_served(frame_, component)) {
        cut.frame.components.push_back(component);
        continue;
      }
      cut.particles += nodes_[c].particles.size();
      cut.frame.components.push_back(merged(component, nodes_[c]));
      DrawnComponent loose = component;
      loose.particles = picked_particles(component.particles, nodes_[c].particles);
      cut.frame.components.push_back(std::move(loose));
    }
    cut.nodes = kept_;
    cut.visited = visited_;
    cut.alike = alike();
    return cut;
  }

  static DrawnComponent merged(const DrawnComponent& component, DrawnNodes& nodes) {
    DrawnComponent merged = component;
    merged.palette = {};
    merged.palette.name = "white";
    merged.palette.emission = {Rgb{1, 1, 1}};
    Particles particles;
    particles.count = nodes.smoothing_length.size();
    particles.origin = component.particles.origin;
    particles.position = Column::owning(std::move(nodes.position));
    particles.smoothing_length = Column::owning(std::move(nodes.smoothing_length));
    particles.weight = Column::owning(std::move(nodes.weight));
    particles.color_vector = Column::owning(std::move(nodes.color));
    merged.particles = std::move(particles);
    return merged;
  }

  BlockErrors alike() const {
    const auto errors = alike_.totals();
    const auto light = light_.least_totals();
    BlockErrors blocks(frame_.crop.width, frame_.crop.height);
    const auto columns = static_cast<std::size_t>(alike_.columns(0));
    constexpr int cells_of_block = BlockErrors::block_pixels / ErrorCells::cell_pixels;
    for (std::size_t cell = 0; cell < errors[0].size(); ++cell) {
      const int x = static_cast<int>(cell % columns) / cells_of_block;
      const int y = static_cast<int>(cell / columns) / cells_of_block;
      const double over = has_sums_ ? std::max(1.0, light[0][cell]) : 1;
      float& block = blocks.errors[static_cast<std::size_t>(y * blocks.columns + x)];
      block = std::max(block, static_cast<float>(errors[0][cell] / over));
    }
    return blocks;
  }

  const Frame& frame_;
  const CutSettings& settings_;
  std::vector<Rectangle> regions_;
  bool has_sums_ = false;
  std::vector<TreePart> parts_;
  ErrorCells errors_, alike_, light_;  // of the nodes that are kept
  std::vector<DrawnNodes> nodes_;      // of each component
  std::uint64_t kept_ = 0, visited_ = 0;
};

}  // namespace

bool is_served(const Frame& frame, const DrawnComponent& component) {
  const bool has_own_absorption = component.palette.has_own_absorption();
  return component.particles.tree != nullptr &&
         component.absorption.kind != Absorption::Kind::gray && !has_own_absorption &&
         component.particles.color_vector.is_absent() && frame.sort.by == SortOrder::By::depth &&
         !frame.kernel.cut && frame.kernel.sampling == Sampling::mean &&
         frame.kernel.footprint_pixels > 0 && frame.projection != Projection::cube && !frame.spread;
}

bool has_served_component(const Frame& frame) {
  return std::any_of(frame.components.begin(), frame.components.end(),
                     [&](const DrawnComponent& c) { return is_served(frame, c); });
}

TreeCut cut_tree(const Frame& frame, const CutSettings& settings) {
  return Cutter(frame, settings).cut();
}

}  // namespace splotchcl
