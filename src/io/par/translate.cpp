#include "io/par/translate.h"

#include <fmt/format.h>

#include <cmath>

#include "io/scene_file/keys.h"

namespace splotchcl::par {
namespace {

constexpr double pi = 3.14159265358979323846;

// A key of ours that a version of this program may not have.
bool has_key(const std::string& key) {
  return scene_file::find_key(key) != nullptr;
}

void translate_eyes(Translation& t) {
  const double separation = t.par.number("EyeSeparation").value_or(0);
  if (separation == 0) return;
  if (!has_key("stereo.angle")) {
    t.note("EyeSeparation is not carried over: one picture is drawn");
    return;
  }
  t.scene.set_number("stereo.angle", separation);
  t.scene.set_text("stereo.mode", "off_axis");
  t.scene.set_text("stereo.eyes", "centered");
}

void translate_center(Translation& t) {
  bool is_elsewhere = false;
  for (const std::string axis : {"x", "y", "z"}) {
    const auto center = t.par.number("center_" + axis);
    is_elsewhere = is_elsewhere || (center && center != t.par.number("camera_" + axis));
  }
  if (is_elsewhere) {
    t.note(
        "center_x, center_y and center_z are not carried over: the look-at point is in the "
        "middle of the picture");
  }
}

// "perspective" and its like.
std::string projection(Translation& t) {
  const bool is_perspective = t.par.boolean("projection").value_or(true);
  const bool is_dome = t.par.boolean("dome").value_or(false);
  const bool is_panorama = t.par.boolean("panorama").value_or(false);
  if ((is_dome || is_panorama) && !has_key("camera.cube")) {
    t.note("dome and panorama are not carried over: a plain picture is drawn");
  } else if (is_dome) {
    return "fisheye";
  } else if (is_panorama) {
    t.scene.set_text("camera.cube", "files");
    return "cube";
  }
  return is_perspective ? "perspective" : "orthographic";
}

}  // namespace

std::filesystem::path Translation::file(const std::string& name) const {
  const std::filesystem::path path = name;
  if (path.is_absolute()) return path;
  // Palettes often lie beside the parameter file, though it names their folder.
  for (const auto& candidate : {folder / path, path, folder / path.filename()}) {
    std::error_code ignored;
    if (std::filesystem::exists(candidate, ignored)) return candidate;
  }
  return folder / path;
}

void translate_camera(Translation& t) {
  translate_center(t);
  const auto coordinate = [&t](const std::string& name, double otherwise) {
    return t.par.number(name).value_or(otherwise);
  };
  const bool has_camera = t.par.has("camera_x") || t.par.has("camera_y") || t.par.has("camera_z");
  if (!has_camera) {
    t.note("no camera_x, camera_y and camera_z: the camera is chosen from the data or the path");
  } else {
    for (const std::string axis : {"x", "y", "z"}) {
      if (!t.par.has("lookat_" + axis)) t.par.refuse("lookat_" + axis, "a number, beside camera_x");
    }
    t.scene.set_vector("camera.position", coordinate("camera_x", 0), coordinate("camera_y", 0),
                       coordinate("camera_z", 0));
    t.scene.set_vector("camera.look_at", coordinate("lookat_x", 0), coordinate("lookat_y", 0),
                       coordinate("lookat_z", 0));
  }
  const bool has_sky = t.par.has("sky_x") || t.par.has("sky_y") || t.par.has("sky_z");
  const double x = coordinate("sky_x", 0), y = coordinate("sky_y", 0);
  const double z = coordinate("sky_z", has_sky ? 0 : 1);
  const std::string name = projection(t);
  const double angle = t.par.number("fov").value_or(45);
  const double near = t.par.number("zmin").value_or(0);
  const auto far = t.par.number("zmax");
  translate_eyes(t);
  if (!has_camera) return;
  t.scene.set_vector("camera.sky", x, y, z);
  t.scene.set_text("camera.projection", name);
  if (name == "fisheye") {
    t.scene.set_number("camera.field_of_view", 180);
  } else if (name != "cube") {
    t.scene.set_number("camera.field_of_view", angle);
  }
  t.scene.set_number("camera.near", near);
  if (far) t.scene.set_number("camera.far", *far);
}

void translate_picture(Translation& t) {
  constexpr int largest = 65536;
  const int old_name = t.par.integer("resolution", 1, largest).value_or(800);
  const int width = t.par.integer("xres", 1, largest).value_or(old_name);
  const int height = t.par.integer("yres", 1, largest).value_or(width);
  t.scene.set("image.size", fmt::format("[{}, {}]", width, height));
  t.scene.set_text("image.convention", "original");

  const double gamma = t.par.number("pic_gamma").value_or(1);
  if (!(gamma > 0)) t.par.refuse("pic_gamma", "a number > 0");
  if (gamma != 1) t.scene.set_number("image.gamma", 1 / gamma);
  const double contrast = t.par.number("pic_contrast").value_or(1);
  if (!(contrast > 0)) t.par.refuse("pic_contrast", "a number > 0");
  if (contrast != 1) {
    // contrast c^gamma = (2^x c)^gamma
    if (has_key("finish.exposure")) {
      t.scene.set_number("finish.exposure", std::log2(contrast) / gamma);
    } else {
      t.note("pic_contrast is not carried over");
    }
  }
  if (t.par.number("pic_brightness").value_or(0) != 0) {
    t.note("pic_brightness is not carried over: nothing here adds light to the whole picture");
  }
  if (t.par.boolean("colorbar").value_or(false)) {
    if (has_key("finish.color_bar.show")) {
      t.scene.set("finish.color_bar.show", "true");
      t.scene.set_text("finish.color_bar.at", "bottom");
      t.note("colorbar: the bars are drawn in this program's own way, with ticks");
    } else {
      t.note("colorbar is not carried over");
    }
  }

  // The cloud is exp(-d^2 / sigma^2) with sigma = 0.5 pi^(-1/6) r', r' = sqrt((2 h)^2 + minrad^2).
  const double width_over_h = std::pow(pi, -1.0 / 6);
  t.scene.set_number("kernel.width", width_over_h);
  t.scene.set_number("kernel.cut", 1.5 / width_over_h);  // 0.75 r'
  t.scene.set_text("kernel.sampling", "center");
  t.scene.set_number("kernel.min_radius", 0.5 * t.par.number("minrad_pix").value_or(1));
}

}  // namespace splotchcl::par
