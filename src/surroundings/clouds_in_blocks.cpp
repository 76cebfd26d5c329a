#include "surroundings/clouds_in_blocks.h"

#include <algorithm>
#include <array>
#include <boost/qvm/vec_operations.hpp>
#include <cmath>
#include <numeric>

#include "parallel/for_blocks.h"
#include "scene/ceil_divide.h"
#include "scene/constants.h"
#include "scene/projection.h"

namespace splotchcl {
namespace {

constexpr int block_pixels = 32;
// Of the nodes farther beside the picture (smooth_picture.cpp), which are few, each looks at all
// clouds.
constexpr int pixels_beside = 64;
constexpr int first_block = -pixels_beside / block_pixels;  // along both axes

int block_of(int pixel) {
  return pixel >= 0 ? pixel / block_pixels : -ceil_divide(-pixel, block_pixels);
}

// All directions that a block's pixels see lie within `half_angle` of its axis.
struct BlockOfPixels {
  int left, top;
  Vec3 axis;
  double half_angle, cosine, sine;
};

// Rays find a cloud within an angle of its center, of this cosine and sine. (One that leads away
// from it finds exp(-D^2) / 2 of it at most.)
struct ConeOfRays {
  explicit ConeOfRays(const CloudAround& cloud) {
    using namespace boost::qvm;
    const double distance2 = mag_sqr(cloud.center);
    is_found = cloud.ray > 0;
    is_everywhere = is_found && distance2 <= cloud.farthest2;
    if (!is_found || is_everywhere) return;
    direction = cloud.center / std::sqrt(distance2);
    sine = std::sqrt(cloud.farthest2 / distance2);
    cosine = std::sqrt(1 - sine * sine);
  }

  bool meets(const BlockOfPixels& block) const {
    if (!is_found || is_everywhere) return is_found;
    // Angles that together are more than half a turn meet everywhere.
    if (block.half_angle >= 0.5 * pi) return true;
    constexpr double rounding = 1e-12;
    const double cosine_of_both = cosine * block.cosine - sine * block.sine;
    return boost::qvm::dot(direction, block.axis) >= cosine_of_both - rounding;
  }

  bool is_found, is_everywhere;
  Vec3 direction{};
  double cosine = 0, sine = 0;
};

// Of unit vectors. It tells small angles apart, of which the cosine knows little.
double chord2_between(const Vec3& a, const Vec3& b) {
  return boost::qvm::mag_sqr(a - b);
}

double angle_of_chord2(double chord2) {
  return 2 * std::asin(std::min(0.5 * std::sqrt(chord2), 1.0));
}

// Directions are looked at every few pixels: those between are no farther off than neighbors are
// from one another.
BlockOfPixels make_block(int left, int top, const Frame& frame) {
  constexpr int step = 4;
  constexpr std::size_t samples = block_pixels / step + 1;
  const auto direction = [&](int column, int row) {
    return direction_at(left + column * step, top + row * step, frame.camera, frame.projection);
  };
  BlockOfPixels block = {left, top, direction(samples / 2, samples / 2), 0, 1, 0};
  double farthest2 = 0, apart2 = 0;
  std::array<std::array<Vec3, samples>, samples> seen;
  for (std::size_t row = 0; row < samples; ++row) {
    for (std::size_t column = 0; column < samples; ++column) {
      const Vec3 here = direction(static_cast<int>(column), static_cast<int>(row));
      seen[row][column] = here;
      farthest2 = std::max(farthest2, chord2_between(block.axis, here));
      if (column > 0) apart2 = std::max(apart2, chord2_between(seen[row][column - 1], here));
      if (row > 0) apart2 = std::max(apart2, chord2_between(seen[row - 1][column], here));
    }
  }
  block.half_angle = angle_of_chord2(farthest2) + angle_of_chord2(apart2);
  block.cosine = std::cos(block.half_angle);
  block.sine = std::sin(block.half_angle);
  return block;
}

// Of a range of a block's pixels.
bool reaches(double place, double reach, int first) {
  return place + reach >= first && place - reach <= first + block_pixels;
}

bool is_splat_in(const CloudAround& cloud, const BlockOfPixels& block) {
  // The mean over a pixel reaches half a pixel farther.
  const double farthest = std::sqrt(cloud.farthest2);
  return std::any_of(cloud.splats.begin(), cloud.splats.end(), [&](const SplatAround& splat) {
    return reaches(splat.x, farthest * splat.sigma_x + 1, block.left) &&
           reaches(splat.y, farthest * splat.sigma_y + 1, block.top);
  });
}

}  // namespace

CloudsInBlocks::CloudsInBlocks(const std::vector<CloudAround>& clouds, std::size_t first,
                               std::size_t end, const Frame& frame)
    : clouds_(clouds),
      frame_(frame),
      columns_(block_of(frame.width + pixels_beside) + 1 - first_block),
      rows_(block_of(frame.height + pixels_beside) + 1 - first_block),
      all_(end - first) {
  std::iota(all_.begin(), all_.end(), static_cast<std::uint32_t>(first));
}

void CloudsInBlocks::look_through_blocks() const {
  of_blocks_.resize(static_cast<std::size_t>(columns_) * static_cast<std::size_t>(rows_));
  std::vector<ConeOfRays> cones;
  for (const std::uint32_t number : all_)
    cones.emplace_back(clouds_[number]);
  for_blocks(of_blocks_.size(), 4, [&](std::size_t from, std::size_t to) {
    for (std::size_t b = from; b < to; ++b) {
      const int column = first_block + static_cast<int>(b) % columns_;
      const int row = first_block + static_cast<int>(b) / columns_;
      const BlockOfPixels block = make_block(column * block_pixels, row * block_pixels, frame_);
      std::copy_if(
          all_.begin(), all_.end(), std::back_inserter(of_blocks_[b]), [&](std::uint32_t number) {
            return cones[number - all_.front()].meets(block) || is_splat_in(clouds_[number], block);
          });
    }
  });
}

const std::vector<std::uint32_t>& CloudsInBlocks::at(int x, int y, int spacing) const {
  const int column = block_of(x) - first_block, row = block_of(y) - first_block;
  // A block of one pixel would be looked at more closely than that pixel.
  if (spacing >= block_pixels) return all_;
  if (column < 0 || column >= columns_ || row < 0 || row >= rows_) return all_;
  std::call_once(are_known_, [this] { look_through_blocks(); });
  return of_blocks_[static_cast<std::size_t>(row) * static_cast<std::size_t>(columns_) +
                    static_cast<std::size_t>(column)];
}

}  // namespace splotchcl
