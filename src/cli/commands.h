#pragma once

#include <cstdint>
#include <filesystem>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include "cli/console.h"
#include "splotchcl/galaxy.h"
#include "splotchcl/generate.h"
#include "splotchcl/renderer.h"
#include "splotchcl/tree_use.h"

// What a user asks of each command, and what carries it out. A command's answer goes to
// standard output, everything else through the console. The result is the exit code.
namespace splotchcl::cli {

// What render, movie, map and view have in common.
struct DrawOptions {
  std::filesystem::path scene;  // a scene file or a snapshot
  std::string device;
  std::vector<std::string> settings;  // key=value
  std::optional<std::string> size;    // WIDTHxHEIGHT
  std::optional<std::string> look;
  std::string types, field, palette, center, width, units;  // empty: not given
  std::vector<std::string> where;                           // conditions
  std::optional<double> tolerance;
  std::optional<int> every, max_particles;
  bool cache_smoothing_lengths = false;
  bool reference = false;
  TreeUse tree = TreeUse::automatic;
  bool explain = false;
  bool display = false;            // files of floats hold what a display shows
  std::uint64_t memory_bytes = 0;  // 0: as much as the device has room for
  std::optional<std::filesystem::path> stats;
};
// All that is set, as key=value, of pictures.
std::vector<std::string> settings_of(const DrawOptions& options);
// What pictures and maps have in common of it.
std::vector<std::string> common_settings_of(const DrawOptions& options);

struct RenderOptions : DrawOptions {
  std::optional<std::filesystem::path> output;
  std::string crop;  // X,Y,W,H
  bool certify = false;
  std::optional<std::filesystem::path> error_map;  // an image
  CompositeShape shape = CompositeShape::automatic;
};
int run_render(const RenderOptions& options, Console& console);

struct PublishOptions : DrawOptions {
  std::filesystem::path output;  // a page, or a folder for it
  std::optional<std::string> title;
  std::optional<std::size_t> splats;  // at most; unset: as the output's kind suits
};
int run_publish(const PublishOptions& options, Console& console);

struct ViewOptions : DrawOptions {
  std::string address = "127.0.0.1";
  std::uint16_t port = 0;  // 0: one that is free
  std::string framed_in;   // the origin of another page that may show it
};
int run_view(const ViewOptions& options, Console& console);

struct MapOptions : DrawOptions {
  std::vector<std::filesystem::path> outputs;
  // Of the options that stand for keys of [map], by key (scene_options.h); empty: not given.
  std::map<std::string, std::string> texts;
  std::map<std::string, bool> flags;

  std::string text_of(const std::string& key) const {
    const auto found = texts.find(key);
    return found == texts.end() ? "" : found->second;
  }
};
int run_map(const MapOptions& options, Console& console);

struct ConvertOptions {
  std::filesystem::path par;
  std::filesystem::path output;  // a scene file
  std::vector<std::string> settings;
};
int run_convert(const ConvertOptions& options, Console& console);

struct MovieOptions : DrawOptions {
  std::optional<std::filesystem::path> output;  // a film, or numbered images
  std::string frames;                           // FIRST:END:STEP
  std::string part;                             // K/N
  std::string dive, follow;                     // densest, or halo=N
  std::optional<std::string> audio;
  std::optional<int> dome;  // its diameter in pixels
  bool test_frame = false;  // of the dome, in place of the film
  bool join = false;
  std::optional<std::filesystem::path> timeline;
};
int run_movie(const MovieOptions& options, Console& console);

struct PathOptions {
  std::filesystem::path scene;
  std::filesystem::path output;
  std::vector<std::string> settings;  // key=value
};
int run_path(const PathOptions& options, Console& console);

// What info and fields have in common.
struct SnapshotQuestion {
  std::filesystem::path snapshot;
  std::vector<std::string> columns;  // of a table
  int skip_lines = 0;                // of a text table
  bool json = false;
};

struct InfoOptions : SnapshotQuestion {
  bool header = false;  // only what is known without reading particles
};
int run_info(const InfoOptions& options, Console& console);

int run_fields(const SnapshotQuestion& options, Console& console);

struct IndexOptions {
  std::filesystem::path snapshot;
};
int run_index(const IndexOptions& options, Console& console);

struct TreeCommandOptions {
  std::filesystem::path snapshot;
  std::vector<int> types;                      // none: all
  std::optional<std::filesystem::path> scene;  // whose colors nodes have; none: a first picture's
  std::vector<std::string> fields;             // none: those that this scene uses
  unsigned least = 4;
  bool with_particles = false;
};
int run_tree(const TreeCommandOptions& options, Console& console);

struct PalettesOptions {
  std::vector<std::string> names;  // or files; none: all
  std::optional<std::filesystem::path> preview;
  bool json = false;
};
int run_palettes(const PalettesOptions& options, Console& console);

struct CompareOptions {
  std::filesystem::path image, reference;
  std::optional<double> limit;
  std::optional<std::filesystem::path> difference;  // a picture of it
  bool json = false;
};
int run_compare(const CompareOptions& options, Console& console);

struct DevicesOptions {
  bool json = false;
};
int run_devices(const DevicesOptions& options);

struct GenerateOptions {
  std::string what;  // universe, cluster or halo
  std::filesystem::path output;
  GenerateSettings settings;
};
int run_generate(const GenerateOptions& options, Console& console);

struct GalaxyOptions {
  std::filesystem::path image, output;
  std::optional<std::filesystem::path> scene;
  GalaxySettings settings;  // but for the rotation, which follows from what is below
  std::optional<double> gamma;
  double speed = 200, core = 1;  // km/s and kpc
  std::optional<std::filesystem::path> rotation_curve;
};
int run_galaxy(const GalaxyOptions& options, Console& console);

struct EvolveOptions {
  std::filesystem::path galaxy;
  std::optional<std::filesystem::path> scene, output, snapshots;  // numbered: %04d
  std::optional<double> duration_myr;                             // unset: as long as the arms hold
  int frames = 100;
  bool first_order = false;
  std::optional<double> step_myr;       // unset: from frame to frame
  std::optional<double> speed, core;    // km/s and kpc; unset: the galaxy's own velocities
  std::optional<double> pattern_speed;  // km/s/kpc
  std::optional<std::filesystem::path> rotation_curve;
  std::string part;  // K/N
  std::string device;
  std::vector<std::string> settings;  // key=value
};
int run_evolve(const EvolveOptions& options, Console& console);

// What --version says, in lines: the version and the commit, OpenCL's loader, the libraries that
// the program was built with.
std::string version_text();
// The version and the commit alone.
std::string version_and_commit();

// Carries out what the arguments ask for. The result is the exit code. Throws UsageError
// for arguments that cannot be understood.
int run_command_line(int argc, char** argv, Console& console);

}  // namespace splotchcl::cli
