#include "scene_file/keys.h"

#include <algorithm>
#include <array>
#include <utility>

#include "scene/picture_limits.h"
#include "scene_file/key_builder.h"

namespace splotchcl::scene_file {
namespace {

// Wide angles included.
Range any_field_of_view() {
  Range range = more_than(0);
  range.at_most = 360;
  return range;
}

Keys top_level_keys() {
  return {
      key<Scene, std::string>(
          "snapshot", text(),
          [](const Scene& scene) {
            return scene.snapshot.empty() ? std::nullopt : std::optional(scene.snapshot);
          },
          [](Scene& scene, const std::string& value) { scene.snapshot = value; },
          {"The snapshot to draw: a file, any member of a multi-file set, or the set's base "
           "name. A relative path starts at the scene file's folder.",
           "", "required, unless there is `time.snapshots`"}),
      key("tolerance", number(between(0, 1)), &Scene::tolerance,
          {"How far a pixel may be from the reference picture: error <= tolerance * max(1, "
           "value). 0 asks for the most exact picture that the device can make.",
           "of white"}),
  };
}

// A colour and a picture replace each other, so that a setting can change a scene's mind.
Keys background_keys() {
  using Color = std::array<double, 3>;
  return {
      excluding(key<ImageSettings, Color>(
                    "image.background", three_numbers(light(), "[red, green, blue]"),
                    [](const ImageSettings& image) {
                      return image.background_image.empty() ? std::optional(image.background)
                                                            : std::nullopt;
                    },
                    [](ImageSettings& image, const Color& value) {
                      image.background = value;
                      image.background_image.clear();
                    },
                    {"Light behind everything.", "white is 1"}),
                {"image.background_image"}),
      key<ImageSettings, std::string>(
          "image.background_image", text(),
          [](const ImageSettings& image) {
            return image.background_image.empty() ? std::nullopt
                                                  : std::optional(image.background_image);
          },
          [](ImageSettings& image, const std::string& value) {
            image.background = ImageSettings().background;
            image.background_image = value;
          },
          {"A picture behind everything, instead of a colour. It is scaled to fill the whole "
           "picture, and cut off where it is too large. Files of 8 and 16 bits hold display "
           "values, "
           "which become value^gamma; others hold linear light. A relative path starts at the "
           "scene file's folder.",
           "", "none"}),
  };
}

Keys image_keys() {
  using Size = std::pair<int, int>;
  return {
      excluding(key<ImageSettings, Size>(
                    "image.size", size_in_pixels(largest_side),
                    [](const ImageSettings& image) { return Size(image.width, image.height); },
                    [](ImageSettings& image, const Size& size) {
                      image.width = size.first;
                      image.height = size.second;
                    },
                    {"Width and height of the picture, of at most 2^28 pixels.", "pixels"}),
                {"image.width", "image.height"}),
      not_written(key("image.width", integer(1, largest_side), &ImageSettings::width,
                      {"The width alone, instead of `size`.", "pixels"})),
      not_written(key("image.height", integer(1, largest_side), &ImageSettings::height,
                      {"The height alone, instead of `size`.", "pixels"})),
      key("image.gamma", number(between(0.01, 100)), &ImageSettings::gamma,
          {"Files of 8 and 16 bits store value^(1/gamma). EXR and HDR, and TIFF of floats, always "
           "keep "
           "linear light."}),
      written_if_set(
          key("image.bits", bits({8, 16}), &ImageSettings::bits,
              {"What files of whole numbers store of each channel: 8 bits, or 16 in PNG and TIFF, "
               "which then holds display values as PNG does. EXR and HDR always hold floats.",
               "", "8; TIFF holds floats"})),
      written_if_set(key(
          "image.dither", boolean(), &ImageSettings::dither,
          {"Whether 8 bits are rounded up or down by a pattern of blue noise, which follows from "
           "a pixel's place alone, so that faint light has no steps.",
           "", "true; false with `convention = \"original\"`"})),
      written_if_set(key(
          "image.convention",
          choice<PixelConvention>(
              {{"upright", PixelConvention::upright}, {"original", PixelConvention::original}}),
          &ImageSettings::convention,
          {"`original`: as the original program has it, with the sky direction down, samples half "
           "a pixel to the upper left of the pixels' centres, and 8 bits truncated; see "
           "original-files.md."})),
  };
}

Keys camera_keys() {
  return {
      key("camera.position", vector(), &Camera::position,
          {"Where the camera stands.", "length", "required where there is a `[camera]`"}),
      key("camera.look_at", vector(), &Camera::look_at,
          {"The point in the middle of the picture.", "length",
           "required where there is a `[camera]`"}),
      excluding(
          key<Camera, Vec3>(
              "camera.center", vector(), [](const Camera&) { return std::optional<Vec3>(); },
              [](Camera& camera, const Vec3& value) { camera.center = value; },
              {"Moves the camera, without turning it, so that this point is in the middle of the "
               "picture. In a `[camera]` without `position` and `look_at`: from above, with x to "
               "the "
               "right and y upwards, and `width` is needed.",
               "length", "what `look_at` says"}),
          {"camera.position", "camera.look_at"}),
      key("camera.sky", vector(), &Camera::sky,
          {"The direction shown upwards. Any direction that is not parallel to the view."}),
      excluding(
          key<Camera, double>(
              "camera.field_of_view", number(any_field_of_view()),
              [](const Camera& camera) { return camera.field_of_view_degrees; },
              [](Camera& camera, double value) {
                camera.field_of_view_degrees = value;
                camera.width.reset();
              },
              {"Horizontal angle of the picture, between its left and right edges; of a fisheye "
               "picture across its circle. Less than 180 in perspective and orthographic "
               "projection.",
               "degrees",
               "perspective, orthographic: 45; fisheye: 180; equirectangular: 360; cube: 90, "
               "always"}),
          {"camera.width"}),
      key<Camera, double>(
          "camera.width", number(more_than(0)), [](const Camera& camera) { return camera.width; },
          [](Camera& camera, double value) {
            camera.width = value;
            camera.field_of_view_degrees.reset();
          },
          {"Instead of `field_of_view`: how much the picture shows between its left and right "
           "edges at the distance of `look_at`. With `orthographic` that is the width at every "
           "depth. Not for wide angles.",
           "length", "what `field_of_view` gives"}),
      key("camera.projection",
          choice<Projection>({{"perspective", Projection::perspective},
                              {"orthographic", Projection::orthographic},
                              {"fisheye", Projection::fisheye},
                              {"equirectangular", Projection::equirectangular},
                              {"cube", Projection::cube}}),
          &Camera::projection,
          {"`orthographic` has the scale of the look-at distance everywhere. `fisheye` is for "
           "domes, `equirectangular` a panorama of 360 degrees, `cube` six square faces of 90 "
           "degrees, of `image.size` each; see projections.md."}),
      written_if_set(key(
          "camera.cube",
          choice<CubeLayout>({{"sheet", CubeLayout::sheet}, {"files", CubeLayout::files}}),
          &Camera::cube_layout,
          {"The faces of a cube as one sheet, right, left, up above down, front, back, or as six "
           "files whose names end in _right, _left, _up, _down, _front and _back."})),
      key("camera.near", number(), &Camera::near_limit,
          {"Particles nearer than this along the view direction are left out; in `fisheye`, "
           "`equirectangular` and `cube` the distance itself counts. Must be >= 0, except "
           "with `orthographic`.",
           "length", "orthographic: 0; others: none, or 0.1 h without `camera.through_clouds`"}),
      written_if_set(
          key("camera.through_clouds", boolean(), &Camera::through_clouds,
              {"Of clouds around the camera each pixel shows what lies in front of it, as in a fog "
               "(projections.md). `false`: splats like all others, until the camera is nearer than "
               "0.1 h. Nothing to `orthographic`."})),
      key("camera.far", number(), &Camera::far_limit,
          {"Particles farther than this are left out, measured as for `near`.", "length",
           "no limit"}),
  };
}

Keys kernel_keys() {
  return {
      key("kernel.width", number(between(1e-6, 1e6)), &KernelSettings::width,
          {"sigma = width * h. The default, 1/sqrt(20/3), gives the uncut Gaussian the second "
           "moment of the cubic spline of support h."}),
      key("kernel.cut", number(more_than(0)), &KernelSettings::cut,
          {"The cloud ends at cut * sigma.", "sigma", "never"}),
      key("kernel.sampling",
          choice<Sampling>({{"mean", Sampling::mean}, {"center", Sampling::center}}),
          &KernelSettings::sampling,
          {"`mean`: the column of a pixel is its mean over the pixel's area, so that clouds far "
           "smaller than a pixel keep their light. `center`: the value at the pixel's centre. "
           "Pixels of a cube look through "
           "a Gaussian footprint instead of their area; see projections.md."}),
      key("kernel.min_radius", number(between(0, 1e6)), &KernelSettings::min_radius_pixels,
          {"h becomes h' = sqrt(h^2 + min_radius^2) in pixels and the column is multiplied by "
           "h/h', as in the original program, where small clouds so gain light. 0: off.",
           "pixels"}),
  };
}

Keys sort_keys() {
  return {
      key<SortOrder, std::string>(
          "sort.by", text(),
          [](const SortOrder& sort) {
            return std::optional(sort.by == SortOrder::By::depth ? "depth" : sort.field);
          },
          [](SortOrder& sort, const std::string& value) {
            const bool is_depth = value == "depth";
            sort.by = is_depth ? SortOrder::By::depth : SortOrder::By::field;
            sort.field = is_depth ? "" : value;
          },
          {"What decides which cloud lies in front: `\"depth\"`, or the name of a field. Used "
           "only where order matters."}),
      key("sort.order", choice<bool>({{"ascending", false}, {"descending", true}}),
          &SortOrder::descending,
          {"`ascending`: the smallest value lies in front (the nearest cloud). `descending`: the "
           "largest. Equal ones stay in file order, the earlier one in front; clouds "
           "around the camera lie behind splats of the same value."}),
  };
}

bool is_prefix(const std::string& table, const std::string& path) {
  return table.empty() || (path.size() > table.size() &&
                           path.compare(0, table.size(), table) == 0 && path[table.size()] == '.');
}

}  // namespace

const std::vector<Key>& all_keys() {
  static const Keys keys = [] {
    Keys all;
    for (const Keys& part :
         {top_level_keys(), read_keys(), image_keys(), background_keys(), camera_keys(),
          stereo_keys(), kernel_keys(), sort_keys(), time_keys(), path_keys(), movie_keys(),
          periodic_keys(), finish_keys(), map_keys(), component_keys()}) {
      append(all, part);
    }
    return all;
  }();
  return keys;
}

const Key* find_key(const std::string& path) {
  const Keys& keys = all_keys();
  const auto found =
      std::find_if(keys.begin(), keys.end(), [&path](const Key& key) { return key.path == path; });
  return found == keys.end() ? nullptr : &*found;
}

bool is_table(const std::string& path) {
  const Keys& keys = all_keys();
  return std::any_of(keys.begin(), keys.end(),
                     [&path](const Key& key) { return is_prefix(path, key.path); });
}

std::vector<std::string> names_in_table(const std::string& path) {
  std::vector<std::string> names;
  for (const Key& key : all_keys()) {
    if (!is_prefix(path, key.path)) continue;
    const std::string rest = path.empty() ? key.path : key.path.substr(path.size() + 1);
    const std::string name = rest.substr(0, rest.find('.'));
    if (std::find(names.begin(), names.end(), name) == names.end()) names.push_back(name);
  }
  return names;
}

}  // namespace splotchcl::scene_file
