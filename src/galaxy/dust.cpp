#include <cmath>

#include "galaxy/even_points.h"
#include "galaxy/kinds.h"

namespace splotchcl {

// A particle's mass times its colour is what it absorbs: an optical depth times an area.
GalaxyParticles make_dust(const LightMap& map, const GalaxySettings& settings) {
  Random random(settings.seed + 4);
  GalaxyParticles dust;
  const double area = map.plane().area_of_pixel() / settings.dust_points;
  const Vec3 axis = disk_axis(settings);
  constexpr double least_depth = 0.01;  // less is not seen
  PointsOfPixels points(settings.dust_points);
  for (int y = 0; y < map.picture().height; ++y) {
    for (int x = 0; x < map.picture().width; ++x) {
      const double depth = map.dust().depth(x, y);
      points.begin(x, y, random);
      if (depth < least_depth) continue;
      for (int i = 0; i < settings.dust_points; ++i) {
        const DiskPlane::Point disk = map.plane().in_disk(points.place(i));
        const double height = settings.dust_height_kpc * normal_quantile(points.layer(i, random));
        add_particle(dust, {{disk[0], disk[1], height}}, map.dust().opacity(), depth * area, axis,
                     std::hypot(disk[0], disk[1]));
      }
    }
  }
  return dust;
}

}  // namespace splotchcl
