#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

#include "map/geometry.h"
#include "scene/constants.h"
#include "splotchcl/error.h"

namespace splotchcl {
namespace {

using namespace boost::qvm;

// Beyond this many sigma is 2e-16 of a particle.
constexpr double reach_sigmas = 6;

// Of a kernel around x, how much lies between -half and half: with all its digits, however little.
double share_between(double x, double half, double sigma) {
  const double away = std::abs(x), reach = reach_sigmas * sigma;
  if (half - away > reach) return 1;
  const double beyond = away + half > reach ? 0 : std::erfc((away + half) / sigma);
  return 0.5 * (std::erfc((away - half) / sigma) - beyond);
}

// Particles that follow each other, from the map's middle: in the snapshot's axes and in the map's.
struct Block {
  static constexpr std::size_t most = 256;
  std::array<std::array<double, most>, 3> offset;
  std::array<double, most> right, up, depth, size;

  Vec3 offset_of(std::size_t j) const { return {{offset[0][j], offset[1][j], offset[2][j]}}; }
  // What is infinite or not a number along one axis is so in the sum.
  bool is_good(std::size_t j) const {
    return std::isfinite(offset[0][j] + offset[1][j] + offset[2][j]) && std::isfinite(size[j]) &&
           size[j] > 0;
  }
};

// To the right, upwards and away from the map's middle.
struct Seen {
  double right, up, depth;
};

class Placer {
 public:
  Placer(const MapMatter& matter, const MapGeometry& geometry, double sigma, bool is_slice)
      : matter_(matter),
        geometry_(geometry),
        sigma_(sigma),
        is_slice_(is_slice),
        half_({0.5 * geometry.width * geometry.pixel, 0.5 * geometry.height * geometry.pixel,
               is_slice         ? 0
               : geometry.depth ? 0.5 * *geometry.depth
                                : std::numeric_limits<double>::infinity()}) {}

  PlacedParticles place() {
    if (matter_.count > std::numeric_limits<std::uint32_t>::max()) {
      throw DataError("found more than 4294967295 particles, expected fewer in one map");
    }
    check_reach();
    reserve();
    for (std::size_t first = 0; first < matter_.count; first += Block::most)
      place_block(first, std::min(Block::most, matter_.count - first));
    return std::move(placed_);
  }

 private:
  // Of most maps for all there is.
  void reserve() {
    placed_.position.reserve(3 * matter_.count);
    placed_.size.reserve(matter_.count);
    placed_.source.reserve(matter_.count);
    placed_.share.reserve(matter_.count);
  }

  // Each box that a kernel reaches has an image of it.
  void check_reach() const {
    if (!geometry_.box) return;
    double largest = 0;
    for (std::size_t i = 0; i < matter_.count; ++i) {
      if (matter_.is_good(i)) largest = std::max(largest, matter_.size_of(i));
    }
    const BoxSides& box = *geometry_.box;
    const double shortest = std::min({box[0], box[1], box[2]});
    const double boxes = 2 * reach_sigmas * sigma_ * largest / shortest;
    if (boxes <= most_boxes) return;
    throw UsageError(fmt::format(
        "key map.periodic: found a smoothing length of {:.6g} in a box of {}, so that a cloud "
        "reaches over {:.6g} boxes, expected at most {:.0f}; check size.fixed, size.factor and the "
        "lengths' unit, or set map.periodic to false",
        largest, box.text(), boxes, most_boxes));
  }

  void place_block(std::size_t first, std::size_t count) {
    look_at(first, count);
    for (std::size_t j = 0; j < count; ++j) {
      const auto i = static_cast<std::uint32_t>(first + j);
      if (!block_.is_good(j)) {
        ++placed_.bad;
      } else if (may_have_images(j)) {
        place_images(i, block_.size[j], offset_in_reach(block_.offset_of(j)));
      } else {
        place_one(i, block_.size[j], {block_.right[j], block_.up[j], block_.depth[j]});
      }
    }
  }

  // Loops that compilers make vectors of.
  void look_at(std::size_t first, std::size_t count) {
    const float* const position = matter_.position.data() + 3 * first;
    for (std::size_t axis = 0; axis < 3; ++axis) {
      const double origin = matter_.origin.a[axis], center = geometry_.center.a[axis];
      for (std::size_t j = 0; j < count; ++j)
        block_.offset[axis][j] = origin + static_cast<double>(position[3 * j + axis]) - center;
    }
    along(geometry_.right, count, block_.right);
    along(geometry_.up, count, block_.up);
    along(geometry_.forward, count, block_.depth);
    for (std::size_t j = 0; j < count; ++j)
      block_.size[j] = matter_.size_of(first + j);
  }

  void along(const Vec3& axis, std::size_t count, std::array<double, Block::most>& places) const {
    const auto& [x, y, z] = block_.offset;
    for (std::size_t j = 0; j < count; ++j)
      places[j] = axis.a[0] * x[j] + axis.a[1] * y[j] + axis.a[2] * z[j];
  }

