#include "load/suggest_camera.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <optional>
#include <utility>

#include "load/component_tree.h"
#include "scene/constants.h"
#include "scene/particle_columns.h"
#include "scene/particle_rules.h"
#include "scene/statistics.h"
#include "splotchcl/error.h"

namespace splotchcl {
namespace {

constexpr std::size_t position_limit = 200000;  // looked at, of all types together

// From where a target is seen: angles of the line from the target to the camera, about
// the z axis and above the x-y plane.
struct Viewpoint {
  double azimuth_degrees, elevation_degrees;
};

// A box is seen almost along an axis, or its corners stand empty in the picture; a
// little askew, so that filaments along the axes do not hide behind themselves.
constexpr Viewpoint box_viewpoint = {-68, 16};
// Discs lie in the x-y plane more often than not: from here they show their face.
constexpr Viewpoint object_viewpoint = {-60, 42};

// Coordinates of sampled particles, an array per axis.
using Sample = std::array<std::vector<double>, 3>;

void sample_type(const Snapshot& snapshot, int type, std::size_t stride, Sample& sample) {
  using Place = std::array<float, 3>;
  const auto [position, known_stride, pass] = values_to_sample(snapshot, type, "position");
  const Vec3 origin = snapshot.position_origin();
  const auto look = [&, &position = position, step = stride / known_stride](
                        const ParticleRun& run, std::vector<Place>& places) {
    for (std::size_t i = first_sampled(run, step); i < run.end; i += step) {
      const Place place = {position[3 * i], position[3 * i + 1], position[3 * i + 2]};
      if (is_finite_position(place.data())) places.push_back(place);
    }
  };
  for (const Place& place : pass.collect<Place>(look)) {
    for (std::size_t axis = 0; axis < 3; ++axis)
      sample[axis].push_back(origin.a[axis] + static_cast<double>(place[axis]));
  }
}

Sample sample_positions(const Snapshot& snapshot, const std::vector<int>& types) {
  std::size_t count = 0;
  for (const int type : types) {
    const ParticleTypeInfo* const info = snapshot.info().find_type(type);
    if (info != nullptr) count += static_cast<std::size_t>(info->count);
  }
  Sample sample;
  for (const int type : types) {
    const ParticleTypeInfo* const info = snapshot.info().find_type(type);
    if (info == nullptr) continue;
    // All of a type's largest sample.
    const std::size_t least = least_sample_stride(static_cast<std::size_t>(info->count));
    const std::size_t stride = ceil_divide(sample_stride(count, position_limit), least) * least;
    sample_type(snapshot, type, stride, sample);
  }
  if (sample[0].empty()) {
    throw DataError(fmt::format(
        "{}: found no particle at a finite position among those to be drawn, expected some; set "
        "camera and types in a scene file",
        snapshot.info().files.front().string()));
  }
  return sample;
}

Vec3 direction(const Viewpoint& viewpoint) {
  const double azimuth = viewpoint.azimuth_degrees * pi / 180;
  const double elevation = viewpoint.elevation_degrees * pi / 180;
  return {{std::cos(azimuth) * std::cos(elevation), std::sin(azimuth) * std::cos(elevation),
           std::sin(elevation)}};
}

ValueRange extent(std::vector<double>& values, double left_out) {
  return {percentile(values, left_out), percentile(values, 1 - left_out)};
}

double middle(const ValueRange& range) {
  return 0.5 * (range.minimum + range.maximum);
}

Target box_target(const Vec3& center, double side) {
  Target box;
  box.shape = Target::Shape::box;
  box.center = center;
  box.size = side;
  box.towards_camera = direction(box_viewpoint);
  return box;
}

// Particles that fill a cube to its faces are a box, also where the header has no size:
// 90 % of the particles then span 90 % of the extent, on every axis, where those of an
// object are concentrated.
std::optional<Target> find_cube(Sample sample) {
  Vec3 center = {{0, 0, 0}};
  double smallest = 0, largest = 0;
  for (std::size_t axis = 0; axis < 3; ++axis) {
    const ValueRange all = extent(sample[axis], 0);
    const ValueRange most = extent(sample[axis], 0.05);
    const double side = all.maximum - all.minimum;
    if (!(most.maximum - most.minimum > 0.83 * side)) return std::nullopt;
    center.a[axis] = middle(all);
    largest = std::max(largest, side);
    smallest = axis == 0 ? side : std::min(smallest, side);
  }
  if (smallest < 0.9 * largest) return std::nullopt;
  return box_target(center, largest);
}

// Of particles whose coordinates span this along an axis: whether the middle of the box lies at the
// origin, as some programs have it.
bool is_around_zero(const ValueRange& most, double side) {
  return most.minimum < -0.1 * side;
}

Vec3 cube_middle(bool is_at_zero, double side) {
  const double middle = is_at_zero ? 0 : 0.5 * side;
  return {{middle, middle, middle}};
}

constexpr double few_outside = 0.01;  // of the particles, out of a box on either side

// The box of the header, where it is a cube that the particles are spread over.
std::optional<Target> find_periodic_box(Sample sample, const SnapshotInfo& info) {
  if (!info.box_size || !info.box_size->is_cube()) return std::nullopt;
  const double side = info.box_size->longest();
  bool reaches_below_zero = false;
  for (std::vector<double>& values : sample) {
    const ValueRange most = extent(values, few_outside);
    const double span = most.maximum - most.minimum;
    if (span < 0.7 * side || span > side) return std::nullopt;
    reaches_below_zero = reaches_below_zero || is_around_zero(most, side);
  }
  return box_target(cube_middle(reaches_below_zero, side), side);
}

// Whether counts of particles in cells differ by little more than chance has them differ.
bool is_smooth(const Sample& sample, const Target& box) {
  constexpr double particles_per_cell = 8;
  constexpr double largest_contrast = 1;  // standard deviation of the density over its mean
  const auto count = static_cast<double>(sample[0].size());
  const auto cells = static_cast<std::size_t>(
      std::clamp(std::floor(std::cbrt(count / particles_per_cell)), 1.0, 24.0));
  if (cells < 2) return true;
  std::vector<double> counts(cells * cells * cells, 0);
  for (std::size_t i = 0; i < sample[0].size(); ++i) {
    std::size_t cell = 0;
    for (std::size_t axis = 0; axis < 3; ++axis) {
      const double place = (sample[axis][i] - box.center.a[axis]) / box.size + 0.5;
      const double step =
          std::clamp(place * static_cast<double>(cells), 0.0, static_cast<double>(cells) - 1);
      cell = cell * cells + static_cast<std::size_t>(step);
    }
    ++counts[cell];
  }
  const double mean = count / static_cast<double>(counts.size());
  double squares = 0;
  for (const double in_cell : counts)
    squares += (in_cell - mean) * (in_cell - mean);
  const double variance = squares / static_cast<double>(counts.size());
  return variance / (mean * mean) - 1 / mean < largest_contrast * largest_contrast;
}

struct Span {
  double middle, half;
};

// What a picture must span along an axis: without a few particles far out, which would make all
// else small, but with all of what ends sharply. What is long and narrow has none and fills the
// width.
Span span_to_show(std::vector<double>& along, Target::Shape shape) {
  constexpr double outliers = 0.05, few_outliers = 0.01;
  constexpr double wide_margin = 1.6, close_margin = 1.25, bar_margin = 1.06;
  const auto half = [](const ValueRange& range) { return 0.5 * (range.maximum - range.minimum); };
  if (shape == Target::Shape::bar) {
    const ValueRange all = extent(along, 0);
    return {middle(all), bar_margin * half(all)};
  }
  const ValueRange most = extent(along, outliers), nearly_all = extent(along, few_outliers);
  const Span wide = {middle(most), wide_margin * half(most)};
  const Span close = {middle(nearly_all), close_margin * half(nearly_all)};
  return close.half < wide.half ? close : wide;
}

// Its place and size as seen from its viewpoint, along the picture's axes.
void fit_to_picture(Target& target, const Sample& sample, double aspect) {
  using namespace boost::qvm;
  const Vec3 right = normalized(cross(target.sky, target.towards_camera));
  const Vec3 up = cross(target.towards_camera, right);
  double half_width = 0;
  target.center = {{0, 0, 0}};
  for (const auto& [axis, share] :
       {std::pair(right, 1.0), std::pair(up, 1 / aspect), std::pair(target.towards_camera, 0.0)}) {
    std::vector<double> along;
    for (std::size_t i = 0; i < sample[0].size(); ++i) {
      along.push_back(sample[0][i] * axis.a[0] + sample[1][i] * axis.a[1] +
                      sample[2][i] * axis.a[2]);
    }
    const Span span = span_to_show(along, target.shape);
    target.center = Vec3(target.center + span.middle * axis);
    half_width = std::max(half_width, share * span.half);
  }
  // A single particle, or all in one place: any size will do.
  target.size = half_width > 0 ? half_width : 1.0;
}

// Whether some lie in each tenth of the length, also where they are denser in one part of it than
// in another, as in a shock tube. Objects thin out towards their ends, and two of them have a gap.
bool fill_length(const std::vector<double>& values, const ValueRange& range) {
  constexpr std::size_t slices = 10;
  constexpr double least_part = 0.1;  // of an even share
  std::array<std::size_t, slices> counts = {};
  for (const double value : values) {
    const double part = (value - range.minimum) / (range.maximum - range.minimum);
    ++counts[std::min(slices - 1, static_cast<std::size_t>(part * slices))];
  }
  const std::size_t fewest = *std::min_element(counts.begin(), counts.end());
  return static_cast<double>(fewest * slices) >= least_part * static_cast<double>(values.size());
}

// The long axis of a slab: particles fill its length without a gap and its sides to the faces, and
// reach much farther along one axis than along both others.
std::optional<std::size_t> find_long_axis(Sample sample) {
  constexpr double much = 2.5, filled = 0.8;
  std::array<ValueRange, 3> ranges;
  std::array<double, 3> spans;
  for (std::size_t axis = 0; axis < 3; ++axis) {
    ranges[axis] = extent(sample[axis], 0);
    spans[axis] = ranges[axis].maximum - ranges[axis].minimum;
  }
  const auto longest =
      static_cast<std::size_t>(std::max_element(spans.begin(), spans.end()) - spans.begin());
  for (std::size_t axis = 0; axis < 3; ++axis) {
    if (axis == longest) continue;
    const ValueRange most = extent(sample[axis], 0.05);
    const bool is_side =
        spans[axis] * much <= spans[longest] && most.maximum - most.minimum > filled * spans[axis];
    if (!is_side) return std::nullopt;
  }
  return fill_length(sample[longest], ranges[longest]) ? std::optional(longest) : std::nullopt;
}

// Whatever lies along an axis is seen from its side, with that axis from left to right.
Target bar_target(std::size_t long_axis) {
  using namespace boost::qvm;
  constexpr double from_above = 1;  // so that it is no flat stripe
  Vec3 along = {{0, 0, 0}};
  along.a[long_axis] = 1;
  Target bar;
  bar.shape = Target::Shape::bar;
  bar.sky = long_axis == 2 ? Vec3{{0, 1, 0}} : Vec3{{0, 0, 1}};
  const Vec3 from_the_side = cross(along, bar.sky);
  bar.towards_camera = normalized(Vec3(from_the_side + from_above * bar.sky));
  return bar;
}

Target object_target() {
  Target object;
  object.towards_camera = direction(object_viewpoint);
  return object;
}

}  // namespace

Target find_target(const Snapshot& snapshot, const std::vector<int>& types, double aspect) {
  const Sample sample = sample_positions(snapshot, types);
  std::optional<Target> box = find_periodic_box(sample, snapshot.info());
  if (!box) box = find_cube(sample);
  if (box) {
    box->is_smooth = is_smooth(sample, *box);
    return *box;
  }
  const auto long_axis = find_long_axis(sample);
  Target target = long_axis ? bar_target(*long_axis) : object_target();
  fit_to_picture(target, sample, aspect);
  return target;
}

namespace {

constexpr double suggested_degrees = 40;

// The distance from a box's centre, in sides of the box, at which the picture of 40
// degrees just shows its whole width halfway into the depth.
constexpr double box_distance = 1.25;

// Where a halo surrounds discs, bulges or stars, those are what the picture is about.
std::vector<int> types_to_frame(const std::vector<int>& types) {
  std::vector<int> bright;
  std::copy_if(types.begin(), types.end(), std::back_inserter(bright),
               [](int type) { return type == 0 || (type >= 2 && type <= 4); });
  return bright.empty() ? types : bright;
}

double aspect_of(const ImageSettings& image) {
  return static_cast<double>(image.height) / image.width;
}

// A picture that is taller than wide shows the box's whole height.
double box_degrees(double aspect) {
  if (aspect <= 1) return suggested_degrees;
  const double tangent = std::tan(0.5 * suggested_degrees * pi / 180) / aspect;
  const double degrees = 2 * std::atan(tangent) * 180 / pi;
  return round_to_decimals(degrees, decimals_for(degrees, 4));
}

// A number that reads well in a scene file: four digits of the size of the target.
double rounded(double value, double size) {
  return round_to_decimals(value, decimals_for(size, 4));
}

}  // namespace

std::vector<int> types_of(const std::vector<Component>& components) {
  std::vector<int> types;
  for (const Component& component : components) {
    types.insert(types.end(), component.types.begin(), component.types.end());
  }
  return types;
}

Target suggest_target(const Snapshot& snapshot, const std::vector<int>& types,
                      const ImageSettings& image) {
  return find_target(snapshot, types_to_frame(types), aspect_of(image));
}

Camera suggest_camera(const Target& target, const ImageSettings& image) {
  const bool is_box = target.shape == Target::Shape::box;
  const double tangent = std::tan(0.5 * suggested_degrees * pi / 180);
  const double distance = is_box ? box_distance * target.size : target.size / tangent;
  Camera camera;
  camera.field_of_view_degrees = is_box ? box_degrees(aspect_of(image)) : suggested_degrees;
  camera.sky = target.sky;
  for (std::size_t axis = 0; axis < 3; ++axis) {
    camera.look_at.a[axis] = rounded(target.center.a[axis], target.size);
    camera.position.a[axis] =
        rounded(target.center.a[axis] + distance * target.towards_camera.a[axis], target.size);
  }
  return camera;
}

void stand_amid_matter(Camera& camera) {
  // What a picture of 45 degrees shows from afar is half as wide as the way to it, or wider.
  constexpr double part_of_way = 0.2;
  const Vec3 way = part_of_way * (camera.position - camera.look_at);
  const double distance = boost::qvm::mag(way);
  for (std::size_t axis = 0; axis < 3; ++axis)
    camera.position.a[axis] = rounded(camera.look_at.a[axis] + way.a[axis], distance);
  if (camera.near_limit || camera.fade.near_length > 0) return;
  camera.fade.near_length = rounded(distance, distance);
  camera.through_clouds = false;
}

}  // namespace splotchcl
