#include "surroundings/columns_around.h"

#include <algorithm>
#include <array>
#include <boost/qvm/vec_operations.hpp>
#include <cmath>
#include <cstdint>
#include <cstring>
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

using Columns = PixelsOfRow::OfPixels<double>;

double least_of(const Columns& values, std::size_t count) {
  return *std::min_element(values.begin(), values.begin() + static_cast<std::ptrdiff_t>(count));
}

// Loops over pixels go on to whole vectors.
std::size_t whole_vectors(std::size_t count) {
  return (count + 7) / 8 * 8;
}

// exp(-y) for 0 <= y <= 700, relative error 1e-14, as compilers can work it out for several
// numbers at a time (kernels/common/double_lanes.cl has the same).
double exp_of_minus(double y) {
  constexpr double magic = 6755399441055744.0;  // 1.5 * 2^52: rounds to an integer in the low bits
  const double shifted = y * -1.4426950408889634 + magic;
  const double n = shifted - magic;
  const double r = (-y - n * 0.69314718036912382) - n * 1.9082149292705877e-10;
  double p = r * 2.505210838544172e-8 + 2.755731922398589e-7;
  p = p * r + 2.7557319223985893e-6;
  p = p * r + 2.48015873015873e-5;
  p = p * r + 1.984126984126984e-4;
  p = p * r + 1.3888888888888889e-3;
  p = p * r + 8.333333333333333e-3;
  p = p * r + 4.1666666666666664e-2;
  p = p * r + 1.6666666666666666e-1;
  p = p * r + 0.5;
  p = p * r + 1.0;
  p = p * r + 1.0;
  std::uint64_t power = 0, bits = 0;
  std::memcpy(&power, &shifted, sizeof(power));
  std::memcpy(&bits, &p, sizeof(bits));
  bits += power << 52;
  std::memcpy(&p, &bits, sizeof(p));
  return p;
}

// exp(-distance2) of so many, and 0 beyond the farthest. In steps that compilers make vectors of:
// where what is worked out depends on a condition, they branch.
void find_profiles(std::size_t lanes, double farthest2, const Columns& distance2,
                   Columns& profiles) {
  constexpr double least = 700;  // exp(-700)
  Columns limited;
  for (std::size_t k = 0; k < lanes; ++k)
    limited[k] = distance2[k] < least ? distance2[k] : least;
  for (std::size_t k = 0; k < lanes; ++k)
    limited[k] = exp_of_minus(limited[k]);
  for (std::size_t k = 0; k < lanes; ++k)
    profiles[k] = distance2[k] <= farthest2 ? limited[k] : 0;
}

// The mean of exp(-(t - center)^2 / sigma^2) over a pixel.
double mean_profile(double center, double sigma, int pixel) {
  // Turned so that both ends count from below: differences of erfc keep their digits.
  double low = (pixel - center) / sigma, high = (pixel + 1 - center) / sigma;
  if (low + high < 0) {
    std::swap(low, high);
    low = -low;
    high = -high;
  }
  return 0.5 * std::sqrt(pi) * sigma * (std::erfc(low) - std::erfc(high));
}

// The mean of exp(-u^2) over a pixel's width, of its value at the pixel's center: u^2 there.
double mean_of_value(double u2, double inverse_sigma2) {
  return 1 + inverse_sigma2 * ((u2 - 0.5) / 6 + inverse_sigma2 * ((u2 * (4 * u2 - 12) + 3) / 480));
}

bool is_cut_away(const SplatAround& splat, int x, int y, const KernelSettings& kernel) {
  if (!kernel.cut) return false;
  const double dx = (x + 0.5 - splat.x) / splat.sigma_x, dy = (y + 0.5 - splat.y) / splat.sigma_y;
  if (dx * dx + dy * dy <= *kernel.cut * *kernel.cut) return false;
  const bool holds_center = std::floor(splat.x) == x && std::floor(splat.y) == y;
  return !(kernel.sampling == Sampling::mean && holds_center);
}

// The column that a ray finds in front of the camera, of a cloud of central column 1. Rays that
// pass the center farther away than the square root of `farthest2` find nothing.
bool add_rays(const CloudAround& cloud, const PixelsOfRow& pixels, Columns& columns) {
  // erfc(6) is below what doubles tell 1 from.
  constexpr double all_in_front = 6;
  const std::size_t lanes = whole_vectors(pixels.count);
  const double cx = cloud.center.a[0], cy = cloud.center.a[1], cz = cloud.center.a[2];
  Columns distance2, before;
  for (std::size_t k = 0; k < lanes; ++k) {
    const double x = pixels.right[k], y = pixels.down[k], z = pixels.forward[k];
    const double across_x = cy * z - cz * y, across_y = cz * x - cx * z, across_z = cx * y - cy * x;
    distance2[k] = across_x * across_x + across_y * across_y + across_z * across_z;
    before[k] = cx * x + cy * y + cz * z;
  }
  if (least_of(distance2, pixels.count) > cloud.farthest2) return false;
  find_profiles(lanes, cloud.farthest2, distance2, columns);
  for (std::size_t k = 0; k < lanes; ++k)
    columns[k] *= cloud.ray;
  if (least_of(before, pixels.count) >= all_in_front) return true;
  for (std::size_t k = 0; k < pixels.count; ++k) {
    if (columns[k] > 0 && before[k] < all_in_front) columns[k] *= 0.5 * std::erfc(-before[k]);
  }
  return true;
}

