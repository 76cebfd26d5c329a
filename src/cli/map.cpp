#include "splotchcl/map.h"

#include <fmt/format.h>

#include <map>
#include <sstream>

#include "cli/command_builder.h"
#include "cli/commands.h"
#include "common/output_files.h"
#include "common/quiet_errors.h"
#include "open_scene/input_files.h"
#include "snapshot/field_names.h"
#include "snapshot/unit.h"
#include "splotchcl/error.h"
#include "splotchcl/load.h"
#include "splotchcl/open_scene.h"
#include "splotchcl/reference.h"
#include "splotchcl/renderer.h"
#include "splotchcl/scene_file.h"

namespace splotchcl::cli {
namespace {

void add_quantity_options(CLI::App& sub, MapOptions& options) {
  sub.add_option("--quantity", options.quantity,
                 wrapped("surface_density (the default), counts, line_of_sight_velocity, or a "
                         "field (splotchcl fields lists them)"))
      ->type_name("NAME");
  sub.add_option("--statistic", options.statistic,
                 wrapped("What to make of a field along each line of sight: mean (the default), "
                         "dispersion or integral"))
      ->type_name("NAME");
  sub.add_option("--weight", options.weight,
                 wrapped("Weight of means: mass (the default), volume, constant, or a field"))
      ->type_name("NAME");
  sub.add_flag(
      "--slice", options.slice,
      wrapped("Values in the plane through the centre instead of along the line of sight"));
  sub.add_option("--types", options.types, wrapped("Particle types: gas,stars or 0,4"))
      ->type_name("LIST");
  sub.add_option(
         "--select", options.select,
         wrapped("Only particles that fulfil this, such as 'temperature > 1e6'; can be repeated"))
      ->type_name("CONDITION")
      ->allow_extra_args(false);
  sub.add_option("--unit", options.unit, wrapped("Unit of the map, such as Msun/pc^2, g/cm^2 or K"))
      ->type_name("UNIT");
  sub.add_flag("--noise", options.noise,
               wrapped("Add a second plane: the effective number of particles in each pixel"));
}

void add_velocity_options(CLI::App& sub, MapOptions& options) {
  sub.add_option("--channels", options.channels,
                 wrapped("A cube: the sum in so many channels of velocity along the line of sight"))
      ->type_name("N");
  sub.add_option("--velocity-range", options.velocity_range,
                 wrapped("Of the channels, in the snapshot's unit; default: all velocities"))
      ->type_name("V,V");
  sub.add_option("--line-mass", options.line_mass,
                 wrapped("Lines of a cube have the thermal width of particles of so many proton "
                         "masses"))
      ->type_name("M");
}

void add_view_options(CLI::App& sub, MapOptions& options) {
  sub.add_option(
         "--view", options.view,
         wrapped(
             "xy (the default), xz or yz: the axes to the right and up; camera: the scene's view"))
      ->type_name("NAME");
  sub.add_option(
         "--center", options.center,
         wrapped("Centre of the map: X,Y,Z in the snapshot's lengths, or in a unit that the last "
                 "has: 25,25,25Mpc; or box, mass or densest"))
      ->type_name("PLACE");
  sub.add_option("--width", options.width,
                 wrapped("Width of the map, in the snapshot's lengths or with a unit: 4Mpc"))
      ->type_name("LENGTH");
  sub.add_option("--distance", options.distance,
                 wrapped("Distance of the observer, such as '16.5 Mpc', or redshift: adds "
                         "coordinates on the sky"))
      ->type_name("LENGTH");
  sub.add_option("--sky", options.sky,
                 wrapped("Right ascension and declination of the centre in degrees"))
      ->type_name("RA,DEC");
  sub.add_option("--contours", options.contours,
                 wrapped("Contour lines on figures: how many, or at which values"))
      ->type_name("N|V,V,...");
  sub.add_option("--depth", options.depth,
                 wrapped("Depth along the line of sight, likewise; particles outside are left out"))
      ->type_name("LENGTH");
  sub.add_option("--units", options.units,
                 wrapped("Units of a snapshot that does not say them: gadget stands for a kpc/h, "
                         "1e10 Msun/h and a^0.5 km/s"))
      ->type_name("NAME")
      ->check(CLI::IsMember({"gadget"}));
  sub.add_option("--size", options.size, wrapped("Size of the map, in pixels"))->type_name("WxH");
}

void add_drawing_options(CLI::App& sub, MapOptions& options) {
  sub.add_option("--device", options.device,
                 wrapped("Part of an OpenCL device's name; splotchcl devices lists them"))
      ->type_name("NAME");
  sub.add_option("--set", options.settings, wrapped("Set a key of the scene; can be repeated"))
      ->type_name("KEY=VALUE")
      ->allow_extra_args(false);
  sub.add_option("--tolerance", options.tolerance,
                 wrapped("Largest error of each sum, relative to it, or to map.floor if it is "
                         "below that; 0: 1e-6. Default: the scene's, or 0.001"))
      ->type_name("X");
  sub.add_option("--every", options.every, wrapped("Read every N-th particle"))->type_name("N");
  sub.add_option("--max-particles", options.max_particles, wrapped("Read at most N, at random"))
      ->type_name("N");
  sub.add_flag(
      "--cache-smoothing-lengths", options.cache_smoothing_lengths,
      wrapped("Store computed smoothing lengths in a file beside the snapshot, and reuse them"));
  sub.add_flag("--reference", options.reference,
               wrapped("Draw with the slow reference renderer in double precision"));
}

}  // namespace

void add_map(CLI::App& app, Run& run, Console& console) {
  const auto options = std::make_shared<MapOptions>();
  CLI::App* const sub =
      add_command<MapOptions>(app, run, "map", "Make a map of a quantity in its unit", options,
                              [&console](const MapOptions& o) { return run_map(o, console); });
  sub->add_option("SCENE", options->scene, wrapped("A scene file (.toml) or a snapshot"))
      ->required();
  sub->add_option("-o,--output", options->outputs,
                  wrapped("The map; its ending chooses the format: .fits, .hdf5, .npy and .exr "
                          "hold the numbers, .png, .pdf and others a figure; can be repeated"))
      ->required()
      ->type_name("FILE")
      ->allow_extra_args(false);
  add_quantity_options(*sub, *options);
  add_velocity_options(*sub, *options);
  add_view_options(*sub, *options);
  add_drawing_options(*sub, *options);
  sub->footer(
      "Examples:\n"
      "  splotchcl map snapshot_006 -o density.png\n"
      "  splotchcl map snapshot_006 --quantity temperature --view xy --unit K -o t.fits -o t.png\n"
      "  splotchcl map snapshot_006 --quantity temperature --slice --center densest -o slice.npy");
}

namespace {

std::string map_component(const MapOptions& options) {
  const std::string key = "map.component=";
  for (const std::string& setting : options.settings) {
    if (setting.rfind(key, 0) == 0) return setting.substr(key.size());
  }
  return "0";
}

// "Mpc" of "25,25,25 Mpc" or of "4Mpc"; nothing of numbers alone.
std::string unit_at_end(const std::string& lengths) {
  const std::size_t comma = lengths.rfind(','), first = comma == std::string::npos ? 0 : comma + 1;
  const std::size_t last = lengths.find_first_not_of(' ', first);
  if (last == std::string::npos) return {};
  const std::size_t unit = lengths.find_first_not_of(' ', end_of_number(lengths, last));
  return unit == std::string::npos ? "" : lengths.substr(unit);
}

// "gas,4" as TOML: ["gas", 4]
std::string list_of_types(const std::string& text) {
  std::istringstream words(text);
  std::string list;
  for (std::string word; std::getline(words, word, ',');) {
    const bool is_number =
        !word.empty() && word.find_first_not_of("0123456789") == std::string::npos;
    list += (list.empty() ? "" : ", ") + (is_number ? word : "'" + word + "'");
  }
  return "[" + list + "]";
}

// "5" is a number of contours, "1e4,1e5" are their values.
std::string contour_setting(const std::string& text) {
  const bool is_count = text.find_first_not_of("0123456789") == std::string::npos;
  return is_count ? "map.contour_count=" + text : "map.contours=[" + text + "]";
}

// A length or a place with a unit, which the snapshot has to be known for.
bool has_unit(const std::string& lengths) {
  return !unit_at_end(lengths).empty();
}

// Before those that the user gives.
std::vector<std::string> settings_of_units(const std::string& units) {
  if (units.empty()) return {};
  return {"map.length_unit='a kpc/h'", "map.mass_unit='1e10 Msun/h'",
          "map.velocity_unit='a^0.5 km/s'"};
}

// The options as settings of the scene, after those that the user gives.
std::vector<std::string> settings_of_map(const MapOptions& options) {
  std::vector<std::string> settings = settings_of_units(options.units);
  const std::vector<std::string> given = settings_of(options);
  settings.insert(settings.end(), given.begin(), given.end());
  const auto add = [&settings](const char* key, const std::string& value) {
    if (!value.empty()) settings.push_back(fmt::format("map.{}='{}'", key, value));
  };
  add("quantity", options.quantity);
  add("statistic", options.statistic);
  add("weight", options.weight);
  add("view", options.view);
  add("unit", options.unit);
  if (options.center.find(',') == std::string::npos) {
    add("center_at", options.center);
  } else if (!has_unit(options.center)) {
    settings.push_back("map.center=[" + options.center + "]");
  }
  add("distance", options.distance);
  if (!options.sky.empty()) settings.push_back("map.sky=[" + options.sky + "]");
  if (!options.contours.empty()) settings.push_back(contour_setting(options.contours));
  const auto add_length = [&settings](const char* key, const std::string& length) {
    if (!length.empty() && !has_unit(length))
      settings.push_back(fmt::format("map.{}={}", key, length));
  };
  add_length("width", options.width);
  add_length("depth", options.depth);
  if (options.channels) settings.push_back(fmt::format("map.channels={}", *options.channels));
  if (options.line_mass) settings.push_back(fmt::format("map.line_mass={}", *options.line_mass));
  if (!options.velocity_range.empty())
    settings.push_back("map.velocity_range=[" + options.velocity_range + "]");
  if (options.slice) settings.emplace_back("map.slice=true");
  if (options.noise) settings.emplace_back("map.noise=true");
  if (!options.types.empty()) {
    settings.push_back(
        fmt::format("component.{}.types={}", map_component(options), list_of_types(options.types)));
  }
  return settings;
}

// The component of the map; null where there is none, which draw_map refuses.
Component* find_component(Scene& scene) {
  for (Component& component : scene.components) {
    if (scene.map.component.empty() || component.name == scene.map.component) return &component;
  }
  return nullptr;
}

void add_selection(const std::vector<std::string>& conditions, Scene& scene) {
  Component* const component = find_component(scene);
  if (component == nullptr) return;
  component->select.where.insert(component->select.where.end(), conditions.begin(),
                                 conditions.end());
}

double length_of(const std::string& text, const char* option, const SceneWithSnapshot& source) {
  const std::string what = fmt::format("option {}", option);
  const double length = read_map_length(text, source.scene, *source.snapshot, what);
  if (length > 0) return length;
  throw UsageError(fmt::format("{}: found \"{}\", expected a length above 0", what, text));
}

Vec3 place_of(const std::string& text, const SceneWithSnapshot& source) {
  const std::string unit = unit_at_end(text);
  std::istringstream words(text);
  std::vector<double> place;
  for (std::string word; std::getline(words, word, ',');) {
    if (!has_unit(word)) word += " " + unit;
    place.push_back(read_map_length(word, source.scene, *source.snapshot, "option --center"));
  }
  if (place.size() == 3) return {{place[0], place[1], place[2]}};
  throw UsageError(fmt::format(
      "option --center: found \"{}\", expected three lengths, such as 25,25,25Mpc", text));
}

// What has a unit, in the snapshot's lengths; coordinates are told in the unit that was used.
void use_lengths(const MapOptions& options, SceneWithSnapshot& source) {
  MapSettings& map = source.scene.map;
  const bool has_place = options.center.find(',') != std::string::npos && has_unit(options.center);
  if (has_unit(options.width)) map.width = length_of(options.width, "--width", source);
  if (has_unit(options.depth)) map.depth = length_of(options.depth, "--depth", source);
  if (has_place) map.center = place_of(options.center, source);
  const std::string& used = has_unit(options.width) ? options.width
                            : has_place             ? options.center
                                                    : options.depth;
  if (map.axis_unit.empty()) map.axis_unit = unit_at_end(used);
}

// The component that was suggested for other types has their name, and another one perhaps the name
// of these: it stays alone, as the map's.
void name_by_types(const MapOptions& options, SceneWithSnapshot& source) {
  Scene& scene = source.scene;
  if (options.types.empty() || !source.suggested || !scene.map.component.empty()) return;
  std::vector<std::string> names;
  for (const int type : scene.components.front().types)
    names.push_back(particle_type_name(type));
  scene.components.resize(1);
  scene.components.front().name = fmt::format("{}", fmt::join(names, " and "));
}

DrawFrame drawing(const MapOptions& options, std::optional<Renderer>& renderer) {
  if (options.reference) {
    return [](const Frame& frame) { return reference::render(frame).to_float(); };
  }
  renderer.emplace(RendererOptions{options.device});
  return [&renderer](const Frame& frame) {
    const QuietErrors quiet;  // of compilers
    return renderer->render(frame);
  };
}

void write_outputs(const Map& map, const SceneWithSnapshot& source,
                   const std::vector<std::filesystem::path>& outputs, Console& console) {
  const std::map<std::string, std::string> metadata = {
      {"splotchcl:scene", format_scene(source.scene)}, {"splotchcl:version", SPLOTCHCL_VERSION}};
  std::vector<std::string> notes;
  for (const std::filesystem::path& output : outputs) {
    console.status("writing " + output.string());
    const std::vector<std::string> more =
        write_map(output, map, source.scene, source.snapshot->info(), metadata);
    notes.insert(notes.end(), more.begin(), more.end());
  }
  console.note_each_once(notes);
}

}  // namespace

int run_map(const MapOptions& options, Console& console) {
  for (const std::filesystem::path& output : options.outputs)
    check_map_path(output);
  SceneWithSnapshot source =
      open_scene(options.scene, settings_of_map(options), nullptr, Look::classic);
  // A map is of one component, whatever else there is.
  const std::string not_drawn = tell_not_drawn(source.scene, *source.snapshot);
  add_selection(options.select, source.scene);
  name_by_types(options, source);
  use_lengths(options, source);
  std::vector<OutputFile> outputs;
  for (const std::filesystem::path& output : options.outputs) {
    check_map_output(output, source.scene, source.snapshot->info());
    outputs.push_back({output, "--output"});
  }
  check_outputs(outputs, [&] { return files_read(options.scene, source.scene, *source.snapshot); });
  const WatchedFiles inputs = watched_files(source.scene, *source.snapshot);
  for (const std::string& note : source.notes) {
    if (note != not_drawn) console.note(note);
  }
  console.status("starting the device");
  std::optional<Renderer> renderer;
  const DrawFrame draw = drawing(options, renderer);

  const SnapshotInfo& info = source.snapshot->info();
  console.status("mapping " + info.files.front().filename().string());
  std::vector<std::string> notes = info.notes;
  const LoadProgress progress = [&console](const std::string& what, double fraction) {
    console.progress(what, fraction);
  };
  const Map map = inputs.unchanged_during(
      [&] { return draw_map(source.scene, *source.snapshot, draw, notes, progress); });
  inputs.check_in_place();
  for (const std::string& note : notes)
    console.note(note);
  write_outputs(map, source, options.outputs, console);
  console.done(fmt::format("{}: {} in {}, {}x{} pixels, {} particles",
                           options.outputs.front().string(), map.quantity, map.unit, map.width,
                           map.height, map.particles));
  return 0;
}

}  // namespace splotchcl::cli
