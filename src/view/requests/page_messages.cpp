#include "view/requests/page_messages.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <nlohmann/json.hpp>
#include <optional>
#include <utility>

#include "splotchcl/error.h"

namespace splotchcl::view {
namespace {

using Json = nlohmann::json;

constexpr std::size_t most_settings = 1000;
constexpr std::size_t most_added = 32;
constexpr std::uint64_t last_frame = 100000;
constexpr std::size_t longest_word = 1000;
constexpr std::size_t longest_quotation = 200;
constexpr std::size_t longest_path = 4096;

enum class Kind { number, numbers, word, text, word_or_number, flag };

struct PageKey {
  std::string_view key;
  Kind kind;
};

// What a page may set. Names of files are not among them, so that no page makes the program read
// another file than its user has opened.
constexpr std::array page_keys = {
    PageKey{"camera.position", Kind::numbers},
    PageKey{"camera.look_at", Kind::numbers},
    PageKey{"camera.sky", Kind::numbers},
    PageKey{"camera.field_of_view", Kind::number},
    PageKey{"camera.projection", Kind::word},
    PageKey{"stereo.layout", Kind::word},
    PageKey{"stereo.angle", Kind::number},
    PageKey{"image.size", Kind::numbers},
    PageKey{"image.gamma", Kind::number},
    PageKey{"image.background", Kind::numbers},
    PageKey{"kernel.footprint", Kind::number},
    PageKey{"tolerance", Kind::number},
    PageKey{"time.index", Kind::number},
    PageKey{"movie.frames_per_second", Kind::number},
    PageKey{"finish.exposure", Kind::word_or_number},
    PageKey{"finish.white", Kind::word_or_number},
    PageKey{"finish.tone", Kind::word},
    PageKey{"finish.saturation", Kind::number},
    PageKey{"finish.contrast", Kind::number},
    PageKey{"finish.bloom", Kind::number},
    PageKey{"finish.white_balance", Kind::number},
    PageKey{"finish.highlights", Kind::number},
    PageKey{"finish.fade", Kind::number},
    PageKey{"finish.title.text", Kind::text},
    PageKey{"finish.caption.text", Kind::text},
    PageKey{"finish.color_bar.show", Kind::flag},
    PageKey{"finish.scale_bar.show", Kind::flag},
};
constexpr std::array component_keys = {
    PageKey{"palette", Kind::word},
    PageKey{"brightness", Kind::number},
    PageKey{"size.factor", Kind::number},
    PageKey{"absorption", Kind::word_or_number},
    PageKey{"weight", Kind::word},
    PageKey{"color.field", Kind::word},
    PageKey{"color.scaling", Kind::word},
    PageKey{"color.min", Kind::number},
    PageKey{"color.max", Kind::number},
    PageKey{"intensity.field", Kind::word},
    PageKey{"intensity.scaling", Kind::word},
    PageKey{"intensity.min", Kind::number},
    PageKey{"intensity.max", Kind::number},
    PageKey{"select.where", Kind::word},
    PageKey{"select.sphere.center", Kind::numbers},
    PageKey{"select.sphere.radius", Kind::number},
    PageKey{"select.box.min", Kind::numbers},
    PageKey{"select.box.max", Kind::numbers},
};

[[noreturn]] void refuse(const std::string& what) {
  throw UsageError("message of the page: " + what);
}

template <std::size_t n>
std::optional<Kind> find_kind(const std::array<PageKey, n>& keys, std::string_view key) {
  const auto found =
      std::find_if(keys.begin(), keys.end(), [&](const PageKey& k) { return k.key == key; });
  if (found == keys.end()) return std::nullopt;
  return found->kind;
}

// "component.12.palette" -> "palette"
std::optional<std::string_view> key_of_component(std::string_view key) {
  constexpr std::string_view start = "component.";
  if (key.substr(0, start.size()) != start) return std::nullopt;
  key.remove_prefix(start.size());
  const std::size_t dot = key.find('.');
  const std::string_view number = key.substr(0, dot);
  const bool is_number =
      !number.empty() && number.size() <= 4 &&
      std::all_of(number.begin(), number.end(), [](char c) { return c >= '0' && c <= '9'; });
  if (dot == std::string_view::npos || !is_number) return std::nullopt;
  return key.substr(dot + 1);
}

std::optional<Kind> find_kind(std::string_view key) {
  if (const auto own = key_of_component(key)) return find_kind(component_keys, *own);
  return find_kind(page_keys, key);
}

Kind kind_of(const std::string& key) {
  const std::optional<Kind> kind = find_kind(key);
  if (!kind) refuse("key '" + key.substr(0, longest_quotation) + "' is none that a page may set");
  return *kind;
}

// Words that need no escapes in TOML: names of fields, palettes and choices.
std::string quoted_word(const std::string& key, const Json& value) {
  const auto& word = value.get_ref<const std::string&>();
  const bool is_plain = std::all_of(word.begin(), word.end(), [](unsigned char c) {
    return c >= ' ' && c != '"' && c != '\\' && c != 127;
  });
  if (word.empty() || word.size() > longest_word || !is_plain) {
    refuse(key + " is no word of 1 to 1000 plain characters");
  }
  return '"' + word + '"';
}

// What people read: any characters but those that are not shown.
std::string quoted_text(const std::string& key, const Json& value) {
  const auto& text = value.get_ref<const std::string&>();
  std::string quoted;
  for (const char c : text) {
    if (static_cast<unsigned char>(c) < ' ' || c == 127) refuse(key + " has a control character");
    if (c == '"' || c == '\\') quoted += '\\';
    quoted += c;
  }
  if (text.empty() || text.size() > longest_word) refuse(key + " has not from 1 to 1000 bytes");
  return '"' + quoted + '"';
}

std::string number_text(const std::string& key, const Json& value) {
  const auto number = value.get<double>();
  if (!std::isfinite(number)) refuse(key + " is not finite");
  // TOML tells whole numbers from others, and some keys take only these.
  if (std::rint(number) == number && std::abs(number) < 1e15) return fmt::format("{:.0f}", number);
  return fmt::format("{}", number);
}

std::string numbers_text(const std::string& key, const Json& value) {
  if (value.size() < 2 || value.size() > 3) refuse(key + " has neither two numbers nor three");
  std::string text;
  for (const Json& number : value) {
    if (!number.is_number()) refuse(key + " has something that is no number");
    text += (text.empty() ? "[" : ", ") + number_text(key, number);
  }
  return text + "]";
}

std::string toml_text(const std::string& key, const Json& value) {
  const Kind kind = kind_of(key);
  const bool takes_number = kind == Kind::number || kind == Kind::word_or_number;
  const bool takes_word = kind == Kind::word || kind == Kind::word_or_number;
  if (takes_number && value.is_number()) return number_text(key, value);
  if (takes_word && value.is_string()) return quoted_word(key, value);
  if (kind == Kind::text && value.is_string()) return quoted_text(key, value);
  if (kind == Kind::numbers && value.is_array()) return numbers_text(key, value);
  if (kind == Kind::flag && value.is_boolean()) return value.get<bool>() ? "true" : "false";
  refuse(fmt::format("{} has {}, which is not its kind of value", key, value.type_name()));
}

const Json& member(const Json& json, const char* name) {
  const auto found = json.find(name);
  if (found == json.end()) refuse(std::string("there is no ") + name);
  return *found;
}

std::uint64_t number_of(const Json& json, const char* name) {
  const Json& value = member(json, name);
  if (!value.is_number_unsigned()) refuse(std::string(name) + " is no whole number from 0");
  return value.get<std::uint64_t>();
}

bool flag_of(const Json& json, const char* name) {
  const Json& value = member(json, name);
  if (!value.is_boolean()) refuse(std::string(name) + " is neither true nor false");
  return value.get<bool>();
}

// 0 to 1.
double share_of(const Json& json, const char* name) {
  const Json& value = member(json, name);
  const double share = value.is_number() ? value.get<double>() : -1;
  if (!(share >= 0 && share <= 1)) refuse(std::string(name) + " is no number from 0 to 1");
  return share;
}

std::string path_of(const Json& json) {
  const Json& value = member(json, "path");
  if (!value.is_string()) refuse("path is no text");
  const auto& path = value.get_ref<const std::string&>();
  if (path.empty() || path.size() > longest_path || path.find('\0') != std::string::npos) {
    refuse("path is empty, too long or no path");
  }
  return path;
}

Keyframe parse_keyframe(const Json& json) {
  if (!json.is_object()) refuse("a keyframe is no object");
  Keyframe keyframe;
  const Json& frame = member(json, "frame");
  keyframe.frame = frame.is_number() ? frame.get<double>() : -1;
  if (!(keyframe.frame >= 0 && keyframe.frame <= last_frame)) {
    refuse("the frame of a keyframe is no number from 0 to 100000");
  }
  const Json& settings = member(json, "settings");
  if (!settings.is_object() || settings.empty()) refuse("a keyframe has no settings");
  for (const auto& [key, value] : settings.items())
    keyframe.values[key] = toml_text(key, value);
  if (json.find("ease") != json.end()) keyframe.is_eased = flag_of(json, "ease");
  if (const auto dwell = json.find("dwell"); dwell != json.end()) {
    keyframe.dwell = dwell->is_number() ? dwell->get<double>() : -1;
    if (!(keyframe.dwell >= 0 && keyframe.dwell <= last_frame)) {
      refuse("the dwell of a keyframe is no number from 0 to 100000");
    }
  }
  return keyframe;
}

// A name of particles, or of a look.
std::string word_of(const Json& json) {
  if (!json.is_string()) refuse("a name is no text");
  const auto& word = json.get_ref<const std::string&>();
  if (word.empty() || word.size() > longest_quotation) refuse("a name is no word");
  return word;
}

void parse_added(const Json& json, PageState& state) {
  const auto added = json.find("added");
  if (added == json.end()) return;
  if (!added->is_array() || added->size() > most_added) refuse("added is no list of at most 32");
  for (const Json& type : *added)
    state.added.push_back(word_of(type));
}

void parse_film(const Json& json, PageState& state) {
  if (const auto keyframes = json.find("keyframes"); keyframes != json.end()) {
    if (!keyframes->is_array() || keyframes->size() > most_settings) {
      refuse("keyframes are no list of at most 1000");
    }
    state.keyframes.emplace();
    for (const Json& keyframe : *keyframes)
      state.keyframes->push_back(parse_keyframe(keyframe));
  }
  if (json.find("frame") == json.end()) return;
  const std::uint64_t frame = number_of(json, "frame");
  if (frame > last_frame) refuse("frame is more than 100000");
  state.frame = static_cast<int>(frame);
}

PageState parse_state(const Json& json) {
  PageState state;
  state.number = number_of(json, "number");
  state.is_moving = flag_of(json, "moving");
  const Json& settings = member(json, "settings");
  if (!settings.is_object() || settings.size() > most_settings) {
    refuse("settings are no object of at most 1000 keys");
  }
  for (const auto& [key, value] : settings.items()) {
    if (value.is_null()) {
      kind_of(key);
      state.open.insert(key);
    } else {
      state.settings.push_back({key, toml_text(key, value)});
    }
  }
  const Json& hidden = member(json, "hidden");
  if (!hidden.is_array() || hidden.size() > most_settings) refuse("hidden is no list");
  for (const Json& component : hidden) {
    if (!component.is_number_unsigned()) refuse("hidden has something that is no component");
    state.hidden.insert(component.get<std::size_t>());
  }
  parse_added(json, state);
  parse_film(json, state);
  Json scene = json;
  for (const char* const name : {"number", "moving", "frame"})
    scene.erase(name);
  state.scene = scene.dump(-1, ' ', false, Json::error_handler_t::replace);
  return state;
}

decltype(PageQuestion::what) parse_question(const std::string& name, const Json& json) {
  if (name == "histogram") {
    return HistogramQuestion{static_cast<std::size_t>(number_of(json, "component"))};
  }
  if (name == "pick") return PickQuestion{share_of(json, "x"), share_of(json, "y")};
  if (name == "places") return PlacesQuestion{};
  if (name == "component") return ComponentQuestion{word_of(member(json, "particles"))};
  if (name == "look") return LookQuestion{word_of(member(json, "look"))};
  if (name == "scene_text") return SceneTextQuestion{};
  if (name == "save_scene") return SaveScene{path_of(json), flag_of(json, "replace")};
  if (name == "save_picture") return SavePicture{path_of(json), flag_of(json, "replace")};
  if (name == "make_film") return MakeFilm{path_of(json), flag_of(json, "replace")};
  refuse("type '" + name.substr(0, longest_quotation) + "' is unknown");
}

PageMessage parse(const Json& json) {
  if (!json.is_object()) refuse("it is no JSON object");
  const Json& type = member(json, "type");
  if (!type.is_string()) refuse("type is no text");
  const auto& name = type.get_ref<const std::string&>();
  if (name == "state") return parse_state(json);
  if (name == "acknowledge") return FrameAcknowledged{number_of(json, "frame")};
  if (name == "cancel_film") return CancelFilm{};
  return PageQuestion{number_of(json, "id"), parse_question(name, json)};
}

}  // namespace

std::vector<std::string> settable_keys(std::size_t components) {
  std::vector<std::string> keys;
  for (const PageKey& key : page_keys)
    keys.emplace_back(key.key);
  for (std::size_t i = 0; i < components; ++i) {
    for (const PageKey& key : component_keys)
      keys.push_back(fmt::format("component.{}.{}", i, key.key));
  }
  return keys;
}

bool is_settable(std::string_view key) {
  return find_kind(key).has_value();
}

PageMessage parse_page_message(std::string_view text) {
  if (text.size() > longest_message_bytes) refuse("it is longer than 256 KiB");
  // Deep nesting would need much stack to take apart; nothing here nests more than twice.
  int depth = 0, deepest = 0;
  for (const char c : text) {
    depth += (c == '[' || c == '{') ? 1 : (c == ']' || c == '}') ? -1 : 0;
    deepest = std::max(deepest, depth);
  }
  if (deepest > 32) refuse("it is nested too deeply");
  const Json json = Json::parse(text.begin(), text.end(), nullptr, false);
  if (json.is_discarded()) refuse("it is not JSON");
  return parse(json);
}

}  // namespace splotchcl::view
