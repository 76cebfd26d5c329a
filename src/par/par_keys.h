#pragma once

#include <string>
#include <vector>

namespace splotchcl::par {

// A key of the original that is not carried over into a scene. N stands for the component.
struct UntranslatedKey {
  const char* name;
  const char* reason;  // completes "KEY REASON"
  bool is_harmless;    // the picture is the same without it
};

// All that are known; docs/original-files.md has them too.
const std::vector<UntranslatedKey>& untranslated_keys();

// All that are carried over, for the nearest name of a mistyped one.
const std::vector<std::string>& translated_keys();

// "color_min1" -> "color_minN", others as they are.
std::string general_name(const std::string& key);

// What the user should know of keys that no scene key took.
std::vector<std::string> explain_untranslated(const std::vector<std::string>& keys);

}  // namespace splotchcl::par
