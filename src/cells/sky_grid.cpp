#include "cells/sky_grid.h"

#include <algorithm>
#include <boost/qvm/vec_operations.hpp>
#include <cmath>
#include <cstdint>

#include "scene/constants.h"

namespace splotchcl {
namespace {

// Of the twelve faces: in which row their southern corners lie, in rings of a whole face from the
// north pole, and at which longitude, in quarters of pi.
constexpr int row_of_face[] = {2, 2, 2, 2, 3, 3, 3, 3, 4, 4, 4, 4};
constexpr int longitude_of_face[] = {1, 3, 5, 7, 0, 2, 4, 6, 1, 3, 5, 7};

// Patches that are smaller have the same shape.
constexpr int most_known = 20;

// Of the pixels of a grid of such squares, the one that reaches farthest: at the edge of a cap.
double radius_of_part(double part) {
  const double angle = 0.25 * pi * part, z = 1 - (1 - part) * (1 - part) / 3;
  const double cosine =
      std::sqrt(5.0) / 3 * std::sqrt(std::max(0.0, 1 - z * z)) * std::cos(angle) + 2.0 / 3 * z;
  // A little more for small ones, whose cosine has no digits left.
  return part > 1e-3 ? std::acos(std::min(1.0, cosine)) : 1.07 * part;
}

// The bits of a number, with a place left free between each two.
std::uint64_t spread_bits(std::uint64_t bits) {
  std::uint64_t spread = 0;
  for (int i = 0; i < 32; ++i)
    spread |= (bits >> i & 1) << (2 * i);
  return spread;
}

}  // namespace

bool is_healpix_side(int nside) {
  return nside > 0 && nside <= most_healpix_sides && (nside & (nside - 1)) == 0;
}

HealpixGrid::HealpixGrid(int nside, HealpixOrder order) : nside_(nside), order_(order) {
  for (int level = 0; level <= most_known; ++level)
    radius_.push_back(radius_of_part(std::ldexp(1, -level)));
}

std::size_t HealpixGrid::cells() const {
  return 12 * static_cast<std::size_t>(nside_) * static_cast<std::size_t>(nside_);
}

std::vector<SkyPatch> HealpixGrid::faces() const {
  std::vector<SkyPatch> all;
  const double side = nside_;
  for (int face = 0; face < 12; ++face)
    all.push_back({face, 0, 0, side, side});
  return all;
}

std::size_t HealpixGrid::ring_number(int face, int x, int y) const {
  const std::int64_t n = nside_, ring = row_of_face[face] * n - x - y - 1;
  const std::int64_t pixels = 12 * n * n;
  std::int64_t in_quarter = n, before = 0, shift = 0;
  if (ring < n) {
    in_quarter = ring;
    before = 2 * ring * (ring - 1);
  } else if (ring > 3 * n) {
    in_quarter = 4 * n - ring;
    before = pixels - 2 * in_quarter * (in_quarter + 1);
  } else {
    before = 2 * n * (n - 1) + (ring - n) * 4 * n;
    shift = (ring - n) & 1;
  }
  std::int64_t along = (longitude_of_face[face] * in_quarter + x - y + 1 + shift) / 2;
  if (along > 4 * in_quarter) along -= 4 * in_quarter;
  if (along < 1) along += 4 * in_quarter;
  return static_cast<std::size_t>(before + along - 1);
}

std::size_t HealpixGrid::cell(int face, int x, int y) const {
  if (order_ == HealpixOrder::ring) return ring_number(face, x, y);
  const auto side = static_cast<std::size_t>(nside_);
  return static_cast<std::size_t>(face) * side * side + spread_bits(static_cast<std::uint64_t>(x)) +
         2 * spread_bits(static_cast<std::uint64_t>(y));
}

double HealpixGrid::solid_angle(std::size_t /*cell*/) const {
  return 4 * pi / static_cast<double>(cells());
}

double HealpixGrid::density(int /*face*/, double /*x*/, double /*y*/) const {
  return solid_angle(0);
}

// In rings of a face from the north pole; those in the caps get shorter to the poles.
Vec3 HealpixGrid::direction(int face, double x, double y) const {
  const double ring = row_of_face[face] - (x + y) / nside_, beside = (x - y) / nside_;
  const double from_pole = std::min(ring, 4 - ring);  // of the nearer pole
  double z = (2 - ring) * 2 / 3, square = 1 - z * z, longitude = longitude_of_face[face] + beside;
  if (from_pole < 1) {
    const double height = from_pole * from_pole / 3;  // below the pole
    z = ring < 2 ? 1 - height : height - 1;
    square = height * (2 - height);
    if (from_pole > 0) longitude = longitude_of_face[face] + beside / from_pole;
  }
  const double angle = longitude * pi / 4, radius = std::sqrt(std::max(0.0, square));
  return {{radius * std::cos(angle), radius * std::sin(angle), z}};
}

double HealpixGrid::radius(const SkyPatch& patch) const {
  const int level = std::max(0, -std::ilogb(std::max(patch.width, patch.height) / nside_));
  const auto known = static_cast<std::size_t>(level);
  return known < radius_.size() ? radius_[known] : std::ldexp(radius_.back(), most_known - level);
}

double HealpixGrid::longest_side(const SkyPatch& patch) const {
  constexpr double stretch = 1.2;  // over the side of a square as large
  return stretch * std::sqrt(patch.width * patch.height * solid_angle(0));
}

bool HealpixGrid::is_bent(const SkyPatch& patch) const {
  if (patch.face >= 4 && patch.face < 8) return false;
  const double low = patch.x + patch.y, high = low + patch.width + patch.height;
  const double pole = patch.face < 4 ? high - 2 * nside_ : low;
  return (low < nside_ && high > nside_) || pole == 0;
}

std::optional<std::size_t> HealpixGrid::cell_at(const Vec3& direction) const {
  const double z = direction.a[2], size = std::abs(z);
  double quarters = std::atan2(direction.a[1], direction.a[0]) / (0.5 * pi);
  if (quarters < 0) quarters += 4;
  double x = 0, y = 0;  // in faces
  int face = 0;
  if (size <= 2.0 / 3) {
    const double rising = 0.5 + quarters - 0.75 * z, falling = 0.5 + quarters + 0.75 * z;
    const int up = static_cast<int>(std::floor(rising)),
              down = static_cast<int>(std::floor(falling));
    face = up == down ? (up & 3) + 4 : up < down ? (up & 3) : (down & 3) + 8;
    x = falling - down;
    y = 1 - (rising - up);
  } else {
    const int quarter = std::min(3, static_cast<int>(quarters));
    const double along = quarters - quarter;
    const double square = direction.a[0] * direction.a[0] + direction.a[1] * direction.a[1];
    const double ring = std::sqrt(3 * square / (1 + size));  // from the pole
    face = z > 0 ? quarter : quarter + 8;
    x = z > 0 ? 1 - (1 - along) * ring : along * ring;
    y = z > 0 ? 1 - along * ring : (1 - along) * ring;
  }
  const auto place = [this](double part) {
    return std::clamp(static_cast<int>(part * nside_), 0, nside_ - 1);
  };
  return cell(face, place(x), place(y));
}

namespace {

using namespace boost::qvm;

Vec3 direction_to(double longitude, double latitude) {
  return {{std::cos(latitude) * std::cos(longitude), std::cos(latitude) * std::sin(longitude),
           std::sin(latitude)}};
}

}  // namespace

PictureOfTheSky::PictureOfTheSky(Projection projection, int width, int height, double longitude,
                                 double latitude, double pixel)
    : projection_(projection),
      width_(width),
      height_(height),
      longitude_(longitude * pi / 180),
      latitude_(latitude * pi / 180),
      pixel_(pixel * pi / 180),
      middle_(direction_to(longitude_, latitude_)),
      left_({{-std::sin(longitude_), std::cos(longitude_), 0}}),
      up_(cross(middle_, left_)) {}

std::size_t PictureOfTheSky::cells() const {
  return static_cast<std::size_t>(width_) * static_cast<std::size_t>(height_);
}

std::vector<SkyPatch> PictureOfTheSky::faces() const {
  return {{0, 0, 0, static_cast<double>(width_), static_cast<double>(height_)}};
}

std::size_t PictureOfTheSky::cell(int /*face*/, int x, int y) const {
  return static_cast<std::size_t>(y) * static_cast<std::size_t>(width_) +
         static_cast<std::size_t>(x);
}

bool PictureOfTheSky::has_all_of_the_sky() const {
  constexpr double rounding = 1e-9;
  return projection_ == Projection::car && std::abs(width_ * pixel_ - 2 * pi) < rounding &&
         latitude_at(0) >= 0.5 * pi - rounding && latitude_at(height_) <= -0.5 * pi + rounding;
}

double PictureOfTheSky::latitude_at(double y) const {
  return latitude_ + (0.5 * height_ - y) * pixel_;
}

Vec3 PictureOfTheSky::direction(int /*face*/, double x, double y) const {
  const double left = (0.5 * width_ - x) * pixel_, up = (0.5 * height_ - y) * pixel_;
  if (projection_ == Projection::car)
    return direction_to(longitude_ + left, std::clamp(latitude_ + up, -0.5 * pi, 0.5 * pi));
  return normalized(middle_ + left * left_ + up * up_);
}

double PictureOfTheSky::density(int /*face*/, double x, double y) const {
  if (projection_ == Projection::car) {
    const double latitude = latitude_at(y);
    return std::abs(latitude) < 0.5 * pi ? pixel_ * pixel_ * std::cos(latitude) : 0;
  }
  const double left = (0.5 * width_ - x) * pixel_, up = (0.5 * height_ - y) * pixel_;
  return pixel_ * pixel_ / std::pow(1 + left * left + up * up, 1.5);
}

// Of a plane: a quarter of the sum over the signs of the corners (a rectangle's solid angle).
double PictureOfTheSky::solid_angle(std::size_t cell) const {
  const std::size_t row = cell / static_cast<std::size_t>(width_);
  const auto y = static_cast<double>(row);
  const auto x = static_cast<double>(cell - row * static_cast<std::size_t>(width_));
  if (projection_ == Projection::car) {
    const auto height = [](double latitude) {
      return std::sin(std::clamp(latitude, -0.5 * pi, 0.5 * pi));
    };
    return pixel_ * (height(latitude_at(y)) - height(latitude_at(y + 1)));
  }
  // Small pixels would be differences of large numbers: by two by two points instead.
  constexpr double low = 0.21132486540518711775;
  double sum = 0;
  for (const double dx : {low, 1 - low}) {
    for (const double dy : {low, 1 - low})
      sum += 0.25 * density(0, x + dx, y + dy);
  }
  return sum;
}

double PictureOfTheSky::radius(const SkyPatch& patch) const {
  return std::min(pi, 0.5 * pixel_ * std::hypot(patch.width, patch.height) * 1.0000001);
}

// Near a pole the other one is far shorter.
double PictureOfTheSky::longest_side(const SkyPatch& patch) const {
  return pixel_ * std::max(patch.width, patch.height);
}

bool PictureOfTheSky::is_bent(const SkyPatch& /*patch*/) const {
  return false;
}

std::optional<std::size_t> PictureOfTheSky::cell_at(const Vec3& direction) const {
  double left = 0, up = 0;
  if (projection_ == Projection::car) {
    left = std::remainder(std::atan2(direction.a[1], direction.a[0]) - longitude_, 2 * pi);
    up = std::asin(std::clamp(direction.a[2], -1.0, 1.0)) - latitude_;
  } else {
    const double along = dot(direction, middle_);
    if (!(along > 0)) return std::nullopt;
    left = dot(direction, left_) / along;
    up = dot(direction, up_) / along;
  }
  const double x = 0.5 * width_ - left / pixel_, y = 0.5 * height_ - up / pixel_;
  if (!(x >= 0 && y >= 0 && x < width_ && y < height_)) return std::nullopt;
  return cell(0, static_cast<int>(x), static_cast<int>(y));
}

}  // namespace splotchcl
