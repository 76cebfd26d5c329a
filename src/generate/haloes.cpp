#include "generate/haloes.h"

#include <algorithm>
#include <cmath>
#include <utility>

namespace splotchcl {
namespace {

// Contrast, in linear theory, of a ball that has collapsed.
constexpr double collapse_contrast = 1.686;
constexpr double ratio_of_radii = 1.2;

bool is_peak(const PeriodicGrid& grid, int x, int y, int z) {
  const float value = grid.at(x, y, z);
  for (int i = 0; i < 27; ++i) {
    const int dx = i % 3 - 1;
    const int dy = i / 3 % 3 - 1;
    const int dz = i / 9 - 1;
    if (i != 13 && grid.at(x + dx, y + dy, z + dz) >= value) return false;
  }
  return true;
}

struct Peak {
  float contrast;
  Vec3 place;
};

std::vector<Peak> find_peaks(const PeriodicGrid& grid) {
  std::vector<Peak> peaks;
  const int side = grid.side();
  for (int x = 0; x < side; ++x) {
    for (int y = 0; y < side; ++y) {
      for (int z = 0; z < side; ++z) {
        if (grid.at(x, y, z) < collapse_contrast || !is_peak(grid, x, y, z)) continue;
        const double cell = 1.0 / side;
        peaks.push_back({grid.at(x, y, z), {{x * cell, y * cell, z * cell}}});
      }
    }
  }
  std::stable_sort(peaks.begin(), peaks.end(),
                   [](const Peak& a, const Peak& b) { return a.contrast > b.contrast; });
  return peaks;
}

bool lies_in_one_of(const std::vector<Halo>& haloes, const Vec3& place) {
  return std::any_of(haloes.begin(), haloes.end(), [&](const Halo& halo) {
    return boost::qvm::mag(periodic_difference(place, halo.birthplace)) < halo.birth_radius;
  });
}

}  // namespace

Vec3 periodic_difference(const Vec3& a, const Vec3& b) {
  Vec3 difference;
  for (int axis = 0; axis < 3; ++axis) {
    const double d = b.a[axis] - a.a[axis];
    difference.a[axis] = d - std::round(d);
  }
  return difference;
}

std::vector<Halo> find_haloes(const SmoothedContrast& contrast, double largest_radius,
                              double smallest_radius) {
  std::vector<Halo> haloes;
  for (double radius = largest_radius; radius >= smallest_radius; radius /= ratio_of_radii) {
    for (const Peak& peak : find_peaks(contrast(radius))) {
      if (lies_in_one_of(haloes, peak.place)) continue;
      // A peak that is higher than needed would still do in a larger ball.
      const double excess = static_cast<double>(peak.contrast) / collapse_contrast;
      haloes.push_back({peak.place, radius * std::min(excess, ratio_of_radii), peak.place});
    }
  }
  return haloes;
}

HaloMap::HaloMap(const std::vector<Halo>& haloes, int side)
    : side_(side),
      halo_(static_cast<std::size_t>(side) * static_cast<std::size_t>(side) *
                static_cast<std::size_t>(side),
            none) {
  // Backwards, so that larger haloes, which come first, take what they overlap.
  for (std::size_t index = haloes.size(); index-- > 0;) {
    const Halo& halo = haloes[index];
    const int reach = static_cast<int>(std::ceil(halo.birth_radius * side)) + 1;
    int center[3];
    for (int axis = 0; axis < 3; ++axis) {
      center[axis] = static_cast<int>(std::floor(halo.birthplace.a[axis] * side));
    }
    for (int dx = -reach; dx <= reach; ++dx) {
      for (int dy = -reach; dy <= reach; ++dy) {
        for (int dz = -reach; dz <= reach; ++dz) {
          const Vec3 cell = {{(center[0] + dx + 0.5) / side, (center[1] + dy + 0.5) / side,
                              (center[2] + dz + 0.5) / side}};
          const Vec3 offset = periodic_difference(halo.birthplace, cell);
          if (boost::qvm::mag(offset) >= halo.birth_radius) continue;
          halo_[cell_of(cell)] = static_cast<int>(index);
        }
      }
    }
  }
}

int HaloMap::at(const Vec3& birthplace) const {
  return halo_[cell_of(birthplace)];
}

std::size_t HaloMap::cell_of(const Vec3& place) const {
  std::size_t index = 0;
  for (int axis = 0; axis < 3; ++axis) {
    const int cell = static_cast<int>(std::floor(place.a[axis] * side_));
    index = index * static_cast<std::size_t>(side_) +
            static_cast<std::size_t>((cell % side_ + side_) % side_);
  }
  return index;
}

}  // namespace splotchcl
