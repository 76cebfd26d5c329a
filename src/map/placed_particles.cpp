#include "map/placed_particles.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

#include "scene/constants.h"
#include "splotchcl/error.h"

namespace splotchcl {
namespace {

using namespace boost::qvm;

// Beyond this many sigma is 2e-16 of a particle.
constexpr double reach_sigmas = 6;

// Of a kernel around x, how much lies between -half and half: with all its digits, however little.
double share_between(double x, double half, double sigma) {
  const double away = std::abs(x);
  if (half - away > reach_sigmas * sigma) return 1;
  return 0.5 * (std::erfc((away - half) / sigma) - std::erfc((away + half) / sigma));
}

class Placer {
 public:
  Placer(const MapMatter& matter, const MapGeometry& geometry, double sigma, bool is_slice)
      : matter_(matter), geometry_(geometry), sigma_(sigma), is_slice_(is_slice) {}

  PlacedParticles place() {
    if (matter_.count > std::numeric_limits<std::uint32_t>::max()) {
      throw DataError("found more than 4294967295 particles, expected fewer in one map");
    }
    check_reach();
    reserve();
    for (std::size_t i = 0; i < matter_.count; ++i) {
      if (matter_.is_good(i)) {
        place_images(static_cast<std::uint32_t>(i));
      } else {
        ++placed_.bad;
      }
    }
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

  // Of a particle from the map's middle; of one that is very far away, of its image in the box
  // there, since an int holds no more boxes.
  Vec3 offset_of(std::uint32_t i) const {
    constexpr double farthest = 1 << 30;
    Vec3 offset = matter_.position_of(i) - geometry_.center;
    for (std::size_t axis = 0; axis < 3 && geometry_.box; ++axis) {
      const double side = (*geometry_.box)[axis];
      if (std::abs(offset.a[axis]) > farthest * side)
        offset.a[axis] = std::remainder(offset.a[axis], side);
    }
    return offset;
  }

  // Half of the picture and the depth, with the reach of a kernel where it counts.
  std::array<double, 3> half_extents(double reach) const {
    const double depth = is_slice_         ? reach
                         : geometry_.depth ? 0.5 * *geometry_.depth
                                           : std::numeric_limits<double>::infinity();
    return {0.5 * geometry_.width * geometry_.pixel + reach,
            0.5 * geometry_.height * geometry_.pixel + reach, depth};
  }

  void place_images(std::uint32_t i) {
    const double h = matter_.size_of(i);
    const std::array<double, 3> half = half_extents(reach_sigmas * sigma_ * h);
    const Vec3 offset = offset_of(i);
    if (!geometry_.box) {
      place_one(i, h, offset, half);
      return;
    }
    const BoxSides& box = *geometry_.box;
    std::array<int, 3> first{}, last{};
    for (std::size_t k = 0; k < 3; ++k) {
      const double reach = std::abs(geometry_.right.a[k]) * half[0] +
                           std::abs(geometry_.up.a[k]) * half[1] +
                           std::abs(geometry_.forward.a[k]) * half[2];
      // A little more on each side, so that rounding loses none: place_one decides.
      constexpr double slack = 1e-6;
      // Of most particles no other image can be seen.
      if (std::abs(offset.a[k]) + reach < (1 - slack) * box[k]) continue;
      first[k] = static_cast<int>(std::ceil((-reach - offset.a[k]) / box[k] - slack));
      last[k] = static_cast<int>(std::floor((reach - offset.a[k]) / box[k] + slack));
    }
    for (int x = first[0]; x <= last[0]; ++x) {
      for (int y = first[1]; y <= last[1]; ++y) {
        for (int z = first[2]; z <= last[2]; ++z) {
          const Vec3 shift = {{x * box[0], y * box[1], z * box[2]}};
          place_one(i, h, offset + shift, half);
        }
      }
    }
  }

  void place_one(std::uint32_t i, double h, const Vec3& offset, const std::array<double, 3>& half) {
    const double right = dot(offset, geometry_.right), up = dot(offset, geometry_.up),
                 depth = dot(offset, geometry_.forward);
    // The far face does not belong to the depth: a whole box has each particle once.
    if (depth < -half[2] || depth >= half[2]) return;
    if (std::abs(right) > half[0] || std::abs(up) > half[1]) return;
    const double x = right / geometry_.pixel, y = -up / geometry_.pixel, size = h / geometry_.pixel;
    for (const double value : {x, y, 0.0})
      placed_.position.push_back(static_cast<float>(value));
    placed_.size.push_back(static_cast<float>(size));
    placed_.source.push_back(i);
    const double width = sigma_ * size;
    placed_.share.push_back(static_cast<float>(share_between(x, 0.5 * geometry_.width, width) *
                                               share_between(y, 0.5 * geometry_.height, width)));
    if (!is_slice_) return;
    const double distance = depth / geometry_.pixel / width;
    placed_.in_plane.push_back(std::exp(-distance * distance) / (std::sqrt(pi) * width));
  }

  const MapMatter& matter_;
  const MapGeometry& geometry_;
  double sigma_;
  bool is_slice_;
  PlacedParticles placed_;
};

}  // namespace

PlacedParticles place_particles(const MapMatter& matter, const MapGeometry& geometry, double sigma,
                                bool is_slice) {
  return Placer(matter, geometry, sigma, is_slice).place();
}

}  // namespace splotchcl