  double reach_of(double size) const { return reach_sigmas * sigma_ * size; }

  // Half of the picture and the depth, with the reach of a kernel where it counts.
  std::array<double, 3> half_extents(double reach) const {
    return {half_[0] + reach, half_[1] + reach, is_slice_ ? reach : half_[2]};
  }

  // How far from the middle an image may lie along an axis of the box.
  double reach_along(std::size_t axis, const std::array<double, 3>& half) const {
    return std::abs(geometry_.right.a[axis]) * half[0] + std::abs(geometry_.up.a[axis]) * half[1] +
           std::abs(geometry_.forward.a[axis]) * half[2];
  }

  // A little more on each side, so that rounding loses none: place_one decides.
  static constexpr double slack = 1e-6;

  bool is_only_image(std::size_t axis, double offset, const std::array<double, 3>& half) const {
    return std::abs(offset) + reach_along(axis, half) < (1 - slack) * (*geometry_.box)[axis];
  }

  bool may_have_images(std::size_t j) const {
    if (!geometry_.box) return false;
    const std::array<double, 3> half = half_extents(reach_of(block_.size[j]));
    for (std::size_t axis = 0; axis < 3; ++axis) {
      if (!is_only_image(axis, block_.offset[axis][j], half)) return true;
    }
    return false;
  }

  // Of a particle that is very far away, of its image in the box there, since an int holds no more
  // boxes.
  Vec3 offset_in_reach(Vec3 offset) const {
    constexpr double farthest = 1 << 30;
    for (std::size_t axis = 0; axis < 3; ++axis) {
      const double side = (*geometry_.box)[axis];
      if (std::abs(offset.a[axis]) > farthest * side)
        offset.a[axis] = std::remainder(offset.a[axis], side);
    }
    return offset;
  }

  void place_images(std::uint32_t i, double size, const Vec3& offset) {
    const std::array<double, 3> half = half_extents(reach_of(size));
    const BoxSides& box = *geometry_.box;
    std::array<int, 3> first{}, last{};
    for (std::size_t k = 0; k < 3; ++k) {
      // Of most particles no other image can be seen.
      if (is_only_image(k, offset.a[k], half)) continue;
      const double reach = reach_along(k, half);
      first[k] = static_cast<int>(std::ceil((-reach - offset.a[k]) / box[k] - slack));
      last[k] = static_cast<int>(std::floor((reach - offset.a[k]) / box[k] + slack));
    }
    for (int x = first[0]; x <= last[0]; ++x) {
      for (int y = first[1]; y <= last[1]; ++y) {
        for (int z = first[2]; z <= last[2]; ++z) {
          const Vec3 image = offset + Vec3{{x * box[0], y * box[1], z * box[2]}};
          place_one(i, size,
                    {dot(image, geometry_.right), dot(image, geometry_.up),
                     dot(image, geometry_.forward)});
        }
      }
    }
  }

  void place_one(std::uint32_t i, double h, const Seen& seen) {
    const std::array<double, 3> half = half_extents(reach_of(h));
    // The far face does not belong to the depth: a whole box has each particle once.
    if (seen.depth < -half[2] || seen.depth >= half[2]) return;
    if (std::abs(seen.right) > half[0] || std::abs(seen.up) > half[1]) return;
    const double x = seen.right / geometry_.pixel, y = -seen.up / geometry_.pixel,
                 size = h / geometry_.pixel;
    for (const double value : {x, y, 0.0})
      placed_.position.push_back(static_cast<float>(value));
    placed_.size.push_back(static_cast<float>(size));
    placed_.source.push_back(i);
    if (is_rough(i, h)) ++placed_.rough;
    const double width = sigma_ * size;
    placed_.share.push_back(static_cast<float>(share_between(x, 0.5 * geometry_.width, width) *
                                               share_between(y, 0.5 * geometry_.height, width)));
    if (!is_slice_) return;
    const double distance = seen.depth / geometry_.pixel / width;
    placed_.in_plane.push_back(std::exp(-distance * distance) / (std::sqrt(pi) * width));
  }

  bool is_rough(std::uint32_t i, double h) const {
    constexpr double rounding = 0x1p-24;
    const float* const place = matter_.position.data() + 3 * std::size_t{i};
    const float farthest = std::max({std::abs(place[0]), std::abs(place[1]), std::abs(place[2])});
    return rounding * static_cast<double>(farthest) > std::max(h, geometry_.pixel);
  }

  const MapMatter& matter_;
  const MapGeometry& geometry_;
  double sigma_;
  bool is_slice_;
  std::array<double, 3> half_;  // of the picture and the depth
  Block block_;
  PlacedParticles placed_;
};

}  // namespace

PlacedParticles place_particles(const MapMatter& matter, const MapGeometry& geometry, double sigma,
                                bool is_slice) {
  return Placer(matter, geometry, sigma, is_slice).place();
}

}  // namespace splotchcl
