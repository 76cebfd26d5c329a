#include "cells/healpix_grid.h"

#include <algorithm>
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

}  // namespace splotchcl
