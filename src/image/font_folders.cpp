#include "image/font_folders.h"

#include <algorithm>
#include <array>
#include <cstdlib>
#include <optional>
#include <vector>

#include "common/words.h"
#include "splotchcl/error.h"

namespace splotchcl {
namespace {

namespace fs = std::filesystem;

constexpr std::array<const char*, 3> font_endings = {".ttf", ".otf", ".ttc"};

bool is_font_ending(const std::string& ending) {
  return std::find(font_endings.begin(), font_endings.end(), lower_case(ending)) !=
         font_endings.end();
}

std::vector<fs::path> font_folders() {
  std::vector<fs::path> folders;
  // Not in the folder that is current, which may be anyone's.
  if (const char* const home = std::getenv("HOME"); home != nullptr && *home == '/') {
    folders.push_back(fs::path(home) / ".local/share/fonts");
    folders.push_back(fs::path(home) / ".fonts");
    folders.push_back(fs::path(home) / "Library/Fonts");
  }
  for (const char* const folder :
       {"/usr/local/share/fonts", "/usr/share/fonts", "/Library/Fonts", "/System/Library/Fonts"}) {
    folders.emplace_back(folder);
  }
  return folders;
}

// The first in the order of names, so that it is the same every time.
std::optional<fs::path> find_in(const fs::path& folder, const std::string& name) {
  std::optional<fs::path> found;
  std::error_code error;
  const auto options = fs::directory_options::skip_permission_denied;
  for (fs::recursive_directory_iterator entry(folder, options, error), end; !error && entry != end;
       entry.increment(error)) {
    const fs::path& file = entry->path();
    const bool fits = is_font_ending(file.extension().string()) &&
                      lower_case(file.stem().string()) == lower_case(name);
    if (fits && (!found || file < *found)) found = file;
  }
  return found;
}

}  // namespace

bool is_font_path(const std::string& font) {
  return font.find('/') != std::string::npos || is_font_ending(fs::path(font).extension().string());
}

fs::path find_font(const std::string& name) {
  if (is_font_path(name)) {
    std::error_code error;
    if (fs::is_regular_file(name, error)) return name;
    throw UsageError("finish.font: found no file " + name + ", expected a font file (.ttf, .otf)");
  }
  std::string searched;
  for (const fs::path& folder : font_folders()) {
    if (const std::optional<fs::path> font = find_in(folder, name)) return *font;
    searched += (searched.empty() ? "" : ", ") + folder.string();
  }
  throw UsageError("finish.font: found no " + name + ".ttf in " + searched +
                   "; install it (on Debian: apt-get install fonts-dejavu-core) or give the path "
                   "of a font file as finish.font");
}

}  // namespace splotchcl
