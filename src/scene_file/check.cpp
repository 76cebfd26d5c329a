#include "scene_file/check.h"

#include <fmt/format.h>

#include <algorithm>
#include <cctype>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <set>

#include "scene/constants.h"
#include "scene_file/values.h"
#include "splotchcl/camera.h"
#include "splotchcl/error.h"

namespace splotchcl::scene_file {
namespace {

// The key that says the picture's size last: one of its sides may have changed it.
std::string size_label(const Origins& origins) {
  for (const char* const side : {"image.width", "image.height"}) {
    if (origins.contains(side)) return side;
  }
  return "image.size";
}

void check_image(const ImageSettings& image, const Origins& origins) {
  if (image.dither.value_or(false) && image.convention == PixelConvention::original) {
    refuse(origins.at("image.dither"), "image.dither",
           "true beside image.convention = \"original\", which truncates 8 bits", "false");
  }
  const std::int64_t pixels = std::int64_t{image.width} * image.height;
  if (pixels <= largest_pixel_count) return;
  const std::string label = size_label(origins);
  refuse(origins.at(label), label,
         fmt::format("{} x {}, which is {} pixels", image.width, image.height, pixels),
         fmt::format("at most {} pixels", largest_pixel_count));
}

// Runs a check whose message begins with a key, and says where that was given.
void check_at(const Origins& origins, const std::function<void()>& check) {
  try {
    check();
  } catch (const UsageError& error) {
    const std::string message = error.what();
    const std::string label = message.substr(0, message.find(':'));
    const std::string given = label == "image.size" ? size_label(origins) : label;
    throw UsageError(
        fmt::format("{}: key {}{}", origins.at(given), given, message.substr(label.size())));
  }
}

void check_camera(const Scene& scene, const Origins& origins) {
  const Camera& camera = *scene.camera;
  check_at(origins, [&] { make_camera_frame(camera, scene.image.width, scene.image.height); });
  if (camera.projection != Projection::orthographic && camera.near_limit.value_or(0) < 0) {
    refuse(origins.at("camera.near"), "camera.near", write_number(*camera.near_limit),
           "a number >= 0 with any projection but the orthographic one");
  }
  if (camera.aperture > 0 && scene.kernel.min_radius_pixels > 0) {
    refuse(origins.at("camera.aperture"), "camera.aperture",
           write_number(camera.aperture) + " beside kernel.min_radius",
           "only one of the two: the first keeps light, the second adds to it");
  }
}

void check_two_eyes(const Scene& scene, const Origins& origins) {
  const auto [width, height] = std::pair(scene.image.width, scene.image.height);
  const StereoLayout layout = scene.stereo->layout;
  if ((layout == StereoLayout::side_by_side_half && width % 2 != 0) ||
      (layout == StereoLayout::top_bottom_half && height % 2 != 0)) {
    refuse(origins.at("stereo.layout"), "stereo.layout",
           fmt::format(
               "{} with pictures of {} x {}",
               layout == StereoLayout::top_bottom_half ? "top_bottom_half" : "side_by_side_half",
               width, height),
           "an even number of pixels where eyes are squeezed to half");
  }
  const Projection projection = scene.camera ? scene.camera->projection : Projection::perspective;
  check_at(origins, [&] { check_stereo(*scene.stereo, projection); });
}

void check_scale_bar(const Scene& scene, const Origins& origins) {
  const bool has_one_scale = !scene.camera || !is_wide_angle(scene.camera->projection);
  if (!scene.finish.scale_bar.show || has_one_scale) return;
  refuse(origins.at("finish.scale_bar.show"), "finish.scale_bar.show",
         "true with a picture of wide angles, in which no length has one size",
         "camera.projection \"perspective\" or \"orthographic\", or no scale bar");
}

void check_kernel(const KernelSettings& kernel, const Origins& origins) {
  if (kernel.footprint_pixels == 0 || kernel.min_radius_pixels == 0) return;
  refuse(origins.at("kernel.footprint"), "kernel.footprint",
         write_number(kernel.footprint_pixels) + " beside kernel.min_radius",
         "only one of the two: the first keeps light, the second adds to it");
}

// Whose edges meet others, across which no light would glow.
void check_bloom(const Scene& scene, const Origins& origins) {
  if (scene.finish.bloom == 0 || !scene.camera) return;
  const Projection projection = scene.camera->projection;
  if (projection != Projection::equirectangular && projection != Projection::cube) return;
  refuse(origins.at("finish.bloom"), "finish.bloom",
         write_number(scene.finish.bloom) + " in a panorama or cube, at whose seams it would show",
         "0 there");
}

void check_sort(const SortOrder& sort, const Origins& origins) {
  if (sort.by == SortOrder::By::depth) return;
  if (sort.field.empty() || sort.field == "depth") {
    refuse(origins.at("sort.by"), "sort.by",
           fmt::format("the field name {}", write_text(sort.field)),
           "a field with another name: \"depth\" is the distance from the camera");
  }
}

void check_time(const Scene& scene, const Origins& origins) {
  const SequenceSettings& time = scene.time;
  if (!time.is_set()) {
    for (const char* label : {"time.first", "time.last", "time.index", "time.interpolation",
                              "time.omega_matter", "time.omega_lambda", "time.hubble_rate"}) {
      if (!origins.contains(label)) continue;
      refuse(origins.at(label), label, "a value without a sequence", "time.snapshots as well");
    }
    return;
  }
  // A part of each snapshot would not be the same particles.
  const char* single = nullptr;
  if (scene.read.every != 1) single = "read.every";
  if (scene.read.max_particles) single = "read.max_particles";
  if (single != nullptr) {
    refuse(origins.at(single), single, "it beside time.snapshots", "a single snapshot with it");
  }
  if (!scene.snapshot.empty()) {
    refuse(origins.at("time.snapshots"), "time.snapshots", "it beside snapshot",
           "only one of the two");
  }
  if (time.pattern.empty()) {
    for (const char* label : {"time.first", "time.last"}) {
      if (!origins.contains(label)) continue;
      refuse(origins.at(label), label, "a number beside a list of snapshots",
             "a pattern such as \"snapshot_%03d\" in time.snapshots");
    }
  }
  if (time.first && time.last && *time.first > *time.last) {
    refuse(origins.at("time.first"), "time.first", std::to_string(*time.first),
           fmt::format("at most time.last, which is {}", *time.last));
  }
}

void check_name(const std::string& name, const std::string& label, const Origins& origins) {
  const bool is_number = !name.empty() && std::all_of(name.begin(), name.end(), [](char c) {
    return std::isdigit(static_cast<unsigned char>(c)) != 0;
  });
  if (is_number) {
    refuse(origins.at(label), label, write_text(name),
           "a name with something other than digits, since component.N is the N-th");
  }
}

// Of a component's field or of a map's figure.
template <class Limits>
void check_percentiles(const Limits& range, const std::string& label, const Origins& origins) {
  if (!range.minimum || !range.maximum || !range.percentiles) return;
  refuse(origins.at(label + ".percentiles"), label + ".percentiles",
         "it beside min and max, for neither of which it can stand",
         "percentiles, or min and max, or percentiles and one of the two");
}

void check_field_map(const FieldMap& map, const std::string& label, const Origins& origins) {
  if (map.field.empty()) {
    for (const char* part : {".scaling", ".min", ".max", ".percentiles"}) {
      if (!origins.contains(label + part)) continue;
      refuse(origins.at(label + part), label + part, "a value without a field",
             label + ".field as well");
    }
    return;
  }
  check_percentiles(map, label, origins);
  if (map.minimum && map.maximum && *map.minimum > *map.maximum) {
    refuse(origins.at(label + ".min"), label + ".min", write_number(*map.minimum),
           fmt::format("at most {}.max, which is {}", label, write_number(*map.maximum)));
  }
  const auto check_positive = [&](const std::optional<double>& value, const std::string& key) {
    if (map.scaling != Scaling::log || !value || *value > 0) return;
    refuse(origins.at(key), key, write_number(*value), "a number > 0 with the scaling \"log\"");
  };
  check_positive(map.minimum, label + ".min");
  check_positive(map.maximum, label + ".max");
}

void check_rim(const ParticleSet& set, const std::string& label, const Origins& origins) {
  if (!set.sphere_rim) return;
  const std::string rim = label + ".sphere.rim";
  if (!set.sphere_radius)
    refuse(origins.at(rim), rim, "it alone", label + ".sphere.radius as well");
  if (*set.sphere_rim <= *set.sphere_radius) return;
  refuse(origins.at(rim), rim, write_number(*set.sphere_rim),
         fmt::format("at most {}.sphere.radius, which is {}", label,
                     write_number(*set.sphere_radius)));
}

// Corners in order, and nothing that lacks its other half.
void check_set(const ParticleSet& set, const std::string& label, const Origins& origins) {
  const auto check_pair = [&](bool has_first, bool has_second, const std::string& first,
                              const std::string& second) {
    if (has_first == has_second) return;
    const std::string& given = label + (has_first ? first : second);
    refuse(origins.at(given), given, "it alone", label + (has_first ? second : first) + " as well");
  };
  check_pair(set.box_minimum.has_value(), set.box_maximum.has_value(), ".box.min", ".box.max");
  check_pair(set.sphere_center.has_value(), set.sphere_radius.has_value(), ".sphere.center",
             ".sphere.radius");
  if (!set.halo_catalog.empty() && !set.halo) {
    refuse(origins.at(label + ".catalog"), label + ".catalog", "it alone", label + ".halo as well");
  }
  check_rim(set, label, origins);
  if (!set.box_minimum || !set.box_maximum) return;
  for (std::size_t axis = 0; axis < 3; ++axis) {
    const double low = set.box_minimum->a[axis], high = set.box_maximum->a[axis];
    if (low <= high) continue;
    refuse(origins.at(label + ".box.min"), label + ".box.min",
           fmt::format("{} along {}", write_number(low), "xyz"[axis]),
           fmt::format("at most {}.box.max, which is {} there", label, write_number(high)));
  }
}

void check_placement(const Placement& placement, const std::string& label, const Origins& origins) {
  const auto& a = placement.axis.a;
  if (a[0] != 0 || a[1] != 0 || a[2] != 0) return;
  refuse(origins.at(label + ".rotation.axis"), label + ".rotation.axis", "[0, 0, 0]",
         "a direction");
}

// A key that would do nothing is a mistake.
void check_colors(const Component& component, const std::string& label, const Origins& origins) {
  if (component.color_vector.empty() || component.color.field.empty()) return;
  if (!component.absorption_palette.empty()) return;
  refuse(origins.at(label + ".color.field"), label + ".color.field",
         "it beside " + label + ".color.vector, which replaces the palette",
         "only one of the two, or an absorption_palette in which it is looked up");
}

void check_path(const PathSettings& path, const Origins& origins) {
  if (path.fly && path.fly->through.size() < 2) {
    refuse(origins.at("path.fly.look_at"), "path.fly.through", "nothing",
           "two or more points that the camera flies through");
  }
  if (path.follow && !path.follow->catalog.empty() && !path.follow->halo) {
    refuse(origins.at("path.follow.catalog"), "path.follow.catalog", "it alone",
           "path.follow.halo as well");
  }
  if (!path.approach) return;
  const char* const given =
      origins.contains("path.approach.to") ? "path.approach.to" : "path.approach.width";
  if (path.fly || !path.file.empty()) {
    refuse(origins.at(given), given, "it beside a path that moves the camera",
           "an approach alone, with an orbit, or with keyframes of other keys");
  }
  if (!path.approach->to && !path.follow) {
    refuse(origins.at(given), "path.approach.to", "nothing to approach",
           "a point, or path.follow as well");
  }
  if (!path.approach->width && !path.follow) {
    refuse(origins.at(given), "path.approach.width", "nothing",
           "the length that the picture shows in the end");
  }
}

void check_components(const Scene& scene, const Origins& origins) {
  std::set<std::string> names;
  for (std::size_t i = 0; i < scene.components.size(); ++i) {
    const Component& component = scene.components[i];
    const std::string label = fmt::format("component.{}", i);
    check_name(component.name, label + ".name", origins);
    if (!component.name.empty() && !names.insert(component.name).second) {
      refuse(origins.at(label + ".name"), label + ".name",
             write_text(component.name) + ", which another component has",
             "a different name for each component");
    }
    check_field_map(component.color, label + ".color", origins);
    check_colors(component, label, origins);
    check_set(component.select, label + ".select", origins);
    check_set(component.exclude, label + ".exclude", origins);
    check_placement(component.placement, label, origins);
    check_field_map(component.intensity, label + ".intensity", origins);
  }
}

}  // namespace

const std::string& Origins::at(const std::string& label) const {
  const auto found = where.find(label);
  return found == where.end() ? name : found->second;
}

void refuse(const std::string& where, const std::string& label, const std::string& found,
            const std::string& expected, const std::string& advice) {
  throw UsageError(
      fmt::format("{}: key {}: found {}, expected {}{}", where, label, found, expected, advice));
}

void check_scene(const Scene& scene, const Origins& origins) {
  check_image(scene.image, origins);
  if (scene.camera) check_camera(scene, origins);
  if (scene.stereo) check_two_eyes(scene, origins);
  check_scale_bar(scene, origins);
  check_kernel(scene.kernel, origins);
  check_bloom(scene, origins);
  check_sort(scene.sort, origins);
  check_path(scene.path, origins);
  check_time(scene, origins);
  check_percentiles(scene.map, "map", origins);
  check_components(scene, origins);
}

}  // namespace splotchcl::scene_file
