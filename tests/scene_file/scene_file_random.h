#pragma once

#include <cmath>
#include <cstddef>
#include <optional>
#include <random>
#include <string>
#include <vector>

#include "splotchcl/scene.h"

namespace splotchcl::test {

// Scenes with every kind of value that a scene file can hold, awkward ones included.
class RandomScenes {
 public:
  explicit RandomScenes(unsigned seed) : random_(seed) {}

  Scene next() {
    Scene scene;
    if (coin()) {
      scene.snapshot = word();
    } else if (coin()) {
      scene.time = time();
    }
    scene.tolerance = unit();
    if (coin()) scene.read = read_settings(scene.time.is_set());
    scene.image = {integer(1, 16384),
                   integer(1, 16384),
                   {light(), light(), light()},
                   gamma(),
                   "",
                   coin() ? PixelConvention::upright : PixelConvention::original};
    if (coin()) {
      scene.image.background = {0, 0, 0};
      scene.image.background_image = word();
    }
    if (coin()) scene.camera = camera(scene.image);
    if (coin()) scene.stereo = stereo(scene);
    scene.kernel = {positive(1e-6, 1e6), maybe(positive()),
                    coin() ? Sampling::mean : Sampling::center, coin() ? 0 : unit()};
    if (coin()) {
      scene.sort.by = SortOrder::By::field;
      scene.sort.field = word();
    }
    scene.sort.descending = coin();
    scene.path = path();
    scene.movie.frames_per_second = positive(0.011, 999);
    scene.movie.rate_factor = integer(0, 51);
    if (coin()) scene.movie.frames = integer(1, 1000000);
    if (coin()) scene.movie.codec = static_cast<Codec>(integer(0, 2));
    scene.periodic = {coin(), maybe(positive())};
    if (coin()) scene.finish = finish();
    if (coin()) scene.map = map();
    if (scene.camera && is_wide_angle(scene.camera->projection)) {
      scene.finish.scale_bar.show = false;
    }
    const int components = integer(0, 4);
    for (int i = 0; i < components; ++i)
      scene.components.push_back(component(i));
    return scene;
  }

 private:
  ReadSettings read_settings(bool is_sequence) {
    ReadSettings read;
    for (int i = is_sequence ? 0 : integer(0, 3); i > 0; --i)
      read.columns.push_back(word());
    if (!is_sequence && coin()) {
      read.every = integer(1, 1000);
    } else if (!is_sequence) {
      read.max_particles = integer(1, 1 << 30);
    }
    read.seed = integer(0, 1 << 30);
    read.neighbors = integer(1, 4096);
    read.cache_smoothing_lengths = coin();
    return read;
  }
  bool coin() { return integer(0, 1) == 1; }
  int integer(int from, int to) { return std::uniform_int_distribution<int>(from, to)(random_); }
  double unit() { return std::uniform_real_distribution<double>(0, 1)(random_); }
  // Over many powers of ten, with all digits.
  double positive(double from = 1e-290, double to = 1e290) {
    return std::exp(std::log(from) + unit() * (std::log(to) - std::log(from)));
  }
  double any() { return coin() ? positive() : -positive(); }
  double length() { return coin() ? integer(-1000, 1000) : positive(1e-20, 1e20); }
  double light() { return coin() ? integer(0, 3) : positive(1e-30, 1e29); }
  double gamma() { return coin() ? 2.2 : positive(0.011, 99); }
  std::optional<double> maybe(double value) {
    return coin() ? std::optional<double>(value) : std::nullopt;
  }

  std::string word() {
    static const std::vector<std::string> parts = {
        "U", "snap_092.hdf5", "a b", "\"", "\\", "\n", "\t",   "\x01", "\x7f", "é",  "#",
        "'", "[x]",           "= 3", "/",  ".",  "\r", "\"\"", "銀河", "0",    "{}", "\b\f",
    };
    std::string text;
    const int count = integer(1, 4);
    for (int i = 0; i < count; ++i) {
      text += parts[static_cast<std::size_t>(integer(0, static_cast<int>(parts.size()) - 1))];
    }
    return text;
  }

