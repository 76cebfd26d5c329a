#include <fmt/format.h>

#include <algorithm>
#include <cstdlib>
#include <filesystem>
#include <optional>
#include <string>
#include <system_error>
#include <vector>

#include "common/nearest_name.h"
#include "common/text_file.h"
#include "palette/palette_file.h"
#include "splotchcl/error.h"
#include "splotchcl/palette_file.h"
#include "splotchcl_embedded/palettes.h"

namespace splotchcl {
namespace {

namespace fs = std::filesystem;

constexpr const char* folder_variable = "SPLOTCHCL_PALETTES";

std::string stem(const std::string& file_name) {
  return fs::path(file_name).stem().string();
}

// The user's own palettes, which come before the built-in ones.
std::optional<fs::path> own_folder() {
  const char* const value = std::getenv(folder_variable);
  if (value == nullptr || *value == '\0') return std::nullopt;
  std::error_code ignored;
  if (!fs::is_directory(value, ignored)) {
    throw UsageError(fmt::format(
        "environment variable {}: found \"{}\", expected a folder of palette files; correct it "
        "or unset it",
        folder_variable, value));
  }
  return fs::path(value);
}

bool is_palette_file(const fs::path& path) {
  std::error_code ignored;
  const bool is_named_so = path.extension() == ".txt" || path.extension() == ".pal";
  return is_named_so && fs::is_regular_file(path, ignored);
}

// Nothing in a folder that cannot be read.
std::vector<std::string> names_in(const fs::path& folder) {
  std::vector<std::string> names;
  std::error_code error;
  for (fs::directory_iterator entry(folder, error), end; !error && entry != end;
       entry.increment(error)) {
    if (is_palette_file(entry->path())) names.push_back(entry->path().stem().string());
  }
  return names;
}

Palette load_file(const fs::path& path, const std::string& name) {
  Palette palette = parse_palette(read_text_file(path), path.string());
  palette.name = name;
  return palette;
}

std::optional<Palette> find_own(const std::string& name, const std::optional<fs::path>& folder) {
  if (!folder) return std::nullopt;
  for (const char* ending : {".txt", ".pal"}) {
    const fs::path path = *folder / (name + ending);
    if (is_palette_file(path)) return load_file(path, name);
  }
  return std::nullopt;
}

std::optional<Palette> find_built_in(const std::string& name) {
  for (const embedded::TextFile& file : embedded::palettes()) {
    if (stem(file.name) == name) return parse_palette(std::string(file.text), name);
  }
  return std::nullopt;
}

[[noreturn]] void refuse(const std::string& found, const std::string& name,
                         const std::optional<fs::path>& folder) {
  std::vector<std::string> names = palette_names();
  if (folder) {
    const std::vector<std::string> own = names_in(*folder);
    names.insert(names.end(), own.begin(), own.end());
  }
  throw UsageError(fmt::format("palette \"{}\": found {}, expected a palette file or one of {}{}",
                               name, found, fmt::join(names, ", "),
                               did_you_mean(nearest_name(stem(name), names))));
}

}  // namespace

std::vector<std::string> palette_names() {
  std::vector<std::string> names;
  for (const embedded::TextFile& file : embedded::palettes())
    names.push_back(stem(file.name));
  std::sort(names.begin(), names.end());
  return names;
}

Palette load_palette(const std::string& name, const std::filesystem::path& relative_to) {
  const std::optional<fs::path> folder = own_folder();
  if (is_palette_path(name)) {
    const fs::path path = relative_to / name;
    std::error_code ignored;
    if (!fs::exists(path, ignored)) refuse("no such file", name, folder);
    return load_file(path, stem(name));
  }
  if (auto palette = find_own(name, folder)) return *palette;
  if (auto palette = find_built_in(name)) return *palette;
  refuse("no such palette", name, folder);
}

}  // namespace splotchcl
