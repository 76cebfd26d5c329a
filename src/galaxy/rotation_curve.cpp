#include "splotchcl/rotation_curve.h"

#include <fast_float/fast_float.h>
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <sstream>

#include "common/mapped_file.h"
#include "common/words.h"
#include "splotchcl/error.h"

namespace splotchcl {
namespace {

struct CurvePoint {
  double radius = 0, speed = 0;
};

// One number of a line, from `next` on; false when there is none.
bool take_number(const char*& next, const char* end, double& number) {
  while (next != end && (*next == ' ' || *next == '\t' || *next == ',' || *next == '\r'))
    ++next;
  const auto [after, error] = fast_float::from_chars(next, end, number);
  if (error != std::errc()) return false;
  next = after;
  return true;
}

CurvePoint parse_point(const std::string& line, const std::string& place) {
  const char* next = line.data();
  const char* const end = next + line.size();
  CurvePoint point;
  double excess = 0;
  const bool two = take_number(next, end, point.radius) && take_number(next, end, point.speed);
  if (!two || take_number(next, end, excess) || next != end) {
    throw DataError(fmt::format(
        "{}: found '{}', expected two numbers, a radius in kpc and a speed in km/s", place, line));
  }
  if (!std::isfinite(point.radius) || point.radius < 0) {
    throw DataError(
        fmt::format("{}: the radius is {}, expected a number >= 0", place, point.radius));
  }
  if (!std::isfinite(point.speed) || point.speed < 0) {
    throw DataError(fmt::format(
        "{}: the speed is {}, expected a number >= 0; which way a galaxy turns is an option of "
        "its own",
        place, point.speed));
  }
  return point;
}

std::string without_comment(const std::string& line) {
  const std::string text = line.substr(0, line.find('#'));
  const std::size_t last = text.find_last_not_of(" \t\r");
  return last == std::string::npos ? "" : text.substr(0, last + 1);
}

}  // namespace

RotationCurve RotationCurve::flat(double speed_km_s, double core_kpc) {
  if (!std::isfinite(speed_km_s) || speed_km_s < 0) {
    throw UsageError(
        fmt::format("the speed of the rotation curve is {}, expected km/s >= 0", speed_km_s));
  }
  if (!std::isfinite(core_kpc) || !(core_kpc > 0)) {
    throw UsageError(
        fmt::format("the core of the rotation curve is {}, expected kpc > 0", core_kpc));
  }
  RotationCurve curve;
  curve.speed_ = speed_km_s;
  curve.core_ = core_kpc;
  return curve;
}

RotationCurve RotationCurve::table(std::vector<double> radii_kpc, std::vector<double> speeds_km_s) {
  if (radii_kpc.size() != speeds_km_s.size() || radii_kpc.size() < 2) {
    throw UsageError(fmt::format(
        "a rotation curve of {} radii and {} speeds, expected as many of both and at least two",
        radii_kpc.size(), speeds_km_s.size()));
  }
  for (std::size_t i = 0; i < radii_kpc.size(); ++i) {
    const bool increases = i == 0 ? radii_kpc[i] >= 0 : radii_kpc[i] > radii_kpc[i - 1];
    if (!increases || !std::isfinite(radii_kpc[i])) {
      throw UsageError(fmt::format(
          "radius {} of a rotation curve is {}, expected finite radii >= 0 that increase", i,
          radii_kpc[i]));
    }
    if (!(speeds_km_s[i] >= 0) || !std::isfinite(speeds_km_s[i])) {
      throw UsageError(
          fmt::format("speed {} of a rotation curve is {}, expected km/s >= 0", i, speeds_km_s[i]));
    }
  }
  if (radii_kpc.front() == 0 && speeds_km_s.front() != 0) {
    throw UsageError(
        fmt::format("a rotation curve has the speed {} at radius 0, expected 0: nothing can circle "
                    "there; leave the point out",
                    speeds_km_s.front()));
  }
  RotationCurve curve;
  curve.radii_ = std::move(radii_kpc);
  curve.speeds_ = std::move(speeds_km_s);
  return curve;
}

double RotationCurve::speed(double radius_kpc) const {
  if (radii_.empty()) {
    return speed_ * radius_kpc / std::sqrt(radius_kpc * radius_kpc + core_ * core_);
  }
  if (radius_kpc >= radii_.back()) return speeds_.back();
  const auto above = static_cast<std::size_t>(
      std::upper_bound(radii_.begin(), radii_.end(), radius_kpc) - radii_.begin());
  if (above == 0) return speeds_.front() * radius_kpc / radii_.front();
  const double part = (radius_kpc - radii_[above - 1]) / (radii_[above] - radii_[above - 1]);
  return speeds_[above - 1] + part * (speeds_[above] - speeds_[above - 1]);
}

double RotationCurve::angular_speed(double radius_kpc) const {
  if (radii_.empty()) {
    return speed_ / std::sqrt(radius_kpc * radius_kpc + core_ * core_) / myr_per_kpc_s_km;
  }
  // The curve is straight from the centre to the first point above 0.
  const double first = radii_.front() > 0 ? radii_.front() : radii_[1];
  const double radius = std::max(radius_kpc, first);
  return speed(radius) / radius / myr_per_kpc_s_km;
}

RotationCurve parse_rotation_curve(const std::string& text, const std::string& name) {
  std::vector<double> radii, speeds;
  std::istringstream lines(text);
  int number = 0;
  for (std::string line; std::getline(lines, line);) {
    ++number;
    const std::string values = without_comment(line);
    if (values.find_first_not_of(" \t") == std::string::npos) continue;
    const std::string place = fmt::format("{}:{}", name, number);
    const CurvePoint point = parse_point(values, place);
    if (!radii.empty() && point.radius <= radii.back()) {
      throw DataError(
          fmt::format("{}: radius {} follows {}, expected radii that increase; sort the file by "
                      "its first column and keep one line for each radius",
                      place, point.radius, radii.back()));
    }
    radii.push_back(point.radius);
    speeds.push_back(point.speed);
  }
  if (radii.size() < 2) {
    throw DataError(fmt::format("{}: found {} with a radius and a speed, expected at least two",
                                name, counted(radii.size(), "line")));
  }
  try {
    return RotationCurve::table(std::move(radii), std::move(speeds));
  } catch (const UsageError& error) {
    throw DataError(name + ": " + error.what());
  }
}

RotationCurve read_rotation_curve(const std::filesystem::path& path) {
  return parse_rotation_curve(read_text_file(path), path.string());
}

}  // namespace splotchcl
