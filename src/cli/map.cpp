#include "splotchcl/map.h"

#include <fmt/format.h>

#include <map>
#include <sstream>

#include "cli/command_builder.h"
#include "cli/commands.h"
#include "cli/draw_options.h"
#include "cli/scene_options.h"
#include "common/guards.h"
#include "common/output_files.h"
#include "formula/selection.h"
#include "map/place.h"
#include "map/shape.h"
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
  add_map_options(*sub, *options);
  add_number(*sub, "--tolerance", options->tolerance, "X",
             "Largest error of each sum, relative to it, or to map.floor if it is below that; 0: "
             "1e-6. Default: the scene's, or 0.001");
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

// halo=5, which stands for a place as words do.
bool is_named(const std::string& center) {
  return center.find(',') == std::string::npos;
}

void add_place(const MapOptions& options, std::vector<std::string>& settings) {
  if (options.center.find_first_of(",=") == std::string::npos) {
    if (!options.center.empty())
      settings.push_back(fmt::format("map.center_at='{}'", options.center));
  } else if (!is_named(options.center)) {
    settings.push_back(setting_of_lengths("center", options.center, true));
  }
  if (!options.width.empty()) settings.push_back(setting_of_lengths("width", options.width, false));
}

// The options as settings of the scene, after those that the user gives.
std::vector<std::string> settings_of_map(const MapOptions& options) {
  std::vector<std::string> settings = common_settings_of(options);
  const auto add = [&settings](const char* key, const std::string& value) {
    if (!value.empty()) settings.push_back(fmt::format("map.{}='{}'", key, value));
  };
  add("quantity", options.field);
  add("palette", options.palette);
  add_place(options, settings);
  const std::vector<std::string> more = settings_of_map_options(options);
  settings.insert(settings.end(), more.begin(), more.end());
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
  refuse_beside_reference(options, {});
  if (!options.text_of("quantity").empty() && !options.field.empty()) {
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
