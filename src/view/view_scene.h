#pragma once

#include <array>
#include <filesystem>
#include <map>
#include <optional>
#include <set>
#include <string>
#include <vector>

#include "film/path/film_path.h"
#include "splotchcl/frame_drawer.h"
#include "splotchcl/scene.h"
#include "splotchcl/snapshot.h"
#include "view/requests/page_messages.h"

// What a page's state makes of the scene that was opened.
namespace splotchcl::view {

// Behind its own components. Each has another name.
Scene with_components(Scene scene, const std::vector<Component>& added);

// With all components; limits that the state leaves open are unset, and so is what it leaves to its
// default. `suggested` is the scene as
// which the opened one began, null where it began otherwise: what was suggested and suits no more
// gives way, as it does to settings of the command line. Throws UsageError for values
// that no scene can have, palettes that are neither the program's nor the scene's own, and
// pictures of more than 8192 x 8192 pixels.
Scene scene_of(const Scene& opened, const Scene* suggested, const PageState& state);

// Values of the opened scene that the state does not set and that gave way to what it sets, as the
// scene of this state has them instead.
struct GivenWay {
  std::optional<double> field_of_view_degrees;
  std::optional<std::array<int, 2>> size;
};
GivenWay given_way(const Scene& opened, const PageState& state, const Scene& scene);

// Without the components that are off, which its keyframes leave alone, too. Throws UsageError
// where all are.
Scene without_hidden(Scene scene, const std::set<std::size_t>& hidden);

// The frames of its film.
FilmPath film_of(const Scene& scene);
// As it is at a frame of its film. Throws UsageError where it has no such frame.
Scene at_frame(const FilmPath& film, const Scene& scene, int frame);

// The keys of numbers that the scene leaves to the data or to the picture. It has all components.
std::set<std::string> open_keys(const Scene& scene);
// The numbers that the scene has for such keys by now, for the page to show.
std::map<std::string, double> numbers_of(const Scene& scene, const std::set<std::string>& keys);

// Which component a key of a scene is of, by its number or its name: "component.gas.palette".
// Nothing for other keys and components that are not there.
std::optional<std::size_t> component_of_key(const Scene& scene, const std::string& key);

// What a page has saved, on the machine on which the program runs. A relative path begins at the
// program's current folder.

// The text of a scene file that means the same in every folder.
std::string portable_scene_text(const Scene& scene);

// What may not be replaced: all that these name, whether it is shown or not.
struct ViewInputs {
  const Scene& opened;
  const Scene& all;  // as the page has it, with components that are off
  const Snapshot& snapshot;
};

// Written under a temporary name and renamed when complete.
enum class SaveResult {
  saved,
  exists,  // nothing was written: the file is there, and may not be replaced
};

// Throws UsageError for a path that does not end in .toml or that is a file of the inputs,
// DataError for one that cannot be written.
SaveResult save_scene(const std::filesystem::path& path, bool may_replace, const Scene& scene,
                      const ViewInputs& inputs);

// Whether the picture may be written there, before it is drawn. Throws as check_image_path does,
// and UsageError as above.
SaveResult check_picture(const std::filesystem::path& path, bool may_replace, const Scene& scene,
                         const ViewInputs& inputs);

// The same of a film and of the scene beside it.
SaveResult check_film_file(const std::filesystem::path& path, bool may_replace,
                           const ViewInputs& inputs);

}  // namespace splotchcl::view
