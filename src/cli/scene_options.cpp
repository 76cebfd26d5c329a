#include "cli/scene_options.h"

#include <fmt/format.h>

#include <sstream>

#include "cli/command_builder.h"
#include "map/place.h"
#include "splotchcl/error.h"

namespace splotchcl::cli {
namespace {

void add_choices(CLI::App& sub, DrawOptions& options) {
  sub.add_option("--types", options.types, wrapped("Only these particle types: gas,stars or 0,4"))
      ->type_name("LIST");
  sub.add_option("--where,--select", options.where,
                 wrapped("Only particles that fulfil this, such as 'temperature > 1e6 && x < 5'; "
                         "can be repeated"))
      ->type_name("CONDITION")
      ->allow_extra_args(false);
  sub.add_option("--field", options.field,
                 wrapped("The field that is shown, or a formula of fields, such as "
                         "'log10(density * temperature)'"))
      ->type_name("FIELD");
  sub.add_option("--palette", options.palette,
                 wrapped("Its palette; splotchcl palettes lists them, or a file"))
      ->type_name("NAME");
  sub.add_option("--center", options.center,
                 wrapped("What is in the middle: X,Y,Z in the snapshot's lengths, or in a unit "
                         "that the last has: 25,25,25Mpc; or box, mass, densest or halo=N"))
      ->type_name("PLACE");
  sub.add_option("--width", options.width,
                 wrapped("Width that is shown, in the snapshot's lengths or with a unit: 4Mpc"))
      ->type_name("LENGTH");
  sub.add_option("--size", options.size, wrapped("Width and height in pixels"))
      ->type_name("WIDTHxHEIGHT");
}

void add_reading(CLI::App& sub, DrawOptions& options) {
  sub.add_option("--units", options.units,
                 wrapped("Units of a snapshot that does not say them: cgs, si, or gadget, which "
                         "stands for a kpc/h, 1e10 Msun/h and a^0.5 km/s"))
      ->type_name("NAME")
      ->check(one_of({"gadget", "cgs", "si"}));
  add_number(sub, "--every", options.every, "N",
             "Use every N-th particle, which counts for as much as is left out: a quick look at "
             "much data");
  add_number(sub, "--max-particles", options.max_particles, "N",
             "Use at most N particles, chosen at random, likewise");
  sub.add_flag(
      "--cache-smoothing-lengths", options.cache_smoothing_lengths,
      wrapped("Store computed smoothing lengths in a file beside the snapshot, and reuse them"));
}

void add_drawing(CLI::App& sub, DrawOptions& options) {
  sub.add_option("--device", options.device,
                 wrapped("Part of an OpenCL device's name; splotchcl devices lists them. Default: "
                         "a GPU if there is one"))
      ->type_name("NAME");
  sub.add_option("--set", options.settings, wrapped("Set a key of the scene; can be repeated"))
      ->type_name("KEY=VALUE")
      ->allow_extra_args(false);
}

}  // namespace

void add_live_options(CLI::App& sub, DrawOptions& options) {
  add_choices(sub, options);
  add_reading(sub, options);
  add_drawing(sub, options);
}

void add_scene_options(CLI::App& sub, DrawOptions& options) {
  add_live_options(sub, options);
  sub.add_flag(
      "--reference", options.reference,
      wrapped("Draw with the slow reference renderer in double precision instead of a device"));
}

const std::vector<MapOption>& map_options() {
  static const std::vector<MapOption> options = {
      {"quantity", "quantity", MapText::word, "NAME",
       "surface_density (the default), counts, line_of_sight_velocity, or a field (splotchcl "
       "fields lists them)"},
      {"statistic", "statistic", MapText::word, "NAME",
       "What to make of a field along each line of sight: mean (the default), dispersion or "
       "integral"},
      {"weight", "weight", MapText::word, "NAME",
       "Weight of means: mass (the default), volume, constant, or a field"},
      {"slice", "slice", MapText::flag, "",
       "Values in the plane through the centre instead of along the line of sight"},
      {"unit", "unit", MapText::word, "UNIT", "Unit of the map, such as Msun/pc^2, g/cm^2 or K"},
      {"noise", "noise", MapText::flag, "",
       "Add a second plane: the effective number of particles in each pixel"},
      {"channels", "channels", MapText::count, "N",
       "A cube: the sum in so many channels of velocity along the line of sight"},
      {"velocity-range", "velocity_range", MapText::numbers, "V,V",
       "Of the channels, in the snapshot's unit; default: all velocities"},
      {"line-mass", "line_mass", MapText::number, "M",
       "Lines of a cube have the thermal width of particles of so many proton masses"},
      {"healpix", "healpix", MapText::count, "NSIDE",
       "A Healpix map of the sphere around --center, with this NSIDE"},
      {"order", "healpix_order", MapText::word, "NAME",
       "Of its pixels: ring (the default) or nested"},
      {"shell", "shell", MapText::lengths, "RMIN,RMAX",
       "Between these distances from the centre: 10,20Mpc. Of a profile the innermost and "
       "outermost radius"},
      {"tile", "tile", MapText::flag, "",
       "Fill the shell with periodic images of the box; default: each particle once, where it is "
       "nearest"},
      {"voxels", "voxels", MapText::counts, "N|NX,NY,NZ",
       "A cube of voxels, --width along x: .fits, .hdf5, .npy or .vdb"},
      {"profile", "profile", MapText::count, "N",
       "A radial profile around --center in so many shells; also as .csv and .ecsv"},
      {"histogram", "histogram", MapText::words, "FIELD,FIELD",
       "A histogram of two fields, such as density,temperature"},
      {"bins", "bins", MapText::counts, "N|X,Y", "Of the histogram; default: 256"},
      {"x-range", "x_range", MapText::numbers, "V,V", "Of its first field; default: all values"},
      {"y-range", "y_range", MapText::numbers, "V,V", "Of its second field, likewise"},
      {"view", "view", MapText::word, "NAME",
       "xy (the default), xz or yz: the axes to the right and up; camera: the scene's view; sky: "
       "all around, from --center, --width in degrees"},
      {"distance", "distance", MapText::word, "LENGTH",
       "Distance of the observer, such as '16.5 Mpc', or redshift: adds coordinates on the sky"},
      {"sky", "sky", MapText::numbers, "RA,DEC",
       "Right ascension and declination of the centre in degrees"},
      {"contours", "contours", MapText::number_or_list, "N|V,V,...",
       "Contour lines on figures: how many, or at which values"},
      {"depth", "depth", MapText::length, "LENGTH",
       "Depth along the line of sight, likewise; particles outside are left out"},
  };
  return options;
}

void add_map_options(CLI::App& sub, MapOptions& options) {
  for (const MapOption& option : map_options()) {
    if (option.text == MapText::flag) {
      sub.add_flag("--" + option.name, options.flags[option.key], wrapped(option.help));
    } else {
      sub.add_option("--" + option.name, options.texts[option.key], wrapped(option.help))
          ->type_name(option.type);
    }
  }
}

namespace {

// "density,temperature" as TOML.
std::string list_of_words(const std::string& text) {
  std::istringstream words(text);
  std::string list;
  for (std::string word; std::getline(words, word, ',');)
    list += (list.empty() ? "'" : ", '") + word + "'";
  return "[" + list + "]";
}

std::string one_or_list(const std::string& numbers) {
  return numbers.find(',') == std::string::npos ? numbers : "[" + numbers + "]";
}

// "5" is a number of contours, "1e4,1e5" are their values.
std::string setting_of_contours(const std::string& text) {
  const bool is_count = text.find_first_not_of("0123456789") == std::string::npos;
  return is_count ? "map.contour_count=" + text : "map.contours=[" + text + "]";
}

void refuse_none(const MapOption& option, const std::string& counts) {
  if (counts.find_first_not_of("0, ") != std::string::npos) return;
  throw UsageError(fmt::format("--{}: found {}, expected at least 1", option.name, counts));
}

std::string setting_of(const MapOption& option, const std::string& text) {
  const std::string begin = "map." + option.key + "=";
  switch (option.text) {
    case MapText::word:
      return begin + "'" + text + "'";
    case MapText::count:
      refuse_none(option, text);
      return begin + text;
    case MapText::counts:
      refuse_none(option, text);
      return begin + one_or_list(text);
    case MapText::number:
      return begin + text;
    case MapText::numbers:
      return begin + "[" + text + "]";
    case MapText::words:
      return begin + list_of_words(text);
    case MapText::length:
      return setting_of_lengths(option.key, text, false);
    case MapText::lengths:
      return setting_of_lengths(option.key, text, true);
    case MapText::number_or_list:
      return setting_of_contours(text);
    case MapText::flag:
      break;
  }
  return begin + "true";
}

}  // namespace

std::string setting_of_lengths(const std::string& key, const std::string& lengths, bool is_list) {
  // The snapshot has to be known for a unit.
  if (!unit_of_lengths(lengths).empty()) return fmt::format("map.{}='{}'", key, lengths);
  return fmt::format(is_list ? "map.{}=[{}]" : "map.{}={}", key, lengths);
}

std::vector<std::string> settings_of_map_options(const MapOptions& options) {
  std::vector<std::string> settings;
  for (const MapOption& option : map_options()) {
    const auto flag = options.flags.find(option.key);
    const bool is_set = flag != options.flags.end() && flag->second;
    const std::string text = options.text_of(option.key);
    if (is_set || !text.empty()) settings.push_back(setting_of(option, text));
  }
  return settings;
}

}  // namespace splotchcl::cli
