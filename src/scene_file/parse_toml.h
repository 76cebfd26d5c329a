#pragma once

#include <toml++/toml.h>

#include <string>

namespace splotchcl::scene_file {

// The line, from 1, of the first key in a TOML text that has more parts than any key of ours could
// have, as in a.a.a.a...; 0: there is none. The parser makes a table inside a table of each part,
// and what goes through them runs out of stack. The text need not be TOML.
int find_deep_key(const std::string& text);

// The table that a text is in TOML. Throws toml::parse_error where it is none.
toml::table parse_toml(const std::string& text);

}  // namespace splotchcl::scene_file
