#include "tree/node_weighing.h"

#include <algorithm>
#include <bitset>
#include <boost/qvm/vec_operations.hpp>
#include <cmath>

#include "tree/node_bytes.h"
#include "tree/node_color.h"
#include "tree/pixel_response.h"

namespace splotchcl {
namespace {

// Nearer to the camera than so many times their reach, or widths, nodes are opened.
constexpr double nearest_reaches = 20, nearest_widths = 12;
constexpr double reach_in_sigma = 7;  // no cloud is drawn farther
// Nodes that err alike seem to err so much more (squared), near enough to the row where they do.
constexpr float alike2 = 4;
constexpr double pixels_of_row = 6;

double square(double x) {
  return x * x;
}

// A node's shape in pixels, of which the tree's side has `scale`.
struct ShownShape {
  // Variances of the Gaussians that most of the members' peaks have, and of their places.
  double narrow2 = 0, place2 = 0;
  double uneven = 0, third = 0, fourth = 0;
};

ShownShape shown_shape(const TreePart& part, const TreeNode& node, double cell, double scale) {
  ShownShape shape;
  shape.narrow2 = square(length_of_bits(node.size) * narrownesses[node.narrow()] *
                         part.deviation_per_h * scale);
  shape.place2 = square(length_of_bits(node.deviation) * scale);
  shape.uneven = square(rough_of_bits(node.uneven) * cell * scale);
  const double root_of_third = rough_of_bits(node.third) * cell * scale;
  shape.third = root_of_third * square(root_of_third);
  shape.fourth = square(square(rough_of_bits(node.fourth) * cell * scale));
  return shape;
}

// What the spread of members adds to the width of what they err by: cumulants err as wide as the
// node itself. Where it is many pixels wide it is more than a few cumulants that count.
double spread_of_members(double place2, double seen2) {
  constexpr double part = 0.75, most = 3;
  return part * std::min(place2, most * (seen2 + 1.0 / 12));
}

}  // namespace

WeighedNode NodeWeigher::weigh(const TreePart& part, const TreeItem& item,
                               std::size_t level) const {
  const TreeOfType& tree = part.tree();
  const TreeNode& node = tree.levels[level].nodes[item.node];
  const double cell = std::ldexp(1.0, -node.cell_level(level));
  const double reach = tree.side * cell * rough_of_bits(node.reach);
  const double widest =
      tree.side * part.deviation_per_h * std::sqrt(2.0) * smoothing_of_bits(node.widest);
  WeighedNode weighed{};
  weighed.fate = NodeFate::open;
  weighed.children =
      static_cast<std::uint8_t>(std::bitset<8>(tree.levels[level].children[item.node]).count());
  const auto place = place_of(part, item, level, opens_across_faces_ ? reach : 0);
  if (!place) return weighed;
  using namespace boost::qvm;
  const CameraFrame& camera = frame_.camera;
  const Vec3 offset = *place - camera.position;
  const Vec3 from = {
      {dot(offset, camera.right), dot(offset, camera.down), dot(offset, camera.forward)}};
  if (is_near(from, reach, widest)) {
    if (is_behind(from, reach)) weighed.fate = NodeFate::unseen;
    return weighed;
  }
  const auto projected = project_point(from, camera, frame_.projection);
  if (!projected || is_at_limit(projected->depth, reach)) return weighed;
  if (is_unseen(*projected, reach, widest)) {
    weighed.fate = NodeFate::unseen;
    return weighed;
  }
  weigh_error(part, item, level, *projected, weighed);
  if (is_along_cells(part, offset, projected->pixels_per_length, reach)) {
    weighed.error2 *= alike2;
    weighed.largest2 *= alike2;
  }
  return weighed;
}

// Whether a plane of cells is seen from its edge here: nodes on it lie behind each other in one row
// of pixels, and err alike. Parallel views see it so everywhere or nowhere.
bool NodeWeigher::is_along_cells(const TreePart& part, const Vec3& offset, double pixels_per_length,
                                 double reach) const {
  const bool is_parallel = frame_.projection == Projection::orthographic;
  for (std::size_t axis = 0; axis < 3; ++axis) {
    const double away =
        is_parallel ? part.tree().side * frame_.camera.forward.a[axis] : offset.a[axis];
    if (pixels_per_length * (std::abs(away) - reach) < pixels_of_row) return true;
  }
  return false;
}

// Members would lie at other depths, and be larger or smaller, than the node.
bool NodeWeigher::is_near(const Vec3& from, double reach, double widest) const {
  if (frame_.projection == Projection::orthographic) return false;
  const bool is_flat =
      frame_.projection == Projection::perspective || frame_.projection == Projection::cube;
  const double distance = is_flat ? from.a[2] : boost::qvm::mag(from);
  return distance < nearest_reaches * reach || distance < nearest_widths * widest + reach;
}
bool NodeWeigher::is_behind(const Vec3& from, double reach) const {
  return frame_.projection == Projection::perspective && from.a[2] + reach < 0;
}
// All members have to be within limits, or none, and where light fades with depth it is each
// member's own.
bool NodeWeigher::is_at_limit(double depth, double reach) const {
  const double within = 1.01 * reach;
  const std::optional<double> near_limit = limit_before();
  const double nearest = near_limit.value_or(0);
  const auto [near_length, far_length] = frame_.fade;
  if (near_length > 0 && depth + within > nearest && depth - within < nearest + near_length)
    return true;
  if (far_length > 0 && depth - within < *frame_.far_limit &&
      depth + within > *frame_.far_limit - far_length)
    return true;
  if (near_limit && std::abs(depth - *near_limit) <= within) return true;
  return frame_.far_limit && std::abs(depth - *frame_.far_limit) <= within;
}
bool NodeWeigher::is_beyond_limits(double depth) const {
  const std::optional<double> near_limit = limit_before();
  return (near_limit && depth < *near_limit) || (frame_.far_limit && depth > *frame_.far_limit);
}

// Of parallel views the camera itself, where none is set: what is behind it is not drawn.
std::optional<double> NodeWeigher::limit_before() const {
  if (!frame_.near_limit && frame_.projection == Projection::orthographic) return 0;
  return frame_.near_limit;
}

bool NodeWeigher::is_unseen(const Projected& at, double reach, double widest) const {
  if (is_beyond_limits(at.depth)) return true;
  if (frame_.projection != Projection::perspective && frame_.projection != Projection::orthographic)
    return false;
  const double scale = 1.06 * at.pixels_per_length;
  const double spread =
      has_to_lie_there_ ? 0
                        : scale * reach_in_sigma * widest + 10 * frame_.kernel.footprint_pixels + 2;
  const double pixels =
      scale * reach + spread +
      0.06 * (std::abs(at.x - frame_.camera.center_x) + std::abs(at.y - frame_.camera.center_y)) *
          (frame_.projection == Projection::perspective
               ? std::min(1.0, 20 * reach / std::max(at.depth, 1e-300))
               : 0);
  return std::none_of(regions_.begin(), regions_.end(), [&](const Rectangle& region) {
    return at.x + pixels >= region.x && at.x - pixels <= region.x + region.width &&
           at.y + pixels >= region.y && at.y - pixels <= region.y + region.height;
  });
}

void NodeWeigher::weigh_error(const TreePart& part, const TreeItem& item, std::size_t level,
                              const Projected& at, WeighedNode& weighed) const {
  const TreeLevel& of_level = part.tree().levels[level];
  const TreeNode& node = of_level.nodes[item.node];
  const double cell = std::ldexp(1.0, -node.cell_level(level));
  const double scale = at.pixels_per_length * part.tree().side;
  const ShownShape shape = shown_shape(part, node, cell, scale);
  const double footprint2 = square(frame_.kernel.footprint_pixels);
  // Where few members are much narrower than others, they stand out of the node.
  const double seen2 = footprint2 + shape.narrow2;
  const PixelResponse narrow = pixel_response(seen2);
  const PixelResponse spread = pixel_response(seen2 + spread_of_members(shape.place2, seen2));
  const double light =
      static_cast<double>(node.flux) * part.light_per_flux * square(at.pixels_per_length);
  const NodeColor color = node_color(part, of_level, item.node);
  const double least_amplitude = std::max(1.0, part.least_amplitude);
  const double amplitude =
      least_amplitude *
      static_cast<double>(std::max({color.mean[0], color.mean[1], color.mean[2]}));
  // Colors that lie on one side of a node move its light; where that is known, they may lie
  // unevenly in other ways still. Where not, as if they rose evenly along the node.
  const double moved2 =
      color.dipole ? square(*color.dipole * cell * scale) : square(color.deviation) * shape.place2;
  const double uneven_colors = color.dipole ? least_amplitude * color.deviation : 0;
  // A node errs by no more than all of its light, here and there.
  const double of_shape =
      std::min(2 * narrow.value, square(shape.uneven) * spread.second / 20 +
                                     square(shape.third) * spread.third / 360 +
                                     square(shape.fourth) * spread.fourth / 8640);
  const double of_places = (square(amplitude) + square(uneven_colors)) * of_shape +
                           square(least_amplitude) * moved2 * spread.first / 3;
  const double of_samples = square(least_amplitude) * color.variance * narrow.value;
  weighed.error2 = static_cast<float>(square(light) * (of_places + of_samples));
  weighed.largest2 =
      static_cast<float>(square(light) * (of_places / spread.area + of_samples / narrow.area));
  weighed.scale = static_cast<std::uint8_t>(cells_.scale_of(2 * std::sqrt(seen2 + shape.place2)));
  const double x = at.x - frame_.crop.x, y = at.y - frame_.crop.y;
  weighed.cell = static_cast<std::uint32_t>(cells_.cell_at(weighed.scale, x, y));
  weighed.is_beside = x < 0 || y < 0 || x > frame_.crop.width || y > frame_.crop.height;
  weighed.light = static_cast<float>(light * amplitude);
  weighed.color = color.mean;
  weighed.fate = NodeFate::weighed;
}

}  // namespace splotchcl
