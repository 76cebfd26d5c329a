#include "adversary/trial_frame.h"

#include <boost/qvm/vec_operations.hpp>

#include "adversary/places.h"
#include "between/interpolation.h"
#include "device/scenes.h"
#include "scene/projection.h"
#include "testing.h"

namespace splotchcl::adversary {
namespace {

using namespace boost::qvm;

// A camera at the origin that looks along z, x to the right and y downwards, or along no axis.
Frame empty_frame_of(const Trial& trial) {
  const Rectangle crop = crop_of(trial);
  const int size = whole(trial.picture_size);
  Frame frame =
      size > 0 ? test::empty_frame(size, size) : test::empty_frame(crop.width, crop.height);
  frame.crop = crop;
  frame.projection = trial.projection;
  if (trial.turned > 0) {
    // Of whole numbers whose squares add up to 15^2.
    frame.camera.right = Vec3{{14, 5, 2}} / 15.0;
    frame.camera.down = Vec3{{-2, 10, -11}} / 15.0;
    frame.camera.forward = Vec3{{-5, 10, 10}} / 15.0;
  }
  const double half_view = 0.5 * trial.field_of_view * pi / 180;
  switch (trial.projection) {
    case Projection::orthographic:
      break;
    case Projection::perspective:
      frame.camera.focal_pixels = 0.5 * frame.width / std::tan(half_view);
      break;
    case Projection::cube:
      frame.camera.focal_pixels = 0.5 * frame.width;
      break;
    case Projection::fisheye: {
      // From half of all directions to nearly all.
      const double half_angle = trial.dome > 0 ? 0.5 * pi + half_view : half_view;
      frame.camera.focal_pixels = 0.5 * std::min(frame.width, frame.height) / half_angle;
      break;
    }
    case Projection::equirectangular:
      frame.camera.focal_pixels = frame.width / (2 * pi);
      break;
  }
  frame.camera.pixels_per_length = frame.camera.focal_pixels;
  if (trial.eye > 0) {
    frame.camera.eye_offset = trial.left_eye > 0 ? -trial.eye : trial.eye;
    frame.camera.turn_axis = frame.camera.down * -1.0;
  }
  if (trial.original > 0) frame.camera = in_original_convention(frame.camera);
  frame.background.fill(trial.background);
  frame.tolerance = trial.tolerance;
  frame.through_clouds = trial.around > 0;
  frame.kernel.width = 1;
  frame.kernel.sampling = trial.sampling;
  if (trial.cut > 0) frame.kernel.cut = trial.cut;
  frame.kernel.min_radius_pixels = trial.min_radius;
  frame.kernel.footprint_pixels = trial.footprint;
  return frame;
}

// The length of a pixel of the usual depth.
double pixel_of(const Trial& trial) {
  const Frame frame = empty_frame_of(trial);
  const double depth = frame.projection == Projection::orthographic ? 1 : 10;
  return depth / frame.camera.focal_pixels;
}

// Where a particle lies, along the camera's axes, that is seen at this place of the picture.
Vec3 in_camera(double x, double y, double depth, const Frame& frame) {
  const double right = (x - frame.camera.center_x) / frame.camera.focal_pixels;
  const double down = (y - frame.camera.center_y) / frame.camera.focal_pixels;
  switch (frame.projection) {
    case Projection::orthographic:
      return {{right, down, depth}};
    case Projection::perspective:
    case Projection::cube:
      return {{right * depth, down * depth, depth}};
    case Projection::fisheye: {
      const double angle = std::min(std::hypot(right, down), pi);
      const double part = angle > 0 ? std::sin(angle) / std::hypot(right, down) : 1;
      return {{depth * part * right, depth * part * down, depth * std::cos(angle)}};
    }
    case Projection::equirectangular:
      break;
  }
  const double latitude = std::clamp(down, -0.499 * pi, 0.499 * pi);
  return {{depth * std::cos(latitude) * std::sin(right), depth * std::sin(latitude),
           depth * std::cos(latitude) * std::cos(right)}};
}

struct ParticleArrays {
  bool own_colors;
  double decades;
  std::vector<float> position = {}, h = {}, mass = {}, color = {}, own_color = {};

  void add(const Place& place, double copies, const Frame& frame) {
    const Vec3 seen = in_camera(place.x, place.y, place.depth, frame);
    const auto projected = project_point(seen, frame.camera, frame.projection);
    const Vec3 at = frame.camera.right * seen.a[0] + frame.camera.down * seen.a[1] +
                    frame.camera.forward * seen.a[2];
    const double scale = projected ? projected->pixels_per_length : 1;
    const double sigma = place.sigma;
    const double peak_of_column = own_colors ? place.group->color : 1;
    const double column = place.group->peak / peak_of_column / std::min(1.0, pi * sigma * sigma);
    const double size = sigma / scale;
    for (const double coordinate : at.a)
      position.push_back(static_cast<float>(coordinate));
    h.push_back(static_cast<float>(size));
    mass.push_back(static_cast<float>(copies) * short_float(column * pi * size * size));
    color.push_back(static_cast<float>(decades > 0 ? std::pow(10, decades * place.group->hue)
                                                   : place.group->hue));
    const auto own = static_cast<float>(place.group->color);
    own_color.insert(own_color.end(), {own, 0.7f * own, 0.3f * own});
  }

