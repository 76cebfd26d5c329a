#pragma once

#include "galaxy/light_map.h"
#include "generate/random.h"
#include "splotchcl/galaxy.h"

// The kinds of matter that a galaxy is made of: positions, colours and orbits. Each draws from a
// sequence of random numbers of its own, so that one does not change with another.
namespace splotchcl {

GalaxyParticles make_gas(const LightMap& map, const BulgeProfile& bulge,
                         const GalaxySettings& settings);
GalaxyParticles make_disk_stars(const LightMap& map, const BulgeProfile& bulge,
                                const GalaxySettings& settings);
GalaxyParticles make_bulge(const BulgeProfile& bulge, const GalaxySettings& settings);
GalaxyParticles make_dust(const LightMap& map, const GalaxySettings& settings);
GalaxyParticles make_clusters(const LightMap& map, const GalaxySettings& settings);

// One more particle; its smoothing length and velocity follow later.
void add_particle(GalaxyParticles& particles, const Vec3& place, const Light& color, double mass,
                  const Vec3& orbit_axis, double orbit_radius);

// About the disk's axis, the way the galaxy turns.
Vec3 disk_axis(const GalaxySettings& settings);

}  // namespace splotchcl
