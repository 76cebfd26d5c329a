#include "film/dome/dome_test_frame.h"

#include <fmt/format.h>

#include <algorithm>
#include <boost/qvm/vec_operations.hpp>
#include <cmath>
#include <string>

#include "finish/overlay.h"
#include "scene/constants.h"
#include "scene/projection.h"

namespace splotchcl {
namespace {

constexpr double degrees = 180 / pi;

constexpr Light thin_light = {0.12F, 0.12F, 0.12F}, thick_light = {0.45F, 0.45F, 0.45F};
constexpr Light front_light = {0.9F, 0.08F, 0.06F}, right_light = {0.06F, 0.6F, 0.1F};
constexpr Light left_light = {0.08F, 0.2F, 0.95F}, back_light = {0.8F, 0.8F, 0.8F};
constexpr Light zenith_light = {0.9F, 0.75F, 0.1F}, cross_light = {0.9F, 0.75F, 0.1F};

// From the nearest multiple of a step.
double from_multiple(double value, double step) {
  return std::abs(std::remainder(value, step));
}

// In front, to the right, behind and to the left.
Light light_of_side(double azimuth) {
  switch (static_cast<int>(std::lround(azimuth / 90)) & 3) {
    case 0:
      return front_light;
    case 1:
      return right_light;
    case 2:
      return back_light;
    default:
      return left_light;
  }
}

class TestFrame {
 public:
  TestFrame(const Camera& camera, int width, int height)
      : camera_(camera),
        frame_(make_camera_frame(camera, width, height)),
        image_(width, height),
        canvas_(image_, {0, 0, width, height}),
        side_(std::min(width, height)),
        line_(std::max(1.0, side_ / 1000.0)) {}

  Image draw() {
    for (int y = 0; y < image_.height; ++y) {
      for (int x = 0; x < image_.width; ++x)
        draw_pixel(x, y);
    }
    draw_cross();
    draw_words();
    return std::move(image_);
  }

 private:
  // How much of a pixel a line of this width covers, so far from its middle, in pixels.
  static float coverage(double distance, double width) {
    return static_cast<float>(std::clamp(0.5 * width - distance + 0.5, 0.0, 1.0));
  }

  void draw_pixel(int x, int y) {
    image_.at(x, y)[3] = 1;
    const DomePlace place = dome_place_at(x + 0.5, y + 0.5, frame_);
    const double from_zenith = 90 - place.altitude;
    if (from_zenith > 0.5 * field_of_view_degrees(camera_) + degrees / frame_.focal_pixels) return;
    const double pixels = frame_.focal_pixels / degrees;  // per degree of altitude
    // Nearer to the zenith lines of azimuth would run into each other.
    constexpr double last_thin = 75, last_thick = 85;
    const double across = pixels * from_zenith;
    const auto azimuth_line = [&](double step) {
      return across * std::sin(std::min(from_multiple(place.azimuth, step) / degrees, 0.5 * pi));
    };
    if (place.altitude < last_thin)
      canvas_.cover(x, y, thin_light, coverage(azimuth_line(10), line_));
    canvas_.cover(x, y, thin_light, coverage(pixels * from_multiple(place.altitude, 5), line_));
    if (place.altitude < last_thick)
      canvas_.cover(x, y, thick_light, coverage(azimuth_line(30), 1.5 * line_));
    const bool is_zenith = from_multiple(place.altitude - 90, 180) < 2.5;
    if (!is_zenith)
      canvas_.cover(x, y, thick_light,
                    coverage(pixels * from_multiple(place.altitude, 15), 2 * line_));
    canvas_.cover(x, y, light_of_side(place.azimuth), coverage(azimuth_line(90), 3 * line_));
    canvas_.cover(x, y, light_of_side(place.azimuth),
                  coverage(pixels * std::abs(place.altitude), 4 * line_));
    canvas_.cover(x, y, zenith_light, coverage(std::abs(across - pixels), 2 * line_));
  }

  // At the place of the look-at point.
  void draw_cross() {
    using namespace boost::qvm;
    const Vec3 to = along_axes(camera_.look_at - camera_.position, frame_);
    const auto place = project_point(to, frame_, Projection::fisheye);
    if (!place) return;
    const double length = 0.02 * side_, half = line_;
    canvas_.fill({place->x - length, place->y - half, place->x + length, place->y + half},
                 cross_light);
    canvas_.fill({place->x - half, place->y - length, place->x + half, place->y + length},
                 cross_light);
  }

  // Seen from the middle of the dome, up is towards the zenith.
  void draw_words() {
    const Font font("DejaVuSans-Bold");
    const double altitude = 10;
    put(font, "FRONT", 0.04, {0, altitude}, front_light);
    put(font, "RIGHT", 0.04, {90, altitude}, right_light);
    put(font, "BACK", 0.04, {180, altitude}, back_light);
    put(font, "LEFT", 0.04, {270, altitude}, left_light);
    for (int ring = 15; ring < 90; ring += 15) {
      for (const double side : {0.0, 90.0, 180.0, 270.0})
        put(font, std::to_string(ring), 0.014, {side + 4, ring + 1.5}, back_light);
    }
    const std::string tilt =
        camera_.dome_tilt_degrees
            ? fmt::format(", look-at point {:g} above the rim", *camera_.dome_tilt_degrees)
            : "";
    put(font,
        fmt::format("{} x {}, {:g} degrees{}", image_.width, image_.height,
                    field_of_view_degrees(camera_), tilt),
        0.014, {0, 52.5}, back_light);
  }

  // The middle of a text at a place, turned by as many quarters as its side is.
  void put(const Font& font, const std::string& text, double size, const DomePlace& place,
           const Light& light) {
    TextMask mask = font.draw(text, size * side_);
    const int quarters = static_cast<int>(std::lround(place.azimuth / 90)) & 3;
    for (int i = 0; i < quarters; ++i)
      mask = turned(mask);
    const double radius = frame_.focal_pixels * (90 - place.altitude) / degrees;
    const double angle = place.azimuth / degrees;
    const double x = frame_.center_x + radius * std::sin(angle) - 0.5 * mask.width;
    const double y = frame_.center_y + radius * std::cos(angle) - 0.5 * mask.height;
    canvas_.stamp(mask, static_cast<int>(std::lround(x)), static_cast<int>(std::lround(y)), light);
  }

  const Camera& camera_;
  CameraFrame frame_;
  Image image_;
  Canvas canvas_;
  double side_, line_;  // in pixels
};

}  // namespace

DomePlace dome_place_at(double x, double y, const CameraFrame& camera) {
  const Vec3 direction = direction_at(x, y, camera, Projection::fisheye);
  const double across = std::hypot(direction.a[0], direction.a[1]);
  double azimuth = std::atan2(direction.a[0], direction.a[1]) * degrees;
  if (azimuth < 0) azimuth += 360;
  return {azimuth, std::atan2(direction.a[2], across) * degrees};
}

Image draw_dome_test_frame(const Camera& camera, int width, int height) {
  return TestFrame(camera, width, height).draw();
}

}  // namespace splotchcl
