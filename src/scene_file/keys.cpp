#include "scene_file/keys.h"

#include <algorithm>
#include <array>
#include <cstddef>
#include <map>
#include <optional>
#include <utility>

#include "image/text.h"
#include "palette/palette_file.h"
#include "scene/constants.h"
#include "scene_file/key_builder.h"
#include "scene_file/setting.h"
#include "scene_file/values.h"

namespace splotchcl::scene_file {

Keys stereo_keys() {
  Range angle = more_than(0);
  angle.at_most = 45;
  return {
      key("stereo.angle", number(angle), &Stereo::angle_degrees,
          {"A `[stereo]` draws two pictures. The eyes are this angle times the look-at distance "
           "apart.",
           "degrees"}),
      key("stereo.mode",
          choice<StereoMode>({{"off_axis", StereoMode::off_axis},
                              {"parallel", StereoMode::parallel},
                              {"toe_in", StereoMode::toe_in}}),
          &Stereo::mode,
          {"`off_axis`: parallel views, shifted to agree at the look-at distance. `parallel`: not "
           "shifted, for headsets. `toe_in`: each eye looks at `look_at`; the only one for "
           "orthographic cameras, and not for wide angles."}),
      key("stereo.eyes",
          choice<StereoEyes>(
              {{"right_shifted", StereoEyes::right_shifted}, {"centered", StereoEyes::centered}}),
          &Stereo::eyes,
          {"`right_shifted`: the left eye is at `camera.position`. `centered`: both are half a "
           "step beside it."}),
      key("stereo.layout",
          choice<StereoLayout>({{"files", StereoLayout::files},
                                {"side_by_side", StereoLayout::side_by_side},
                                {"top_bottom", StereoLayout::top_bottom},
                                {"side_by_side_half", StereoLayout::side_by_side_half},
                                {"top_bottom_half", StereoLayout::top_bottom_half},
                                {"anaglyph", StereoLayout::anaglyph},
                                {"anaglyph_half_color", StereoLayout::anaglyph_half_color},
                                {"anaglyph_gray", StereoLayout::anaglyph_gray}}),
          &Stereo::layout,
          {"Two files, NAME_left and NAME_right; one picture, left eye left or on top; or one for "
           "glasses of red and cyan. See projections.md."}),
  };
}

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
          {"The snapshot to draw: a file, any file of a set, or the set's base name.", "",
           "required, unless there is `time.snapshots`"}),
      key<Scene, Look>(
          "look",
          choice<Look>(
              {{"press", Look::press}, {"classic", Look::classic}, {"paper", Look::paper}}),
          [](const Scene& scene) { return scene.look; },
          [](Scene& scene, const Look& value) { scene.look = value; },
          {"Chooses camera, components and finish from the data, in a scene without components; "
           "see "
           "looks.md.",
           "", "`\"press\"` for a snapshot"}),
      key("tolerance", number(between(0, 1)), &Scene::tolerance,
          {"How far a pixel may be from the reference: error <= tolerance * max(1, value). 0: as "
           "exact as possible; see accuracy.md.",
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
          {"A picture behind everything, instead of a colour, scaled to fill the frame; see "
           "finish.md.",
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
                    {"Width and height of the picture, at most 2^28 pixels in all.", "pixels"}),
                {"image.width", "image.height"}),
      not_written(key("image.width", integer(1, largest_side), &ImageSettings::width,
                      {"The width alone, instead of `size`.", "pixels"})),
      not_written(key("image.height", integer(1, largest_side), &ImageSettings::height,
                      {"The height alone, instead of `size`.", "pixels"})),
      key("image.gamma", number(between(0.01, 100)), &ImageSettings::gamma,
          {"Files of 8 and 16 bits store value^(1/gamma); floats (EXR, HDR, TIFF) are linear "
           "light."}),
      written_if_set(key("image.bits", bits({8, 16}), &ImageSettings::bits,
                         {"Bits per channel of whole-number files; 16 in PNG and TIFF only.", "",
                          "8; TIFF holds floats"})),
      written_if_set(key(
          "image.dither", boolean(), &ImageSettings::dither,
          {"Round 8-bit values by a fixed pattern of blue noise, so that faint light has no steps.",
           "", "true; false with `convention = \"original\"`"})),
      written_if_set(key("image.convention",
                         choice<PixelConvention>({{"upright", PixelConvention::upright},
                                                  {"original", PixelConvention::original}}),
                         &ImageSettings::convention,
                         {"`original`: upside down, sampled and rounded as the original program "
                          "does; see original-files.md."})),
  };
}

