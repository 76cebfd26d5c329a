#include "splotchcl/map.h"

#include <fmt/format.h>

#include <map>
#include <sstream>

#include "cli/command_builder.h"
#include "cli/commands.h"
#include "cli/scene_options.h"
#include "common/output_files.h"
#include "common/quiet_errors.h"
#include "map/named_place.h"
#include "map/shape.h"
#include "open_scene/input_files.h"
#include "select/selection.h"
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

void add_sphere_options(CLI::App& sub, MapOptions& options) {
  sub.add_option("--healpix", options.healpix,
                 wrapped("A Healpix map of the sphere around --center, with this NSIDE"))
      ->type_name("NSIDE");
  sub.add_option("--order", options.order, wrapped("Of its pixels: ring (the default) or nested"))
      ->type_name("NAME");
  sub.add_option("--shell", options.shell,
                 wrapped("Between these distances from the centre: 10,20Mpc. Of a profile the "
                         "innermost and outermost radius"))
      ->type_name("RMIN,RMAX");
  sub.add_flag("--tile", options.tile,
               wrapped("Fill the shell with periodic images of the box; default: each particle "
                       "once, where it is nearest"));
}

void add_cell_options(CLI::App& sub, MapOptions& options) {
  sub.add_option("--voxels", options.voxels,
                 wrapped("A cube of voxels, --width along x: .fits, .hdf5 or .npy"))
      ->type_name("N|NX,NY,NZ");
  sub.add_option("--profile", options.profile,
                 wrapped("A radial profile around --center in so many shells; also as .csv and "
                         ".ecsv"))
      ->type_name("N");
  sub.add_option("--histogram", options.histogram,
                 wrapped("A histogram of two fields, such as density,temperature"))
      ->type_name("FIELD,FIELD");
  sub.add_option("--bins", options.bins, wrapped("Of the histogram; default: 256"))
      ->type_name("N|X,Y");
  sub.add_option("--x-range", options.x_range, wrapped("Of its first field; default: all values"))
      ->type_name("V,V");
  sub.add_option("--y-range", options.y_range, wrapped("Of its second field, likewise"))
      ->type_name("V,V");
}

void add_view_options(CLI::App& sub, MapOptions& options) {
  sub.add_option(
         "--view", options.view,
         wrapped(
             "xy (the default), xz or yz: the axes to the right and up; camera: the scene's view; "
             "sky: all around, from --center, --width in degrees"))
      ->type_name("NAME");
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
  add_sphere_options(*sub, *options);
  add_cell_options(*sub, *options);
  add_view_options(*sub, *options);
  sub->add_option("--tolerance", options->tolerance,
                  wrapped("Largest error of each sum, relative to it, or to map.floor if it is "
                          "below that; 0: 1e-6. Default: the scene's, or 0.001"))
      ->type_name("X");
  add_scene_options(*sub, *options);
  sub->footer(
      "Examples:\n"
      "  splotchcl map snapshot_006 -o density.png\n"
      "  splotchcl map snapshot_006 --quantity temperature --view xy --unit K -o t.fits -o t.png\n"
      "  splotchcl map snapshot_006 --quantity temperature --slice --center densest -o slice.npy\n"
      "  splotchcl map snapshot_006 --healpix 256 --shell 5000,20000 -o sky.fits\n"
      "  splotchcl map snapshot_006 --voxels 128 -o cube.h5\n"
      "  splotchcl map snapshot_006 --histogram density,temperature -o phases.png");
}

