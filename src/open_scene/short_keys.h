#pragma once

#include <string>
#include <vector>

#include "splotchcl/open_scene.h"

namespace splotchcl {

// Words of settings that stand for keys of all components, or for what only a snapshot tells: what
// the command line's --types, --where, --field, --palette, --center and --width say.
struct ShortKeys {
  std::vector<int> types;          // none: those of the scene
  std::vector<std::string> where;  // conditions that all components are to fulfil
  std::string field, palette;      // of all components
  std::string center, width;       // of the camera
};

// Takes the short keys out of the settings. Throws UsageError for types and conditions that are
// none.
ShortKeys take_short_keys(std::vector<std::string>& settings);

// Leaves those of the components that draw one of the types, for others it is suggested anew.
// Throws UsageError for types of which the snapshot has no particles. The camera frames them in a
// picture of the shape of `image`.
void choose_types(const ShortKeys& keys, const Snapshot& snapshot, Look look,
                  const ImageSettings& image, Scene& suggested);
// One that frames what the scene draws in a picture of that shape.
Camera camera_for(const ImageSettings& image, Scene scene, const Snapshot& snapshot);
// Of a scene whose components are given: only what of them draws the types.
void keep_types(const ShortKeys& keys, Scene& scene);

// The field and the palette; `settings` that say more of colors count before them.
void apply_colors(const ShortKeys& keys, const std::vector<std::string>& settings,
                  SceneWithSnapshot& opened);

// Conditions, and where the camera looks.
void apply(const ShortKeys& keys, SceneWithSnapshot& opened);

}  // namespace splotchcl