Keys camera_keys() {
  return {
      key("camera.position", vector(), &Camera::position,
          {"Where the camera stands.", "length", "required in a `[camera]`"}),
      key("camera.look_at", vector(), &Camera::look_at,
          {"The point in the middle of the picture.", "length", "required in a `[camera]`"}),
      excluding(key<Camera, Vec3>(
                    "camera.center", vector(), [](const Camera&) { return std::optional<Vec3>(); },
                    [](Camera& camera, const Vec3& value) { camera.center = value; },
                    {"Moves the camera without turning it, so that this point is in the middle. "
                     "Without `position` and `look_at` the view is from above, x to the right and "
                     "y upwards, and needs `width`.",
                     "length", "what `look_at` says"}),
                {"camera.position", "camera.look_at"}),
      key("camera.sky", vector(), &Camera::sky,
          {"The direction shown upwards; not parallel to the view."}),
      excluding(key<Camera, double>(
                    "camera.field_of_view", number(any_field_of_view()),
                    [](const Camera& camera) { return camera.field_of_view_degrees; },
                    [](Camera& camera, double value) {
                      camera.field_of_view_degrees = value;
                      camera.width.reset();
                    },
                    {"Horizontal angle of the picture; of a fisheye across its circle. Below 180 "
                     "in perspective and orthographic projection.",
                     "degrees", "45; fisheye: 180; equirectangular: 360; cube: 90, always"}),
                {"camera.width"}),
      key<Camera, double>(
          "camera.width", number(more_than(0)), [](const Camera& camera) { return camera.width; },
          [](Camera& camera, double value) {
            camera.width = value;
            camera.field_of_view_degrees.reset();
          },
          {"Instead of `field_of_view`: the length shown across the picture at the distance of "
           "`look_at`. Not for wide angles.",
           "length", "what `field_of_view` gives"}),
      key("camera.projection",
          choice<Projection>({{"perspective", Projection::perspective},
                              {"orthographic", Projection::orthographic},
                              {"fisheye", Projection::fisheye},
                              {"equirectangular", Projection::equirectangular},
                              {"cube", Projection::cube}}),
          &Camera::projection,
          {"`orthographic`: no perspective. `fisheye`: domes. `equirectangular`: a panorama of 360 "
           "degrees. `cube`: six faces of `image.size` each. See projections.md."}),
      written_if_set(
          key("camera.cube",
              choice<CubeLayout>({{"sheet", CubeLayout::sheet}, {"files", CubeLayout::files}}),
              &Camera::cube_layout,
              {"The faces as one sheet (right, left, up above down, front, back) or as six files, "
               "NAME_right and so on."})),
      written_if_set(key("camera.dome_tilt", number(between(-90, 90)), &Camera::dome_tilt_degrees,
                         {"Of domes: how far `look_at`, in front at the bottom, is above the rim.",
                          "degrees", "`look_at` is in the middle"})),
      key("camera.near", number(), &Camera::near_limit,
          {"Particles nearer than this along the view (wide angles: in distance) are left out. >= "
           "0, except with `orthographic`.",
           "length", "none; orthographic: 0; without `through_clouds` 0.1 h"}),
      written_if_set(key(
          "camera.through_clouds", boolean(), &Camera::through_clouds,
          {"Clouds around the camera show only what lies in front of it, like fog; see "
           "projections.md. `false`: they are splats like others, and left out within 0.1 h."})),
      key("camera.far", number(), &Camera::far_limit,
          {"Particles farther than this are left out.", "length", "no limit"}),
      written_if_set(key<Camera, double>(
          "camera.near_fade", number(at_least(0)),
          [](const Camera& camera) { return camera.fade.near_length; },
          [](Camera& camera, double value) { camera.fade.near_length = value; },
          {"Behind `near`, or the camera, light rises smoothly over this length.", "length"})),
      written_if_set(key<Camera, double>(
          "camera.far_fade", number(at_least(0)),
          [](const Camera& camera) { return camera.fade.far_length; },
          [](Camera& camera, double value) { camera.fade.far_length = value; },
          {"Before `far` it falls over this length.", "length"})),
      excluding(not_written(key<Camera, std::array<double, 2>>(
                    "camera.fog", from_to(),
                    [](const Camera&) { return std::optional<std::array<double, 2>>(); },
                    [](Camera& camera, const std::array<double, 2>& distances) {
                      camera.far_limit = distances[1];
                      camera.fade.far_length = distances[1] - distances[0];
                    },
                    {"Light fades between these distances into `image.background`: `far` and "
                     "`far_fade` by name.",
                     "length", "no fog"})),
                {"camera.far", "camera.far_fade"}),
      written_if_set(key(
          "camera.aperture", number(at_least(0)), &Camera::aperture,
          {"Diameter of a lens, which blurs what is out of focus. Perspective only.", "length"})),
      written_if_set(key("camera.focus", number(more_than(0)), &Camera::focus,
                         {"The depth that is sharp.", "length", "that of `look_at`"})),
  };
}

