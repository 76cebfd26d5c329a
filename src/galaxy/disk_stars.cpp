#include <algorithm>
#include <cmath>

#include "galaxy/even_points.h"
#include "galaxy/kinds.h"
#include "galaxy/plummer.h"
#include "scene/constants.h"

namespace splotchcl {
namespace {

constexpr double color_spread = 0.2;

// A star's own light against the mean of its neighbourhood; 1 on average over stars.
Light star_color(const Light& around, Random& random) {
  const double brightness = star_brightness(random);
  const double warmth = std::clamp(color_spread * random.normal(), -0.6, 0.6);
  return {brightness * (1 + warmth) * around[0], brightness * around[1],
          brightness * (1 - warmth) * around[2]};
}

}  // namespace

GalaxyParticles make_disk_stars(const LightMap& map, const BulgeProfile& bulge,
                                const GalaxySettings& settings) {
  Random random(settings.seed + 1);
  GalaxyParticles stars;
  const double width = settings.disk_width * map.radius();
  const double central_density =
      static_cast<double>(settings.disk_stars) / (2 * pi * width * width);
  const Vec3 axis = disk_axis(settings);
  const double jitter = jitter_between(settings.disk_stars);
  for (std::uint64_t i = 0; i < settings.disk_stars; ++i) {
    const Vec3 even = even_place(i, random, jitter);
    const double radius = width * std::sqrt(-2 * std::log1p(-even.a[0]));
    const double angle = 2 * pi * even.a[1];
    const Vec3 place = {{radius * std::cos(angle), radius * std::sin(angle),
                         settings.disk_height_kpc * normal_quantile(even.a[2])}};
    const Light around = bulge.rest(map.at({place.a[0], place.a[1]}), radius);
    const Light color = star_color(settings.disk_light * around, random);
    // Where stars are few each stands for a larger area. Dark places have none.
    const double density = central_density * std::exp(-radius * radius / (2 * width * width));
    if (mean(color) > 0) add_particle(stars, place, color, 1 / density, axis, radius);
  }
  return stars;
}

}  // namespace splotchcl
