#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <set>
#include <string>
#include <string_view>
#include <variant>
#include <vector>

#include "splotchcl/path.h"

// What a page says (docs/view.md, "What page and program say"). Each message is complete in
// itself, so that those that were overtaken can be left out.
namespace splotchcl::view {

// A value of a scene's key, as TOML: `camera.position` and `[1, 2, 3]`.
struct PageSetting {
  std::string key, value;
};

// All that the page shows: how its scene differs from the one that was opened.
struct PageState {
  std::uint64_t number = 0;  // the page's own, for its answers
  bool is_moving = false;    // more will follow at once
  std::vector<PageSetting> settings;
  std::set<std::string> open;      // keys that are left to the data, or to their default
  std::vector<std::string> added;  // particle types with components beside the opened scene's
  std::set<std::size_t> hidden;    // components that are off
  std::optional<std::vector<Keyframe>> keyframes;  // instead of the scene's own
  std::optional<int> frame;  // of the film that these make, instead of the scene as it stands
  std::string scene;         // the same for states of which only the frame and what is above differ
};

struct FrameAcknowledged {
  std::uint64_t frame = 0;
};

// How the color field's values of a component are distributed.
struct HistogramQuestion {
  std::size_t component = 0;
};
// What lies at a place of the picture, 0 to 1 from its upper left corner.
struct PickQuestion {
  double x = 0, y = 0;
};
// Where the scene's particles are, by some of them.
struct PlacesQuestion {};
// A component for a particle type, as it would be added.
struct ComponentQuestion {
  std::string type;
};
// What a look would set.
struct LookQuestion {
  std::string look;
};
// The scene as text, and that which was opened.
struct SceneTextQuestion {};
struct SaveScene {
  std::string path;
  bool may_replace = false;
};
struct SavePicture {
  std::string path;
  bool may_replace = false;
};

// The scene is saved beside the film, and the film drawn from it while the page goes on.
struct MakeFilm {
  std::string path;
  bool may_replace = false;
};

// What is answered once, by the page's number for it.
struct PageQuestion {
  std::uint64_t id = 0;
  std::variant<HistogramQuestion, PickQuestion, PlacesQuestion, ComponentQuestion, LookQuestion,
               SceneTextQuestion, SaveScene, SavePicture, MakeFilm>
      what;
};

// The film that is being drawn is not wanted any more.
struct CancelFilm {};

using PageMessage = std::variant<PageState, FrameAcknowledged, CancelFilm, PageQuestion>;

// All keys that a page may set in a scene of so many components.
std::vector<std::string> settable_keys(std::size_t components);
bool is_settable(std::string_view key);

// No message is longer.
constexpr std::size_t longest_message_bytes = 256 * 1024;

// Throws UsageError for what is no message: not JSON, a key that a page may not set, a value of
// another kind than the key's, anything missing or too much.
PageMessage parse_page_message(std::string_view text);

}  // namespace splotchcl::view
