#include <cmath>

#include "galaxy/even_points.h"
#include "galaxy/kinds.h"
#include "galaxy/plummer.h"
#include "scene/constants.h"

namespace splotchcl {

GalaxyParticles make_bulge(const BulgeProfile& bulge, const GalaxySettings& settings) {
  Random random(settings.seed + 2);
  GalaxyParticles stars;
  if (!(mean(bulge.peak()) > 0)) return stars;
  const double mass = bulge.area() / static_cast<double>(settings.bulge_stars);
  const double jitter = jitter_between(settings.bulge_stars);
  for (std::uint64_t i = 0; i < settings.bulge_stars; ++i) {
    const Vec3 even = even_place(i, random, jitter);
    const double radius = settings.bulge_radius_kpc * plummer_radius(1 - even.a[0]);
    const double along = 2 * even.a[1] - 1, across = std::sqrt(1 - along * along);
    const double angle = 2 * pi * even.a[2];
    const Vec3 place = Vec3{{across * std::cos(angle), across * std::sin(angle),
                             settings.bulge_flattening * along}} *
                       radius;
    add_particle(stars, place, star_brightness(random) * bulge.peak(), mass,
                 axis_across(place, random), boost::qvm::mag(place));
  }
  return stars;
}

}  // namespace splotchcl
