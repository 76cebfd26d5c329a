#pragma once

#include <string>
#include <vector>

#include "cli/commands.h"

namespace CLI {
class App;
}

// Options that stand for keys of a scene.
namespace splotchcl::cli {

// What render, movie and map take alike: which particles are shown, how they are read, and with
// what.
void add_scene_options(CLI::App& sub, DrawOptions& options);
// The same without --reference, for what must be quick.
void add_live_options(CLI::App& sub, DrawOptions& options);

// How the text of an option is written as a key's value.
enum class MapText {
  word,
  count,   // at least 1; in a scene 0 says that there is no such shape
  counts,  // one for all, or one for each, N,N,N
  number,
  numbers,         // N,N
  words,           // NAME,NAME; of formulas with commas the scene's key takes a list
  length,          // may have a unit
  lengths,         // N,N, likewise
  number_or_list,  // contours: how many, or at which values
  flag,            // there is no text
};

// An option of splotchcl map that stands for one key of the scene's [map].
struct MapOption {
  std::string name, key;  // without "--" and "map."
  MapText text;
  std::string type, help;
};

// Those for what is shown, for cubes, spheres and other cells, and for the view.
const std::vector<MapOption>& map_options();

void add_map_options(CLI::App& sub, MapOptions& options);

// Of what was typed. Throws UsageError for shapes of no cells.
std::vector<std::string> settings_of_map_options(const MapOptions& options);
// Of a length or lengths that may have a unit: such are texts.
std::string setting_of_lengths(const std::string& key, const std::string& lengths, bool is_list);

}  // namespace splotchcl::cli