  Camera camera(const ImageSettings& image) {
    Camera camera;
    choose_projection(camera, image);
    do {
      camera.position = {{length(), length(), length()}};
      camera.look_at = {{length(), length(), length()}};
      camera.sky = {{unit(), unit(), unit()}};
    } while (!is_usable(camera));
    const bool may_be_behind = camera.projection == Projection::orthographic;
    camera.near_limit = maybe(may_be_behind && coin() ? -unit() : unit());
    camera.far_limit = maybe(1 + positive());
    return camera;
  }
  // A projection that the picture's shape allows, with a field of view that it may have.
  void choose_projection(Camera& camera, const ImageSettings& image) {
    camera.projection = static_cast<Projection>(integer(0, 2));
    if (image.width == image.height) camera.projection = Projection::cube;
    if (image.width >= 2 * image.height) camera.projection = Projection::equirectangular;
    if (camera.projection == Projection::cube || coin()) return;
    const bool may_be_wide = camera.projection == Projection::fisheye;
    if (camera.projection == Projection::equirectangular) {
      camera.field_of_view_degrees = 360;
    } else {
      camera.field_of_view_degrees = 0.001 + (may_be_wide ? 359 : 179) * unit();
      if (!may_be_wide && coin()) {
        camera.field_of_view_degrees.reset();
        camera.width = positive(1e-3, 1e3);
      }
    }
    camera.cube_layout = coin() ? CubeLayout::sheet : CubeLayout::files;
  }
  Stereo stereo(const Scene& scene) {
    Stereo stereo;
    stereo.angle_degrees = 0.001 + 44 * unit();
    const Projection projection = scene.camera ? scene.camera->projection : Projection::perspective;
    stereo.mode = coin() ? StereoMode::off_axis : StereoMode::parallel;
    if (projection == Projection::orthographic) stereo.mode = StereoMode::toe_in;
    stereo.eyes = coin() ? StereoEyes::right_shifted : StereoEyes::centered;
    stereo.layout = static_cast<StereoLayout>(integer(0, 5));
    return stereo;
  }
  static bool is_usable(Camera camera) {
    // Its projection fits the picture, which is not known here.
    camera.projection = Projection::perspective;
    camera.field_of_view_degrees.reset();
    try {
      make_camera_frame(camera, 1, 1);
      return true;
    } catch (const std::exception&) {
      return false;
    }
  }

  Vec3 point() { return {{length(), length(), length()}}; }

  PathSettings path() {
    PathSettings path;
    const int motion = integer(0, 3);
    if (motion == 1) path.file = word();
    if (motion == 2) {
      path.orbit.emplace().degrees = any();
      if (coin()) path.orbit->center = point();
      if (coin()) path.orbit->axis = point();
      path.orbit->radius = maybe(positive());
    }
    if (motion == 3) {
      path.fly.emplace().through = {point(), point()};
      if (coin()) path.fly->through.push_back(point());
      if (coin()) path.fly->look_at = point();
      path.fly->is_eased = coin();
    }
    double frame = 0;
    for (int i = integer(0, 3); i > 0; --i) {
      frame += positive(1e-3, 1e3);
      path.keyframes.push_back({frame,
                                {{"camera.position", "[1, 2.5, -3e+40]"},
                                 {"component." + word() + ".palette", "\"magma\""},
                                 {"image.gamma", "1.5"}}});
    }
    path.is_smooth = coin();
    path.look = coin() ? PathSettings::Look::point : PathSettings::Look::direction;
    return path;
  }

  SequenceSettings time() {
    SequenceSettings time;
    if (coin()) {
      const int count = integer(1, 3);
      for (int i = 0; i < count; ++i)
        time.snapshots.push_back(word());
    } else {
      time.pattern = "a%03d" + std::string(coin() ? "b%%" : "");
      if (coin()) time.first = integer(0, 99);
      if (coin()) time.last = integer(99, 999);
    }
    time.index = any();
    time.interpolation = static_cast<Interpolation>(integer(0, 2));
    time.omega_matter = maybe(unit());
    time.omega_lambda = maybe(any());
    time.hubble_rate = maybe(positive());
    return time;
  }

  Anchor anchor_on_picture() { return static_cast<Anchor>(integer(0, 7)); }
  DisplayColor display_color() { return {unit(), unit(), unit()}; }
  TextSettings text_settings() {
    return {coin() ? word() : "", anchor_on_picture(), maybe(0.001 + 0.4 * unit())};
  }
  std::optional<Vec3> maybe_vector() {
    return coin() ? std::make_optional(Vec3{{length(), length(), length()}}) : std::nullopt;
  }
  std::vector<std::string> words() {
    std::vector<std::string> list;
    for (int i = integer(0, 3); i > 0; --i)
      list.push_back(word());
    return list;
  }

  FinishSettings finish() {
    FinishSettings finish;
    finish.exposure = maybe(20 * unit() - 10);
    finish.tone = static_cast<ToneCurve>(integer(0, 2));
    finish.white = maybe(positive(1e-9, 1e9));
    finish.saturation = coin() ? 1 : 2 * unit();
    finish.contrast = coin() ? 1 : 2 * unit();
    finish.contrast_pivot = 0.001 + unit();
    finish.font = word();
    finish.text_size = 0.001 + 0.4 * unit();
    finish.text_color = display_color();
    finish.title = text_settings();
    finish.label = text_settings();
    finish.caption = text_settings();
    if (coin()) finish.frame = integer(-1000, 1000000);
    finish.color_bar = {coin(), anchor_on_picture(), 0.05 + 0.9 * unit(), words(), words()};
    finish.scale_bar = {coin(), anchor_on_picture(), maybe(positive()), coin() ? word() : ""};
    finish.inset = {coin(),         anchor_on_picture(), {0.1 + 0.5 * unit(), 0.1 + 0.5 * unit()},
                    0.1 * unit(),   display_color(),     maybe_vector(),
                    maybe_vector(), maybe_vector(),      maybe(0.1 + 179 * unit()),
                    words()};
    finish.cross_fade = {coin() ? word() : "", unit()};
    finish.fade = unit();
    finish.fade_color = display_color();
    return finish;
  }

