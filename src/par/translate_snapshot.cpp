#include <fmt/format.h>

#include <cctype>
#include <cmath>

#include "common/mapped_file.h"
#include "common/physical_constants.h"
#include "film/path/path_table.h"
#include "par/translate.h"
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

}  // namespace splotchcl::par
