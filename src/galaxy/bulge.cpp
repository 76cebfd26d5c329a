#include <cmath>

#include "galaxy/kinds.h"
#include "galaxy/plummer.h"

namespace splotchcl {

GalaxyParticles make_bulge(const BulgeProfile& bulge, const GalaxySettings& settings) {
  Random random(settings.seed + 2);
  GalaxyParticles stars;
  if (!(mean(bulge.peak()) > 0)) return stars;
  const double mass = bulge.area() / static_cast<double>(settings.bulge_stars);
  for (std::uint64_t i = 0; i < settings.bulge_stars; ++i) {
    const double radius = settings.bulge_radius_kpc * plummer_radius(random);
    Vec3 place = random.direction() * radius;
    place.a[2] *= settings.bulge_flattening;
    add_particle(stars, place, star_brightness(random) * bulge.peak(), mass,
                 axis_across(place, random), boost::qvm::mag(place));
  }
  return stars;
}

}  // namespace splotchcl