// By values at the pixels' centers, and derivatives there if means are wanted.
bool add_wide_splat(const SplatAround& splat, double part, double farthest2,
                    const PixelsOfRow& pixels, Sampling sampling, Columns& columns) {
  const double dy = (pixels.y + 0.5 - splat.y) / splat.sigma_y, y2 = dy * dy;
  if (y2 > farthest2) return false;
  const double inverse_x = 1 / splat.sigma_x, inverse_y = 1 / splat.sigma_y;
  const bool by_means = sampling == Sampling::mean;
  const double along_y = part * (by_means ? mean_of_value(y2, inverse_y * inverse_y) : 1);
  const double bend = by_means ? inverse_x * inverse_x : 0;
  const std::size_t lanes = whole_vectors(pixels.count);
  Columns x2, distance2, profiles;
  for (std::size_t k = 0; k < lanes; ++k) {
    const double dx = (pixels.x[k] + 0.5 - splat.x) * inverse_x;
    x2[k] = dx * dx;
    distance2[k] = x2[k] + y2;
  }
  if (least_of(distance2, pixels.count) > farthest2) return false;
  find_profiles(lanes, farthest2, distance2, profiles);
  for (std::size_t k = 0; k < lanes; ++k)
    columns[k] += profiles[k] * mean_of_value(x2[k], bend) * along_y;
  return true;
}

bool add_narrow_splat(const SplatAround& splat, double part, const PixelsOfRow& pixels,
                      Columns& columns) {
  const double along_y = part * mean_profile(splat.y, splat.sigma_y, pixels.y);
  if (along_y == 0) return false;
  for (std::size_t k = 0; k < pixels.count; ++k)
    columns[k] += along_y * mean_profile(splat.x, splat.sigma_x, pixels.x[k]);
  return true;
}

bool add_splat(const SplatAround& splat, const CloudAround& cloud, const PixelsOfRow& pixels,
               Sampling sampling, double wide_sigma, Columns& columns) {
  const bool is_wide = splat.sigma_x > wide_sigma && splat.sigma_y > wide_sigma;
  if (sampling == Sampling::mean && !is_wide)
    return add_narrow_splat(splat, cloud.splat, pixels, columns);
  return add_wide_splat(splat, cloud.splat, cloud.farthest2, pixels, sampling, columns);
}

bool add_cut_splat(const SplatAround& splat, const CloudAround& cloud, const PixelsOfRow& pixels,
                   const KernelSettings& kernel, double wide_sigma, Columns& columns) {
  Columns whole{};
  if (!add_splat(splat, cloud, pixels, kernel.sampling, wide_sigma, whole)) return false;
  for (std::size_t k = 0; k < pixels.count; ++k) {
    if (!is_cut_away(splat, pixels.x[k], pixels.y, kernel)) columns[k] += whole[k];
  }
  return true;
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

PixelsOfRow::PixelsOfRow(const int* columns, std::size_t pixel_count, int row, const Frame& frame)
    : count(pixel_count), y(row) {
  for (std::size_t k = 0; k < count; ++k) {
    x[k] = columns[k];
    const Vec3 seen = direction_at(x[k] + 0.5, row + 0.5, frame.camera, frame.projection);
    right[k] = seen.a[0];
    down[k] = seen.a[1];
    forward[k] = seen.a[2];
  }
}

// The first derivative that is left out is below 3.8e-4 / sigma^6.
double sigma_of_means_by_values(double error) {
  return std::pow(3.8e-4 / error, 1.0 / 6);
}

bool columns_around(const CloudAround& cloud, const PixelsOfRow& pixels,
                    const KernelSettings& kernel, double wide_sigma, Columns& columns) {
  std::fill_n(columns.begin(), whole_vectors(pixels.count), 0.0);
  bool is_seen = cloud.ray > 0 && add_rays(cloud, pixels, columns);
  for (const SplatAround& splat : cloud.splats) {
    is_seen |= kernel.cut ? add_cut_splat(splat, cloud, pixels, kernel, wide_sigma, columns)
                          : add_splat(splat, cloud, pixels, kernel.sampling, wide_sigma, columns);
  }
  return is_seen;
}

}  // namespace splotchcl
