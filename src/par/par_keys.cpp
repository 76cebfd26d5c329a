#include "par/par_keys.h"

#include <fmt/format.h>

#include <algorithm>
#include <cctype>

#include "common/nearest_name.h"

namespace splotchcl::par {

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
