#include "cli/typed_options.h"

#include <CLI/CLI.hpp>
#include <algorithm>
#include <utility>
#include <vector>

#include "cli/map_options.h"

namespace splotchcl::cli {
namespace {

struct KeyOfOption {
  std::string key, option;
};

// All but those of map_options().
const std::vector<KeyOfOption>& common_keys() {
  static const std::vector<KeyOfOption> keys = {
      {"types", "--types"},
      {"where", "--where"},
      {"field", "--field"},
      {"palette", "--palette"},
      {"center", "--center"},
      {"width", "--width"},
      {"option --where", "--where"},
      {"option --center", "--center"},
      {"option --width", "--width"},
      {"option --depth", "--depth"},
      {"image.size", "--size"},
      {"look", "--look"},
      {"tolerance", "--tolerance"},
      {"read.every", "--every"},
      {"read.max_particles", "--max-particles"},
      {"read.columns", "--columns"},
      {"read.skip_lines", "--skip-lines"},
      {"select.where", "--where"},
      {"color.field", "--field"},
      {"map.quantity", "--field"},
      {"map.palette", "--palette"},
      {"map.center", "--center"},
      {"map.center_at", "--center"},
      {"map.width", "--width"},
      {"map.contour_count", "--contours"},
  };
  return keys;
}

std::vector<KeyOfOption> keys_of_options() {
  std::vector<KeyOfOption> keys = common_keys();
  for (const MapOption& option : map_options())
    keys.push_back({"map." + option.key, "--" + option.name});
  return keys;
}

bool begins_with(const std::string& text, const std::string& start) {
  return text.compare(0, start.size(), start) == 0;
}

// component.0.types and component.gas.types are types.
std::string without_component(const std::string& key) {
  const bool is_of_component = begins_with(key, "component.");
  const std::string ending = ".types";
  const bool is_types =
      key.size() > ending.size() && key.rfind(ending) == key.size() - ending.size();
  return is_of_component && is_types ? "types" : key;
}

}  // namespace

TypedOptions::TypedOptions(const CLI::App& command) {
  for (const CLI::Option* option : command.get_options()) {
    if (option->count() == 0) continue;
    for (const std::string& name : option->get_lnames())
      values_["--" + name] = option->results();
  }
}

bool TypedOptions::has_value(const std::string& option, const std::string& value) const {
  const auto found = values_.find(option);
  return found != values_.end() &&
         std::any_of(found->second.begin(), found->second.end(), [&](const std::string& text) {
           return text.find(value) != std::string::npos;
         });
}

// By --set.
bool TypedOptions::sets(const std::string& key) const {
  const auto found = values_.find("--set");
  return found != values_.end() &&
         std::any_of(found->second.begin(), found->second.end(),
                     [&](const std::string& setting) { return begins_with(setting, key + "="); });
}

// Empty where no option that was typed stands for the key.
std::string TypedOptions::option_of(const std::string& key) const {
  if (sets(key)) return {};
  const std::string name = without_component(key);
  for (const auto& [of, option] : keys_of_options()) {
    if (of == name && has(option)) return option;
  }
  return {};
}

// Of 'setting "map.width=-3": key map.width: found' what follows the setting, if an option made it.
std::string TypedOptions::without_setting(const std::string& message) const {
  const std::string start = "setting \"";
  if (!begins_with(message, start)) return message;
  const std::string key = message.substr(start.size(), message.find('=') - start.size());
  const std::size_t end = message.find("\": key " + key + ": ");
  if (option_of(key).empty() || end == std::string::npos) return message;
  return message.substr(end + 3);
}

// Of "key map.width: found" and "width: found".
std::string TypedOptions::with_option_first(const std::string& message) const {
  const std::string word = "key ";
  const std::size_t begin = begins_with(message, word) ? word.size() : 0;
  const std::size_t end = message.find(": ");
  if (end == std::string::npos || end < begin) return message;
  const std::string key = message.substr(begin, end - begin);
  std::string option = option_of(key);
  // Who has given no width may do so by the option.
  const bool is_missing = key == "map.width" && message.find("found") == std::string::npos;
  if (option.empty() && is_missing) option = "--width";
  return option.empty() ? message : option + message.substr(end);
}

// Of 'component gas: color.field is "u", which' and 'component gas: select.where: found', where it
// is about what was typed.
std::string TypedOptions::with_option_within(const std::string& message) const {
  for (const auto& [key, option] : keys_of_options()) {
    for (const std::string& end : {std::string(" is \""), std::string(": ")}) {
      const std::string words = std::string(" ") + key + end;
      const std::size_t place = message.find(words);
      if (place == std::string::npos) continue;
      const std::size_t rest = place + words.size();
      const bool is_typed =
          end == ": " ? is_quoted_in(option, message.substr(rest))
                      : has_value(option, message.substr(rest, message.find('"', rest) - rest));
      if (is_typed)
        return message.substr(0, place + 1) + option + message.substr(rest - end.size());
    }
  }
  return message;
}

// Whether the message quotes what the option was given.
bool TypedOptions::is_quoted_in(const std::string& option, const std::string& message) const {
  const auto found = values_.find(option);
  return found != values_.end() &&
         std::any_of(found->second.begin(), found->second.end(), [&](const std::string& text) {
           return message.find('"' + text + '"') != std::string::npos;
         });
}

// Of "component with select.halo 3: particles", where --center halo=3 asks for the place.
std::string TypedOptions::with_named_place(const std::string& message) const {
  const std::string start = "component with select.halo ";
  if (!begins_with(message, start)) return message;
  const std::size_t end = message.find(':');
  const std::string words = "halo=" + message.substr(start.size(), end - start.size());
  for (const char* option : {"--center", "--follow", "--dive"}) {
    if (has_value(option, words)) return std::string(option) + " " + words + message.substr(end);
  }
  return message;
}

std::string TypedOptions::named_in(const std::string& message) const {
  return with_named_place(with_option_within(with_option_first(without_setting(message))));
}

}  // namespace splotchcl::cli
