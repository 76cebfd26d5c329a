#pragma once

#include <toml++/toml.h>

#include <string>

#include "splotchcl/scene.h"

// Settings: "key=value" strings, given on the command line as --set.
namespace splotchcl::scene_file {

// The line, from 1, of the first key in a TOML text that has more parts than any key of ours could
// have, as in a.a.a.a...; 0: there is none. The parser makes a table inside a table of each part,
// and what goes through them runs out of stack. The text need not be TOML.
int find_deep_key(const std::string& text);

// The table that a text is in TOML. Throws toml::parse_error where it is none.
toml::table parse_toml(const std::string& text);

// A key or table: as the list of keys calls it, and as the user does.
struct KeyAddress {
  std::string path;   // "component.size.field"
  std::string label;  // "component.0.size.field"
  std::size_t component = 0;
};

struct Setting {
  std::string key;
  std::string text;  // right of the first '=', without spaces around it
};

// Throws UsageError without a key or '='.
Setting split_setting(const std::string& setting);

// {value = ...} with the text read as a TOML value, or as a bare string where it is none.
toml::table parse_value(const std::string& text);

// Finds the component in "component.0.palette" or "component.gas.palette"; other keys are
// left as they are. Throws UsageError when the scene has no such component.
KeyAddress locate(const std::string& key, const Scene& scene, const std::string& where);

// "camera" and "near" are "camera.near"; a table without a name is the top level.
std::string join(const std::string& table, const std::string& name);

// Throws UsageError, which names the keys of the table and the one that was probably meant. The
// name may have dots, where it is that of a key in a table of the table.
[[noreturn]] void refuse_unknown_key(const KeyAddress& table, const std::string& name,
                                     const std::string& where);

}  // namespace splotchcl::scene_file
