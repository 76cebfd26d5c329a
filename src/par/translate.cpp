#include "par/translate.h"

#include <fmt/format.h>

#include <algorithm>
#include <cctype>
#include <cmath>

#include "common/mapped_file.h"
#include "film/path/path_table.h"
#include "scene/constants.h"
#include "scene_file/values.h"
#include "snapshot/snapshot_files.h"
#include "splotchcl/error.h"
#include "splotchcl/snapshot.h"
#include "splotchcl/snapshot_file.h"

namespace splotchcl::par {
namespace {

std::filesystem::path find(const Translation& t, const std::filesystem::path& path) {
  if (path.is_absolute() || ExistingFiles().have(t.folder / path)) return t.folder / path;
  return ExistingFiles().have(path) ? path : t.folder / path;
}

// Files that cannot be read are refused when the path is.
std::map<std::string, double> first_row_of(const std::filesystem::path& path) {
  std::error_code ignored;
  if (!std::filesystem::is_regular_file(path, ignored)) return {};
  return first_path_row(read_text_file(path));
}

void translate_velocities(Translation& t) {
  const auto omega = t.par.number("omega"), lambda = t.par.number("lambda");
  const auto length = t.par.number("l_unit"), velocity = t.par.number("v_unit");
  t.par.number("hubble");  // drops out of H0 in units that contain 1/h
  if (omega) t.scene.set_number("time.omega_matter", *omega);
  if (lambda) t.scene.set_number("time.omega_lambda", *lambda);
  if (!length && !velocity) return;
  constexpr double km_in_cm = 1e5;
  const double hubble_rate =
      0.1 * (length.value_or(kpc_in_cm) / kpc_in_cm) / (velocity.value_or(km_in_cm) / km_in_cm);
  if (!(hubble_rate > 0) || !std::isfinite(hubble_rate)) t.par.refuse("l_unit", "a unit > 0 in cm");
  t.scene.set_number("time.hubble_rate", hubble_rate);
}

// Whether positions are to be wrapped: by default where there is a box.
void translate_periodic(Translation& t, const std::filesystem::path& snapshot) {
  const auto wanted = t.par.boolean("periodic");
  if (wanted == false) return;
  bool has_box = false;
  try {
    has_box = open_snapshot(snapshot)->info().box_size.has_value();
  } catch (const Error&) {
    // What is wrong with it will be said when it is drawn.
  }
  if (!wanted && !has_box) return;
  t.scene.set("periodic.wrap", "true");
}

// Where the film begins in the sequence, within what `time.last` may be.
double snapshot_index(Translation& t) {
  constexpr double largest = 999999999;
  const double index = t.number_at_start("fidx").value_or(0);
  if (index >= 0 && index <= largest) return index;
  const std::string expected = fmt::format("a number from 0 to {:.0f}", largest);
  if (t.par.has("fidx")) t.par.refuse("fidx", expected);
  throw UsageError(fmt::format("the path's column fidx: found {} in its first row, expected {}",
                               index, expected));
}

void note_simtype(Translation& t) {
  const auto simtype = t.par.integer("simtype", 0, 1000);
  const bool is_gadget_or_tipsy = !simtype || *simtype == 2 || *simtype == 8 || *simtype == 11;
  if (is_gadget_or_tipsy) return;
  t.note(fmt::format("simtype {} is not used: the format is recognised by the file's content",
                     *simtype));
}

}  // namespace

void translate_snapshot(Translation& t) {
  note_simtype(t);
  const auto infile = t.par.text("infile");
  if (!infile) t.par.refuse("infile", "the snapshot's name without its number");
  const int mode = t.par.integer("interpolation_mode", 0, 2).value_or(0);
  const auto scene_path = t.par.text("scene_file"), geometry_path = t.par.text("geometry_file");
  const auto path = scene_path ? scene_path : geometry_path;
  if (path) {
    t.scene.set_text("path.file", t.file(*path).string());
    t.path_row = first_row_of(t.file(*path));
  }
  const double index = snapshot_index(t);

  const std::string numbered = fill_pattern(as_pattern(*infile) + "%03d", static_cast<int>(index));
  const bool is_numbered = ExistingFiles().have(find(t, numbered));
  // Older files of the original name the snapshot with its number.
  const bool ends_in_digit = std::isdigit(static_cast<unsigned char>(infile->back())) != 0;
  const bool is_whole_name = !is_numbered && (ExistingFiles().have(find(t, *infile)) ||
                                              (!t.par.has("fidx") && ends_in_digit));
  const bool is_sequence =
      !is_whole_name && (mode > 0 || index != std::floor(index) || t.path_row.count("fidx") > 0);
  const std::filesystem::path snapshot = find(t, is_whole_name ? *infile : numbered);
  if (is_sequence) {
    const std::filesystem::path folder = snapshot.parent_path();
    const std::string name = std::filesystem::path(*infile + "x").filename().string();
    const std::string pattern = as_pattern(name.substr(0, name.size() - 1)) + "%03d";
    t.scene.set_text("time.snapshots", as_pattern((folder / "").string()) + pattern);
    t.scene.set_number("time.index", index);
    constexpr const char* modes[] = {"none", "linear", "hermite"};
    t.scene.set_text("time.interpolation", modes[mode]);
    if (mode == 2) translate_velocities(t);
  } else {
    t.scene.set_text("snapshot", snapshot.string());
  }
  if (mode != 2 || !is_sequence) {
    for (const char* const key : {"hubble", "omega", "lambda", "l_unit", "v_unit"})
      t.par.number(key);  // of no effect without velocities in the original either
  }
  translate_periodic(t, snapshot);
}

using scene_file::write_number;
using scene_file::write_text;

void SceneText::set(const std::string& key, const std::string& value) {
  lines_.push_back(fmt::format("{} = {}", key, value));
}

void SceneText::set_text(const std::string& key, const std::string& value) {
  set(key, write_text(value));
}

void SceneText::set_number(const std::string& key, double value) {
  set(key, write_number(value));
}

void SceneText::set_vector(const std::string& key, double x, double y, double z) {
  set(key, fmt::format("[{}, {}, {}]", write_number(x), write_number(y), write_number(z)));
}

void SceneText::begin_component() {
  components_.emplace_back();
}

void SceneText::set_of_component(const std::string& key, const std::string& value) {
  components_.back().push_back(fmt::format("{} = {}", key, value));
}

std::string SceneText::text() const {
  std::string text = fmt::format("{}\n", fmt::join(lines_, "\n"));
  for (const auto& lines : components_)
    text += fmt::format("[[component]]\n{}\n", fmt::join(lines, "\n"));
  return text;
}

namespace {

void translate_eyes(const std::string& projection, Translation& t) {
  const double separation = t.par.number("EyeSeparation").value_or(0);
  if (separation == 0) return;
  const bool is_flat = projection == "orthographic";
  if (is_flat) {
    t.note(
        "EyeSeparation with a flat projection, whose parallel views are the same for both eyes: "
        "each eye looks at the look-at point instead");
  }
  t.scene.set_number("stereo.angle", separation);
  t.scene.set_text("stereo.mode", is_flat ? "toe_in" : "off_axis");
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
  if (is_dome && is_panorama) t.par.refuse("panorama", "F, since dome is T");
  if (is_dome) return "fisheye";
  if (is_panorama) return "cube";
  return is_perspective ? "perspective" : "orthographic";
}

// x, y and z of "camera", "lookat" or "sky".
std::vector<std::optional<double>> coordinates(const std::string& name, Translation& t) {
  std::vector<std::optional<double>> all;
  for (const char* const axis : {"_x", "_y", "_z"})
    all.push_back(t.number_at_start(name + axis));
  return all;
}

bool has_any(const std::vector<std::optional<double>>& values) {
  return std::any_of(values.begin(), values.end(), [](const auto& value) { return bool(value); });
}

void set_vector(const std::string& key, const std::vector<std::optional<double>>& from,
                double otherwise_z, Translation& t) {
  t.scene.set_vector(key, from[0].value_or(0), from[1].value_or(0), from[2].value_or(otherwise_z));
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

std::optional<double> Translation::number_at_start(const std::string& key) {
  const std::optional<double> own = par.number(key);
  const auto of_path = path_row.find(key);
  return own || of_path == path_row.end() ? own : of_path->second;
}

void translate_camera(Translation& t) {
  translate_center(t);
  const std::string name = projection(t);
  translate_eyes(name, t);
  const std::vector<std::optional<double>> place = coordinates("camera", t);
  const std::vector<std::optional<double>> look_at = coordinates("lookat", t);
  const std::vector<std::optional<double>> sky = coordinates("sky", t);
  const auto angle = t.par.number("fov"), near = t.par.number("zmin"), far = t.par.number("zmax");
  if (!has_any(place)) {
    t.note(
        "no camera_x, camera_y and camera_z: the camera is chosen from the data, and what else the "
        "file says of it is not carried over");
    return;
  }
  for (std::size_t i = 0; i < 3; ++i) {
    if (!look_at[i]) t.par.refuse(std::string("lookat_") + "xyz"[i], "a number, beside camera_x");
  }
  set_vector("camera.position", place, 0, t);
  set_vector("camera.look_at", look_at, 0, t);
  set_vector("camera.sky", sky, has_any(sky) ? 0 : 1, t);
  t.scene.set_text("camera.projection", name);
  if (name == "fisheye") {
    t.scene.set_number("camera.field_of_view", 180);
  } else if (name == "cube") {
    t.scene.set_text("camera.cube", "files");
  } else {
    t.scene.set_number("camera.field_of_view", angle.value_or(45));
  }
  t.scene.set_number("camera.near", near.value_or(0));
  t.scene.set("camera.through_clouds", "false");
  if (far) t.scene.set_number("camera.far", *far);
}

void translate_picture(Translation& t) {
  const int old_name = t.par.integer("resolution", 1, largest_side).value_or(800);
  const int width = t.par.integer("xres", 1, largest_side).value_or(old_name);
  const int height = t.par.integer("yres", 1, largest_side).value_or(width);
  t.scene.set("image.size", fmt::format("[{}, {}]", width, height));
  t.scene.set_text("image.convention", "original");

  const double gamma = t.par.number("pic_gamma").value_or(1);
  if (!(gamma > 0)) t.par.refuse("pic_gamma", "a number > 0");
  if (gamma != 1) t.scene.set_number("image.gamma", 1 / gamma);
  const double contrast = t.par.number("pic_contrast").value_or(1);
  if (!(contrast > 0)) t.par.refuse("pic_contrast", "a number > 0");
  // contrast c^gamma = (2^x c)^gamma
  if (contrast != 1) t.scene.set_number("finish.exposure", std::log2(contrast) / gamma);
  if (t.par.number("pic_brightness").value_or(0) != 0) {
    t.note("pic_brightness is not carried over: nothing here adds light to the whole picture");
  }
  if (t.par.boolean("colorbar").value_or(false)) {
    t.scene.set("finish.color_bar.show", "true");
    t.scene.set_text("finish.color_bar.at", "bottom");
    t.note("colorbar: the bars are drawn in this program's own way, with ticks");
  }

  // The cloud is exp(-d^2 / sigma^2) with sigma = 0.5 pi^(-1/6) r', r' = sqrt((2 h)^2 + minrad^2).
  const double width_over_h = std::pow(pi, -1.0 / 6);
  t.scene.set_number("kernel.width", width_over_h);
  t.scene.set_number("kernel.cut", 1.5 / width_over_h);  // 0.75 r'
  t.scene.set_text("kernel.sampling", "center");
  t.scene.set_number("kernel.min_radius", 0.5 * t.par.number("minrad_pix").value_or(1));
}

}  // namespace splotchcl::par