Keys kernel_keys() {
  return {
      key("kernel.width", number(between(1e-6, 1e6)), &KernelSettings::width,
          {"sigma = width * h. The default, 1/sqrt(20/3), gives the Gaussian the second moment of "
           "the cubic spline."}),
      key("kernel.cut", number(more_than(0)), &KernelSettings::cut,
          {"The cloud ends at cut * sigma.", "sigma", "never"}),
      key("kernel.sampling",
          choice<Sampling>({{"mean", Sampling::mean}, {"center", Sampling::center}}),
          &KernelSettings::sampling,
          {"`mean` over the pixel's area, so that clouds smaller than a pixel keep their light, or "
           "the value at its `center`."}),
      key("kernel.min_radius", number(between(0, 1e6)), &KernelSettings::min_radius_pixels,
          {"h becomes h' = sqrt(h^2 + min_radius^2) in pixels and the column is multiplied by "
           "h/h', as in the original program.",
           "pixels"}),
      written_if_set(key(
          "kernel.footprint", number(between(0, 1e3)), &KernelSettings::footprint_pixels,
          {"Standard deviation of a Gaussian by which every cloud is spread, keeping its light: "
           "stars do not twinkle in flights, and merged particles (tree.md) are true. 0.5 is what "
           "film renderers use. Not together with `min_radius`.",
           "pixels"})),
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
          {"What decides which cloud lies in front: `\"depth\"` or a field. Used only if order "
           "matters."}),
      key("sort.order", choice<bool>({{"ascending", false}, {"descending", true}}),
          &SortOrder::descending,
          {"`ascending`: the smallest value (the nearest cloud) lies in front. Equal values stay "
           "in file order."}),
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

std::vector<std::string> key_names() {
  std::vector<std::string> names;
  for (const Key& key : all_keys())
    names.push_back(key.path);
  return names;
}

namespace {

bool is_any_name(const std::string& value) {
  return !value.empty();
}

// The keys, and which of their values are names of files.
const std::map<std::string, bool (*)(const std::string&)>& file_keys() {
  static const std::map<std::string, bool (*)(const std::string&)> keys = {
      {"snapshot", is_any_name},
      {"path.file", is_any_name},
      {"path.follow.catalog", is_any_name},
      {"movie.audio", is_any_name},
      {"image.background_image", is_any_name},
      {"finish.cross_fade.scene", is_any_name},
      {"finish.font", is_font_path},
      {"component.snapshot", is_any_name},
      {"component.select.ids", is_any_name},
      {"component.exclude.ids", is_any_name},
      {"component.select.catalog", is_any_name},
      {"component.exclude.catalog", is_any_name},
      {"component.palette", is_palette_path},
      {"component.absorption_palette", is_palette_path},
      {"map.palette", is_palette_path},
  };
  return keys;
}

void change_key(const Key& key, Scene& scene, std::size_t component, const ChangeName& change) {
  const std::optional<std::string> value = key.get(scene, component);
  if (!value) return;
  const std::string changed = with_file_name(key.path, *value, change);
  if (changed != *value) key.set(scene, component, *parse_value(changed).get("value"));
}

void change_keyframe(Keyframe& keyframe, const Scene& scene, const ChangeName& change) {
  for (auto& [key, value] : keyframe.values)
    value = with_file_name(locate(key, scene, "path.keyframes").path, value, change);
}

}  // namespace

std::string with_file_name(const std::string& path, const std::string& value,
                           const ChangeName& change) {
  const auto found = file_keys().find(path);
  if (found == file_keys().end()) return value;
  const auto name = parse_value(value)["value"].value_exact<std::string>();
  return name && found->second(*name) ? write_text(change(*name)) : value;
}

void change_file_names(Scene& scene, const ChangeName& change) {
  for (const auto& [path, is_name] : file_keys()) {
    const Key& key = *find_key(path);
    const bool is_of_component = path.rfind("component.", 0) == 0;
    const std::size_t count = is_of_component ? scene.components.size() : 1;
    for (std::size_t i = 0; i < count; ++i)
      change_key(key, scene, i, change);
  }
  for (std::string& snapshot : scene.time.snapshots)
    snapshot = change(snapshot);
  for (Keyframe& keyframe : scene.path.keyframes)
    change_keyframe(keyframe, scene, change);
}

}  // namespace splotchcl::scene_file
