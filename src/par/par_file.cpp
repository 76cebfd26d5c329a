#include "par/par_file.h"

#include <fmt/format.h>

#include <algorithm>
#include <cctype>
#include <cmath>
#include <sstream>

#include "common/mapped_file.h"
#include "common/words.h"
#include "par/translate.h"
#include "scene_file/keys.h"
#include "splotchcl/error.h"
#include "splotchcl/par_file.h"
#include "splotchcl/scene_file.h"

namespace splotchcl::par {

ParFile::ParFile(const std::string& text, std::string name_for_messages)
    : name_(std::move(name_for_messages)) {
  std::istringstream lines(text);
  std::string line;
  for (int number = 1; std::getline(lines, line); ++number)
    add(trimmed(line.substr(0, line.find('#'))), number);
}

void ParFile::add(const std::string& line, int number) {
  if (line.empty()) return;
  const std::size_t equals = line.find('=');
  // Remarks in brackets or dashes stood in some files without a mark.
  const std::string key = equals == std::string::npos ? "" : trimmed(line.substr(0, equals));
  if (key.empty() || key.find_first_of(" \t") != std::string::npos) {
    throw UsageError(fmt::format("{}:{}: found \"{}\", expected key=value, or # before a remark",
                                 name_, number, line));
  }
  // What follows a blank after a value is a remark in the original's own files.
  const Entry entry = {trimmed(line.substr(equals + 1)), number};
  const auto [place, is_new] = entries_.insert_or_assign(key, entry);
  if (!is_new) {
    notes_.push_back(
        fmt::format("{}:{}: {} is given again; the last value counts", name_, number, key));
  }
}

std::optional<std::string> ParFile::text(const std::string& key) {
  const auto found = entries_.find(key);
  if (found == entries_.end()) return std::nullopt;
  used_.insert(key);
  if (found->second.value.empty()) return std::nullopt;
  return found->second.value;
}

std::optional<double> ParFile::number(const std::string& key) {
  const auto value = text(key);
  if (!value) return std::nullopt;
  // "30   (default: 4)": a remark without its mark.
  const auto number = parse_number(value->substr(0, value->find_first_of(" \t")));
  if (!number || !std::isfinite(*number)) refuse(key, "a finite number");
  return number;
}

std::optional<int> ParFile::integer(const std::string& key, int lowest, int highest) {
  const auto value = number(key);
  if (!value) return std::nullopt;
  if (*value != std::floor(*value) || *value < lowest || *value > highest) {
    refuse(key, fmt::format("a whole number from {} to {}", lowest, highest));
  }
  return static_cast<int>(*value);
}

std::optional<bool> ParFile::boolean(const std::string& key) {
  const auto value = text(key);
  if (!value) return std::nullopt;
  const std::string word = lower_case(value->substr(0, value->find_first_of(" \t")));
  if (word == "t" || word == "true" || word == "1") return true;
  if (word == "f" || word == "false" || word == "0") return false;
  refuse(key, "T or F");
}

void ParFile::refuse(const std::string& key, const std::string& expected) const {
  const auto found = entries_.find(key);
  if (found == entries_.end()) {
    throw UsageError(fmt::format("{}: key {}: found nothing, expected {}", name_, key, expected));
  }
  throw UsageError(fmt::format("{}:{}: key {}: found \"{}\", expected {}", name_,
                               found->second.line, key, found->second.value, expected));
}

std::vector<std::string> ParFile::unused() const {
  std::vector<std::string> keys;
  for (const auto& [key, entry] : entries_) {
    if (used_.count(key) == 0) keys.push_back(key);
  }
  std::sort(keys.begin(), keys.end(), [this](const std::string& a, const std::string& b) {
    return entries_.at(a).line < entries_.at(b).line;
  });
  return keys;
}

const std::vector<std::string>& translated_keys() {
  static const std::vector<std::string> keys = {"infile",
                                                "fidx",
                                                "interpolation_mode",
                                                "hubble",
                                                "omega",
                                                "lambda",
                                                "l_unit",
                                                "v_unit",
                                                "simtype",
                                                "periodic",
                                                "ptypes",
                                                "ptypeN",
                                                "size_labelN",
                                                "size_facN",
                                                "size_fixN",
                                                "color_labelN",
                                                "color_logN",
                                                "color_asinhN",
                                                "color_minN",
                                                "color_maxN",
                                                "color_facN",
                                                "color_is_vectorN",
                                                "intensity_labelN",
                                                "intensity_logN",
                                                "intensity_minN",
                                                "intensity_maxN",
                                                "paletteN",
                                                "brightnessN",
                                                "smooth_factorN",
                                                "gray_absorptionN",
                                                "xres",
                                                "yres",
                                                "resolution",
                                                "fov",
                                                "projection",
                                                "panorama",
                                                "dome",
                                                "camera_x",
                                                "camera_y",
                                                "camera_z",
                                                "lookat_x",
                                                "lookat_y",
                                                "lookat_z",
                                                "sky_x",
                                                "sky_y",
                                                "sky_z",
                                                "center_x",
                                                "center_y",
                                                "center_z",
                                                "zmin",
                                                "zmax",
                                                "a_eq_e",
                                                "gray_absorption",
                                                "sort_type",
                                                "minrad_pix",
                                                "EyeSeparation",
                                                "pic_gamma",
                                                "pic_brightness",
                                                "pic_contrast",
                                                "colorbar",
                                                "scene_file",
                                                "geometry_file"};
  return keys;
}

const std::vector<UntranslatedKey>& untranslated_keys() {
  constexpr const char* found_out = "is found out from the snapshot itself";
  constexpr const char* performance = "says how to compute, which this program decides";
  static const std::vector<UntranslatedKey> keys = {
      {"numfiles", found_out, true},
      {"swap_endian", found_out, true},
      {"size_presentN", found_out, true},
      {"color_presentN", found_out, true},
      {"intensity_presentN", found_out, true},
      {"snapshot_spacing", "is found out from the files that exist", true},
      {"id_label", found_out, true},
      {"readparallel", performance, true},
      {"gpu_number", performance, true},
      {"cores_number", performance, true},
      {"gpu_info", performance, true},
      {"particle_mem_factor", performance, true},
      {"tile_boundary_width", performance, true},
      {"tile_x-side", performance, true},
      {"tile_y-side", performance, true},
      {"max_region", performance, true},
      {"graphics_memory_size", performance, true},
      {"fragment_buffer_size", performance, true},
      {"block_size", performance, true},
      {"test_load_balancing", performance, true},
      {"gpu_loadN", performance, true},
      {"use_host_as_thread", performance, true},
      {"host_load", performance, true},
      {"AnalyzeSimulationOnly", performance, true},
      {"outfile", "is not used: name the picture with --output", true},
      {"pictype", "is not used: the ending of --output chooses the format", true},
      {"geometry_start", "is not used: choose frames with movie --frames", false},
      {"geometry_incr", "is not used: choose frames with movie --frames", false},
      {"snap_start", "is not used: name snapshots with --set time.snapshots", false},
      {"snap_interpol", "is not used: set time.interpolation", false},
      {"ycutN", "is not used: choose a part with render --crop", false},
      {"boostcolors", "has no counterpart", false},
      {"snapdir", "has no counterpart: give infile with its folder", false},
  };
  return keys;
}

std::string general_name(const std::string& key) {
  std::size_t end = key.size();
  while (end > 0 && std::isdigit(static_cast<unsigned char>(key[end - 1])) != 0)
    --end;
  return end == key.size() ? key : key.substr(0, end) + "N";
}

std::vector<std::string> explain_untranslated(const std::vector<std::string>& keys) {
  std::vector<std::string> notes, harmless;
  for (const std::string& key : keys) {
    const auto& known = untranslated_keys();
    const auto found = std::find_if(known.begin(), known.end(), [&](const UntranslatedKey& k) {
      return key == k.name || general_name(key) == k.name;
    });
    if (found == known.end()) {
      std::vector<std::string> names = translated_keys();
      for (const UntranslatedKey& k : known)
        names.emplace_back(k.name);
      notes.push_back(fmt::format("key {} is not known and has no effect{}", key,
                                  did_you_mean(nearest_name(general_name(key), names))));
    } else if (found->is_harmless) {
      harmless.push_back(key);
    } else {
      notes.push_back(fmt::format("key {} {}", key, found->reason));
    }
  }
  if (!harmless.empty()) {
    notes.push_back(fmt::format("keys that a scene does not need: {}", fmt::join(harmless, ", ")));
  }
  return notes;
}

}  // namespace splotchcl::par

