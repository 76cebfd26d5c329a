#pragma once

#include <filesystem>
#include <string>
#include <vector>

namespace splotchcl {

// The speed of circular orbits by radius: kpc and km/s.
class RotationCurve {
 public:
  // v(r) = speed r / sqrt(r^2 + core^2): turns like a solid body inside the core, flat
  // outside. Throws UsageError for a speed below 0 or a core that is not above 0.
  static RotationCurve flat(double speed_km_s = 200, double core_kpc = 1);

  // Linear between the points, in proportion to the radius inside the first one, constant
  // outside the last. Throws UsageError unless there are at least two points with increasing
  // radii > 0 (a first point at radius 0 must have speed 0) and finite speeds >= 0.
  static RotationCurve table(std::vector<double> radii_kpc, std::vector<double> speeds_km_s);

  double speed(double radius_kpc) const;  // km/s, at a radius >= 0
  // Radians per Myr; at radius 0 the limit from outside.
  double angular_speed(double radius_kpc) const;

 private:
  double speed_ = 0, core_ = 1;         // of the flat curve
  std::vector<double> radii_, speeds_;  // of a table; empty: flat
};

// Two columns of numbers, radius in kpc and speed in km/s; "#" begins a comment. Throws
// DataError that names file and line.
RotationCurve read_rotation_curve(const std::filesystem::path& path);
RotationCurve parse_rotation_curve(const std::string& text, const std::string& name_for_messages);

// A kpc per (km/s), in Myr: 3.0856775814913673e16 km over 3.15576e13 s, a million Julian years.
constexpr double myr_per_kpc_s_km = 977.7922216807891;

}  // namespace splotchcl
