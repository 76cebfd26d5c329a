#pragma once

#include <toml++/toml.h>

#include <string>

namespace splotchcl::scene_file {

// The table that a text is in TOML. Throws toml::parse_error where it is none.
toml::table parse_toml(const std::string& text);

}  // namespace splotchcl::scene_file