namespace {

std::string map_component(const MapOptions& options) {
  const std::string key = "map.component=";
  for (const std::string& setting : options.settings) {
    if (setting.rfind(key, 0) == 0) return setting.substr(key.size());
  }
  return "0";
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

// halo=5, which stands for a place as words do.
bool is_named(const std::string& center) {
  return center.find(',') == std::string::npos;
}

// A length or a place with a unit, which the snapshot has to be known for.
bool has_unit(const std::string& lengths) {
  return !unit_of_lengths(lengths).empty();
}

// Lengths with a unit are texts.
void add_lengths(const char* key, const std::string& lengths, const char* before, const char* after,
                 std::vector<std::string>& settings) {
  if (lengths.empty()) return;
  settings.push_back(has_unit(lengths) ? fmt::format("map.{}='{}'", key, lengths)
                                       : fmt::format("map.{}={}{}{}", key, before, lengths, after));
}

void add_place(const MapOptions& options, std::vector<std::string>& settings) {
  if (options.center.find_first_of(",=") == std::string::npos) {
    if (!options.center.empty())
      settings.push_back(fmt::format("map.center_at='{}'", options.center));
  } else if (!is_named(options.center)) {
    add_lengths("center", options.center, "[", "]", settings);
  }
  add_lengths("width", options.width, "", "", settings);
  add_lengths("depth", options.depth, "", "", settings);
  add_lengths("shell", options.shell, "[", "]", settings);
}

// "density,temperature" as TOML; of formulas with commas the scene's key takes a list.
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

// In a scene 0 says that there is no such shape; who types it asks for one.
void refuse_none(const char* option, const std::string& count) {
  if (count.empty() || count.find_first_not_of("0, ") != std::string::npos) return;
  throw UsageError(fmt::format("{}: found {}, expected at least 1", option, count));
}

std::string text_of(const std::optional<int>& count) {
  return count ? std::to_string(*count) : "";
}

void check_counts(const MapOptions& options) {
  refuse_none("--channels", text_of(options.channels));
  refuse_none("--healpix", text_of(options.healpix));
  refuse_none("--profile", text_of(options.profile));
  refuse_none("--voxels", options.voxels);
}

void add_shape(const MapOptions& options, std::vector<std::string>& settings) {
  check_counts(options);
  const auto add = [&settings](const char* key, const std::string& value) {
    if (!value.empty()) settings.push_back(fmt::format("map.{}={}", key, value));
  };
  const auto add_range = [&add](const char* key, const std::string& range) {
    if (!range.empty()) add(key, "[" + range + "]");
  };
  if (options.channels) add("channels", std::to_string(*options.channels));
  if (options.line_mass) add("line_mass", fmt::format("{}", *options.line_mass));
  add_range("velocity_range", options.velocity_range);
  if (options.healpix) add("healpix", std::to_string(*options.healpix));
  if (!options.order.empty()) add("healpix_order", "'" + options.order + "'");
  if (options.tile) add("tile", "true");
  add("voxels", one_or_list(options.voxels));
  if (options.profile) add("profile", std::to_string(*options.profile));
  if (!options.histogram.empty()) add("histogram", list_of_words(options.histogram));
  add("bins", one_or_list(options.bins));
  add_range("x_range", options.x_range);
  add_range("y_range", options.y_range);
}

// The options as settings of the scene, after those that the user gives.
std::vector<std::string> settings_of_map(const MapOptions& options) {
  std::vector<std::string> settings = common_settings_of(options);
  const auto add = [&settings](const char* key, const std::string& value) {
    if (!value.empty()) settings.push_back(fmt::format("map.{}='{}'", key, value));
  };
  add("quantity", options.quantity.empty() ? options.field : options.quantity);
  add("palette", options.palette);
  add("statistic", options.statistic);
  add("weight", options.weight);
  add("view", options.view);
  add("unit", options.unit);
  add_place(options, settings);
  add_shape(options, settings);
  add("distance", options.distance);
  if (!options.sky.empty()) settings.push_back("map.sky=[" + options.sky + "]");
  if (!options.contours.empty()) settings.push_back(contour_setting(options.contours));
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
  for (const std::string& condition : conditions)
    parse_condition(condition, "option --where");
  component->select.where.insert(component->select.where.end(), conditions.begin(),
                                 conditions.end());
}

// The map's own words are its settings.
void find_halo(const MapOptions& options, SceneWithSnapshot& source) {
  const bool is_halo = is_named(options.center) && options.center.find('=') != std::string::npos;
  if (!is_halo) return;
  source.scene.map.center = find_named_place(options.center, source.scene, *source.snapshot,
                                             "option --center", source.notes);
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

// Sums in cells need no device.
DrawFrame drawing(const MapOptions& options, const Scene& scene, Console& console,
                  std::optional<Renderer>& renderer) {
  if (is_made_of_cells(shape_of(scene.map))) return {};
  console.status("starting the device");
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

std::string size_of(const Map& map) {
  switch (map.shape) {
    case MapShape::healpix:
      return fmt::format("{} pixels", map.width);
    case MapShape::voxels:
      return fmt::format("{}x{}x{} voxels", map.width, map.height, map.planes());
    case MapShape::profile:
      return fmt::format("{} shells", map.width);
    case MapShape::histogram:
      return fmt::format("{}x{} bins", map.width, map.height);
    case MapShape::plane:
    case MapShape::velocities:
    case MapShape::sky:
      break;
  }
  return fmt::format("{}x{} pixels", map.width, map.height);
}

}  // namespace

int run_map(const MapOptions& options, Console& console) {
  if (!options.quantity.empty() && !options.field.empty()) {
    throw UsageError("map: found --quantity and --field, expected one of them: they say the same");
  }
  for (const std::filesystem::path& output : options.outputs)
    check_map_path(output);
  SceneWithSnapshot source =
      open_scene(options.scene, settings_of_map(options), nullptr, Look::classic);
  // A map is of one component, whatever else there is.
  const std::string not_drawn = tell_not_drawn(source.scene, *source.snapshot);
  add_selection(options.where, source.scene);
  name_by_types(options, source);
  find_halo(options, source);
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
  std::optional<Renderer> renderer;
  const DrawFrame draw = drawing(options, source.scene, console, renderer);

  const SnapshotInfo& info = source.snapshot->info();
  console.status("mapping " + info.files.front().filename().string());
  std::vector<std::string> notes = info.notes;
  const LoadProgress progress = [&console](const std::string& what, double fraction) {
    console.progress(what, fraction);
  };
  const Map map = inputs.unchanged_during(
      [&] { return draw_map(source.scene, *source.snapshot, draw, notes, progress); });
  inputs.check_in_place();
  console.note_each_once(notes);
  write_outputs(map, source, options.outputs, console);
  console.done(fmt::format("{}: {} in {}, {}, {} particles", options.outputs.front().string(),
                           map.quantity, map.unit, size_of(map), map.particles));
  return 0;
}

}  // namespace splotchcl::cli
