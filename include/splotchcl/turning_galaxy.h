#pragma once

#include <filesystem>
#include <memory>
#include <optional>
#include <string>

#include "splotchcl/rotation_curve.h"
#include "splotchcl/vector.h"

// How the particles of a galaxy circle its center. Times are in Myr.
namespace splotchcl {

class Snapshot;

enum class OrbitIntegrator {
  exact,        // circles
  first_order,  // x += v dt, as in the paper: each step leaves the circle along its tangent
};

// How, and how fast.
struct TurningSettings {
  OrbitIntegrator integrator = OrbitIntegrator::exact;
  double step_myr = 1;                 // of the first-order integrator, > 0
  std::optional<RotationCurve> curve;  // unset: the speeds that the snapshot's velocities show
  // Of gas, disk stars and dust in km/s/kpc, > 0: the arms turn as a whole, like a wave that matter
  // runs through. Unset: each particle at the speed of its own orbit.
  std::optional<double> pattern_speed;
};

// Throws DataError for a snapshot whose particles have no orbits.
void check_orbits(const Snapshot& galaxy);

// How long the arms of a galaxy that splotchcl galaxy made hold, in Myr. The inner disk overtakes
// the outer: the tangent of the pitch angle i of an arm at a radius r falls as
// 1 / tan i(t) = 1 / tan i(0) + t |d angular speed / d ln r|. This is the time after which that of
// an arm of 20 degrees, where half of the disk's light is inside, has halved. Unset where arms
// hold for ever: with a pattern's speed, or where all turns alike. Throws as reading does.
std::optional<double> arms_hold_myr(const Snapshot& galaxy, const TurningSettings& settings);
// A line for the user where a time is longer than that.
std::optional<std::string> turning_warning(double myr, std::optional<double> hold_myr);

// A place and a velocity on an orbit about an axis through the origin, after a time.
struct OrbitState {
  Vec3 position, velocity;
};
// `axis` has length 1; `angular_speed` is in radians per Myr. Exact circles keep distance and
// height. n steps dt of the first order multiply the distance from the axis by
// (1 + (angular_speed dt)^2)^(n/2) and turn by n atan(angular_speed dt); what is left of the
// time is a shorter step. Velocities turn along, and keep their length.
OrbitState move_on_orbit(const OrbitState& start, const Vec3& axis, double angular_speed,
                         double myr, const TurningSettings& settings);

// A galaxy as `splotchcl galaxy` makes it, at any time. Every particle keeps the angular speed
// of its OrbitRadius about its OrbitAxis, or that of the pattern.
class TurningGalaxy {
 public:
  // Throws DataError for a snapshot without orbits, UsageError for a step or a pattern's speed that
  // is not above 0.
  TurningGalaxy(std::shared_ptr<const Snapshot> galaxy, TurningSettings settings);

  // The snapshot with its positions and velocities as they are then; all else is as it was.
  std::shared_ptr<const Snapshot> at(double myr) const;

  const std::shared_ptr<const Snapshot>& start() const { return galaxy_; }

 private:
  std::shared_ptr<const Snapshot> galaxy_;
  TurningSettings settings_;
};

// Writes any snapshot whose fields are those of a galaxy, as write_galaxy does. Throws DataError.
void write_galaxy_snapshot(const std::filesystem::path& path, const Snapshot& snapshot, double myr);

}  // namespace splotchcl
