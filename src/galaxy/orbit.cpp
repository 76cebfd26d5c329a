#include <cmath>

#include "splotchcl/turning_galaxy.h"

namespace splotchcl {
namespace {

using boost::qvm::cross;
using boost::qvm::dot;

struct Turn {
  double angle = 0;
  double stretch = 1;  // of the distance from the axis
};

Turn first_order_step(double angle) {
  return {std::atan(angle), std::sqrt(1 + angle * angle)};
}

Turn turn_of(double angular_speed, double myr, const TurningSettings& settings) {
  if (settings.integrator == OrbitIntegrator::exact) return {angular_speed * myr, 1};
  const double steps = std::floor(myr / settings.step_myr);
  const Turn step = first_order_step(angular_speed * settings.step_myr);
  const Turn rest = first_order_step(angular_speed * (myr - steps * settings.step_myr));
  return {steps * step.angle + rest.angle, std::pow(step.stretch, steps) * rest.stretch};
}

Vec3 turned(const Vec3& vector, const Vec3& axis, double angle, double stretch) {
  const Vec3 along = axis * dot(axis, vector);
  const Vec3 across = vector - along;
  return along + (across * std::cos(angle) + cross(axis, across) * std::sin(angle)) * stretch;
}

}  // namespace

OrbitState move_on_orbit(const OrbitState& start, const Vec3& axis, double angular_speed,
                         double myr, const TurningSettings& settings) {
  const Turn turn = turn_of(angular_speed, myr, settings);
  return {turned(start.position, axis, turn.angle, turn.stretch),
          turned(start.velocity, axis, turn.angle, 1)};
}

}  // namespace splotchcl