  // Far beside the picture and faint.
  void add_filler() {
    position.insert(position.end(), {-1e6f, -1e6f, 1.0f});
    h.push_back(1);
    mass.push_back(1e-3f);
    color.push_back(1);
    own_color.insert(own_color.end(), {1, 1, 1});
  }

 private:
  // Of 14 bits, so that up to 1024 times as much is exact in single precision.
  static float short_float(double value) {
    int exponent = 0;
    const double mantissa = std::frexp(value, &exponent);
    return static_cast<float>(std::ldexp(std::round(std::ldexp(mantissa, 14)), exponent - 14));
  }
};

Palette palette_of(const Trial& trial) {
  constexpr Rgb warm = {1.0f, 0.3f, 0.05f}, cold = {0.2f, 0.6f, 1.0f}, red = {1, 0, 0},
                blue = {0, 0.5f, 1};
  Palette palette;
  // Colors that change often are those that are dark where the others are bright.
  const bool is_dark = trial.knots > 2;
  for (int k = 0; k < std::max(whole(trial.knots), 2); ++k)
    palette.emission.push_back(k % 2 == 0 ? (is_dark ? red : warm) : (is_dark ? blue : cold));
  return palette;
}

// Where a particle goes between two snapshots follows from where it is: copies stay together.
Vec3 way_of(const float* position, double length) {
  const double number = std::fmod(
      1e3 * std::abs(static_cast<double>(position[0] + 2 * position[1] + 3 * position[2])), 1.0);
  const double angle = 2 * pi * number;
  return {{length * std::cos(angle), length * std::sin(angle), 0.3 * length * std::sin(3 * angle)}};
}

std::shared_ptr<const IdMatch> same_particles(std::size_t count) {
  IdMatch match;
  match.place_in_second.resize(count);
  std::iota(match.place_in_second.begin(), match.place_in_second.end(), 0U);
  match.in_common = count;
  return std::make_shared<const IdMatch>(std::move(match));
}

// At the trial's part of the way particles are where, and as wide as, the others have them.
void put_between_snapshots(const Trial& trial, ParticleArrays& arrays, Particles& particles) {
  constexpr double growth = 3;  // of a width, from one snapshot to the other
  const double f = trial.between;
  ColumnBetween places, widths;
  places.match = widths.match = same_particles(arrays.h.size());
  places.fraction = widths.fraction = static_cast<float>(f);
  std::vector<float> first = arrays.position, second = arrays.position;
  for (std::size_t i = 0; i < arrays.h.size(); ++i) {
    const Vec3 way = way_of(&arrays.position[3 * i], trial.motion * pixel_of(trial));
    for (std::size_t axis = 0; axis < 3; ++axis) {
      first[3 * i + axis] -= static_cast<float>(f * way.a[axis]);
      second[3 * i + axis] += static_cast<float>((1 - f) * way.a[axis]);
    }
  }
  places.kind = ColumnBetween::Kind::position;
  places.values_per_particle = 3;
  places.first = Column::owning(std::move(first));
  places.second = Column::owning(std::move(second));
  PathSetting setting;
  const double side = trial.box * pixel_of(trial);
  if (side > 0) setting.period = PeriodicRange{{{-0.5 * side, -0.5 * side, -0.5 * side}}, side};
  places.path = make_path_numbers(setting, f);
  widths.kind = ColumnBetween::Kind::logarithmic;
  std::vector<float> narrow, wide;
  for (const float h : arrays.h) {
    narrow.push_back(h * static_cast<float>(std::pow(growth, -f)));
    wide.push_back(h * static_cast<float>(std::pow(growth, 1 - f)));
  }
  widths.first = Column::owning(std::move(narrow));
  widths.second = Column::owning(std::move(wide));
  particles.position = column_between(std::move(places));
  particles.smoothing_length = column_between(std::move(widths));
}

DrawnComponent component_of(const Trial& trial, ParticleArrays arrays) {
  DrawnComponent component;
  if (trial.decades > 0) component.color = {Scaling::log, 0, trial.decades};
  component.particles.count = arrays.h.size();
  if (trial.between > 0 && !arrays.h.empty()) {
    put_between_snapshots(trial, arrays, component.particles);
  } else {
    component.particles.position = Column::owning(std::move(arrays.position));
    component.particles.smoothing_length = Column::owning(std::move(arrays.h));
  }
  component.particles.weight = Column::owning(std::move(arrays.mass));
  component.particles.color = Column::owning(std::move(arrays.color));
  if (arrays.own_colors)
    component.particles.color_vector = Column::owning(std::move(arrays.own_color));
  component.palette = palette_of(trial);
  return component;
}

std::vector<Rgb> absorption_of(const Trial& trial) {
  const auto left = static_cast<float>(1 - trial.tint);
  return {Rgb{1, left, left}, Rgb{0.3f, 0.1f * left, 0.5f * left}};
}

void choose_light(const Trial& trial, DrawnComponent& component) {
  using Kind = Absorption::Kind;
  switch (trial.light) {
    case Light::emission:
      component.absorption.kind = Kind::none;
      break;
    case Light::proportional:
      component.absorption.kind = Kind::as_emission;
      break;
    case Light::factor:
    case Light::stars_among_gas:
    case Light::two_sources:
      component.absorption = {Kind::factor, 1 / trial.source};
      break;
    case Light::ordered:
      component.absorption = {Kind::factor, 1 / trial.source};
      component.palette.absorption = absorption_of(trial);
      break;
    case Light::gray:
      component.absorption = {Kind::gray, trial.source};
      break;
  }
}

bool is_star(const CloudGroup& group, const Trial& trial) {
  const bool has_stars = trial.light == Light::stars_among_gas || trial.light == Light::two_sources;
  return has_stars && group.star > 0;
}

// Of one source nothing would have to be in order.
double distinct_source(const Trial& trial) {
  return trial.star_source == trial.source ? 2 * trial.source : trial.star_source;
}

// As an inset's: on a cloud of the picture, in a part of its field of view.
CameraFrame inset_camera(const Trial& trial, const Frame& frame) {
  const auto seen =
      std::find_if(frame.components.begin(), frame.components.end(),
                   [](const DrawnComponent& component) { return component.particles.count > 0; });
  if (seen == frame.components.end()) return frame.camera;
  const Column& position = seen->particles.position;
  Camera camera;
  camera.projection = Projection::perspective;
  camera.look_at = {{static_cast<double>(position[0]), static_cast<double>(position[1]),
                     static_cast<double>(position[2])}};
  camera.sky = {{0.1, -1, 0.2}};
  camera.field_of_view_degrees = trial.inset * trial.field_of_view;
  return make_camera_frame(camera, frame.width, frame.height);
}

Frame with_light(const Trial& trial, Frame frame, ParticleArrays gas, ParticleArrays stars) {
  frame.components = {component_of(trial, std::move(gas))};
  choose_light(trial, frame.components.front());
  if (trial.light != Light::stars_among_gas && trial.light != Light::two_sources) return frame;
  frame.components.push_back(component_of(trial, std::move(stars)));
  Absorption& of_stars = frame.components.back().absorption;
  of_stars.kind = Absorption::Kind::none;
  if (trial.light == Light::two_sources)
    of_stars = {Absorption::Kind::factor, 1 / distinct_source(trial)};
  return frame;
}

Frame with_components(const Trial& trial, Frame frame, ParticleArrays gas, ParticleArrays stars) {
  frame = with_light(trial, std::move(frame), std::move(gas), std::move(stars));
  if (trial.inset > 0) {
    frame.camera = inset_camera(trial, frame);
    frame.projection = Projection::perspective;
  }
  return frame;
}

// Among the filler, every so-many-th.
bool is_turn_of_filler(std::size_t next, const Trial& trial) {
  const auto offset = static_cast<std::size_t>(trial.offset);
  const auto period = static_cast<std::size_t>(trial.period);
  if (period == 0) return false;
  return next < offset || (next - offset) % period != 0;
}

}  // namespace

Frame make_frame(const Trial& trial) {
  const Frame frame = empty_frame_of(trial);
  const std::vector<Place> places = places_of(trial);
  ParticleArrays gas{trial.own_colors > 0, trial.decades}, stars = gas;
  auto filler = static_cast<std::size_t>(trial.filler);
  for (const Place& place : places) {
    for (int copy = 0; copy < place.copies; ++copy) {
      for (; filler > 0 && is_turn_of_filler(gas.h.size(), trial); --filler)
        gas.add_filler();
      (is_star(*place.group, trial) ? stars : gas).add(place, 1, frame);
    }
  }
  for (; filler > 0; --filler)
    gas.add_filler();
  return with_components(trial, frame, std::move(gas), std::move(stars));
}

Frame make_merged_frame(const Trial& trial) {
  const Frame frame = empty_frame_of(trial);
  const std::vector<Place> places = places_of(trial);
  ParticleArrays gas{trial.own_colors > 0, trial.decades}, stars = gas;
  for (const Place& place : places) {
    const int times = trial.light == Light::gray ? place.copies : 1;
    const double copies = trial.light == Light::gray ? 1 : place.copies;
    for (int i = 0; i < times; ++i)
      (is_star(*place.group, trial) ? stars : gas).add(place, copies, frame);
  }
  return with_components(trial, frame, std::move(gas), std::move(stars));
}

double cost(const Trial& trial) {
  constexpr double reference_reach = 5.7, device_reach = 3, sooner_on_device = 20;
  double pixels = 0;
  for (const Place& place : places_of(trial)) {
    const auto drawn = [&trial, &place](double reach) {
      const double side = 2 * reach * place.sigma + 2;
      return std::min(side, trial.width) * std::min(side, trial.height);
    };
    const double merged = trial.light == Light::gray ? place.copies : 1;
    pixels += merged * drawn(reference_reach);
    pixels += place.copies * (drawn(device_reach) / sooner_on_device + 5);
  }
  return pixels + trial.filler;
}

}  // namespace splotchcl::adversary