namespace splotchcl {
namespace fs = std::filesystem;

namespace {

// Mistakes that only the scene shows have its keys, and its lines, which no file has.
[[noreturn]] void refuse_as_scene(const std::string& message, const std::string& par) {
  const std::size_t line = par.size() + 1;
  const bool names_line = message.compare(0, line, par + ":") == 0;
  const std::size_t end = names_line ? message.find_first_not_of("0123456789", line) : line;
  if (!names_line || end == line || end == std::string::npos) throw UsageError(message);
  throw UsageError(fmt::format("{}: as a scene{}", par, message.substr(end)));
}

}  // namespace

Scene read_par_file(const fs::path& path, const std::vector<std::string>& settings,
                    std::vector<std::string>& notes) {
  par::ParFile file(read_text_file(path), path.string());
  par::Translation translation(file, path.parent_path());
  par::translate_snapshot(translation);
  par::translate_camera(translation);
  par::translate_picture(translation);
  par::translate_order(translation);
  par::translate_components(translation);
  for (const auto& more :
       {file.notes(), translation.notes, par::explain_untranslated(file.unused())}) {
    for (const std::string& note : more)
      notes.push_back(fmt::format("{}: {}", path.filename().string(), note));
  }
  try {
    return parse_scene(translation.scene.text(), path.string(), settings);
  } catch (const UsageError& error) {
    refuse_as_scene(error.what(), path.string());
  }
}

Scene with_paths_from(Scene scene, const fs::path& folder) {
  const fs::path from = fs::absolute(folder.empty() ? fs::path(".") : folder).lexically_normal();
  const auto seen_from = [&from](const std::string& path) {
    if (fs::path(path).is_absolute()) return path;
    return fs::absolute(path).lexically_normal().lexically_proximate(from).string();
  };
  scene_file::change_file_names(scene, seen_from);
  if (!scene.time.pattern.empty()) scene.time.pattern = seen_from(scene.time.pattern);
  return scene;
}

}  // namespace splotchcl
