#include "scene_file/parse_toml.h"

namespace splotchcl::scene_file {

// Twice before it is none: the parser reads numbers from a stream, which takes memory that it does
// not get for a number that it cannot read.
toml::table parse_toml(const std::string& text) {
  try {
    return toml::parse(text);
  } catch (const toml::parse_error&) {
    return toml::parse(text);
  }
}

}  // namespace splotchcl::scene_file
