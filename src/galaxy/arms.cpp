#include <algorithm>
#include <cmath>
#include <vector>

#include "galaxy/disk_types.h"
#include "galaxy/vector_at.h"
#include "scene/constants.h"
#include "snapshot/field_names.h"
#include "splotchcl/snapshot.h"
#include "splotchcl/turning_galaxy.h"

namespace splotchcl {
namespace {

struct DiskMatter {
  double radius = 0, light = 0, angular_speed = 0;  // kpc, any unit, radians per Myr
};

void add_matter(std::vector<DiskMatter>& all, const Snapshot& galaxy, int type,
                const TurningSettings& settings) {
  const Column position = galaxy.read(type, "position"), velocity = galaxy.read(type, "velocity");
  const Column radius = galaxy.read(type, "OrbitRadius"), axis = galaxy.read(type, "OrbitAxis");
  const Column mass = galaxy.read(type, "mass"), color = galaxy.read(type, "Color");
  for (std::size_t i = 0; i < radius.size(); ++i) {
    DiskMatter matter;
    matter.radius = static_cast<double>(radius[i]);
    matter.light = static_cast<double>(mass[i]) *
                   static_cast<double>(color[3 * i] + color[3 * i + 1] + color[3 * i + 2]);
    matter.angular_speed =
        settings.curve ? settings.curve->angular_speed(matter.radius)
                       : shown_angular_speed({vector_at(position, i), vector_at(velocity, i)},
                                             vector_at(axis, i));
    all.push_back(matter);
  }
}

// Around a radius.
double mean_angular_speed(const std::vector<DiskMatter>& all, double radius) {
  double sum = 0, weight = 0;
  for (const DiskMatter& matter : all) {
    if (std::abs(matter.radius / radius - 1) > 0.1) continue;
    sum += matter.light * matter.angular_speed;
    weight += matter.light;
  }
  return weight > 0 ? sum / weight : 0;
}

// That holds half of the light.
double half_light_radius(std::vector<DiskMatter> all) {
  std::sort(all.begin(), all.end(),
            [](const DiskMatter& a, const DiskMatter& b) { return a.radius < b.radius; });
  double total = 0, inside = 0;
  for (const DiskMatter& matter : all)
    total += matter.light;
  for (const DiskMatter& matter : all) {
    inside += matter.light;
    if (inside >= total / 2) return matter.radius;
  }
  return 0;
}

}  // namespace

std::optional<double> arms_hold_myr(const Snapshot& galaxy, const TurningSettings& settings) {
  if (settings.pattern_speed) return std::nullopt;
  std::vector<DiskMatter> all;
  for (const ParticleTypeInfo& type : galaxy.info().types) {
    const bool shines = find_field(type, "Color") != nullptr && has_masses(type);
    if (is_disk_type(type.type) && shines) add_matter(all, galaxy, type.type, settings);
  }
  const double radius = half_light_radius(all);
  if (!(radius > 0)) return std::nullopt;
  constexpr double ratio = 1.25;
  const double shear =
      std::abs(mean_angular_speed(all, radius * ratio) - mean_angular_speed(all, radius / ratio)) /
      (2 * std::log(ratio));
  constexpr double pitch = 20 * pi / 180;
  constexpr double least_shear = 1e-3;  // of the angular speed: less is rounding
  const bool shears = shear > least_shear * mean_angular_speed(all, radius);
  return shears ? std::optional(1 / (std::tan(pitch) * shear)) : std::nullopt;
}

}  // namespace splotchcl