  FieldMap field_map() {
    if (coin()) return {};
    FieldMap map;
    map.field = word();
    map.scaling = static_cast<Scaling>(integer(0, 2));
    const double low = map.scaling == Scaling::log ? positive(1e-290, 1) : any();
    map.minimum = maybe(low);
    map.maximum = maybe(low + positive(1, 1e280));
    const bool has_both_limits = map.minimum && map.maximum;
    if (!has_both_limits && coin()) map.percentiles = {50 * unit(), 50.1 + 49 * unit()};
    return map;
  }

  MapSettings map() {
    MapSettings map;
    if (coin()) map.component = word();
    if (coin()) map.quantity = word();
    map.statistic = static_cast<MapStatistic>(integer(0, 2));
    if (coin()) map.weight = word();
    map.slice = coin();
    map.view = static_cast<MapView>(integer(0, 3));
    if (coin()) map.center = place();
    map.center_at = static_cast<MapCenter>(integer(0, 2));
    map.width = maybe(positive());
    map.depth = maybe(positive());
    if (coin()) map.periodic = coin();
    for (std::string* const unit :
         {&map.unit, &map.length_unit, &map.mass_unit, &map.velocity_unit}) {
      if (coin()) *unit = word();
    }
    map.floor = positive(1e-11, 1);
    map.noise = coin();
    if (coin()) map.distance = word();
    if (coin()) map.sky = {360 * unit(), 180 * unit() - 90};
    if (coin()) map.scaling = static_cast<MapScaling>(integer(0, 3));
    map.softening = maybe(positive());
    map.exponent = 0.01 + 9 * unit();
    map.minimum = maybe(any());
    map.maximum = maybe(any());
    const bool has_both_limits = map.minimum && map.maximum;
    if (!has_both_limits && coin()) map.percentiles = {50 * unit(), 50.1 + 49 * unit()};
    map.palette = word();
    if (coin()) {
      map.contour_count = integer(1, 100);
    } else {
      for (int i = integer(0, 3); i > 0; --i)
        map.contours.push_back(any());
    }
    return map;
  }

  Vec3 place() { return {{length(), length(), length()}}; }

  ParticleSet particle_set() {
    ParticleSet set;
    if (coin()) set.where = {"U > 1e5", "RHO <= -3.5 or \"é\" != 0"};
    if (coin()) set.id_file = word();
    if (coin()) set.halo = 12;
    if (set.halo && coin()) set.halo_catalog = word();
    if (coin()) {
      set.box_minimum = place();
      set.box_maximum = Vec3(*set.box_minimum + Vec3{{unit(), positive(1e-3, 1e3), 0}});
    }
    if (coin()) {
      set.sphere_center = place();
      set.sphere_radius = positive();
    }
    return set;
  }

  Placement placement() {
    Placement placement;
    if (coin()) placement.origin = place();
    if (coin()) placement.axis = {{unit(), -positive(), length()}};
    if (coin()) placement.angle_degrees = length();
    if (coin()) placement.scale = positive();
    return placement;
  }

  Absorption absorption() {
    switch (integer(0, 3)) {
      case 0:
        return {Absorption::Kind::none, 0};
      case 1:
        return {Absorption::Kind::factor, positive()};
      case 2:
        return {Absorption::Kind::gray, light()};
      default:
        return {Absorption::Kind::as_emission, 0};
    }
  }

  Component component(int index) {
    Component component;
    if (coin()) component.name = word() + "-" + std::to_string(index);
    component.types = {integer(0, 31)};
    if (coin()) component.types.push_back((component.types[0] + integer(1, 31)) % 32);
    if (coin()) component.snapshot = word();
    component.select = particle_set();
    component.exclude = particle_set();
    if (coin()) component.center = place();
    component.placement = placement();
    component.size_factor = positive();
    if (coin()) {
      component.size_fixed = positive();
    } else {
      component.size_field = word();
    }
    component.color = field_map();
    if (coin()) component.absorption_palette = word();
    const bool may_have_vector =
        component.color.field.empty() || !component.absorption_palette.empty();
    if (may_have_vector && coin()) component.color_vector = word();
    component.intensity = field_map();
    if (coin()) component.weight = static_cast<WeightModel>(integer(0, 2));
    component.palette = word();
    component.brightness = light();
    component.absorption = absorption();
    component.reference_column = maybe(positive());
    return component;
  }

  std::mt19937 random_;
};

}  // namespace splotchcl::test
