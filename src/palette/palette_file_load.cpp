#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cctype>
#include <cstdlib>
#include <filesystem>
#include <optional>
#include <set>
#include <string>
#include <string_view>
#include <system_error>
#include <utility>
#include <vector>

#include "common/mapped_file.h"
#include "common/words.h"
#include "palette/palette_file.h"
#include "splotchcl/error.h"
#include "splotchcl/palette_file.h"
#include "splotchcl_embedded/palettes.h"

namespace splotchcl {
namespace {

// In lower case without anything between words.
std::string plain(const std::string& name) {
  std::string letters;
  for (const char c : lower_case(name)) {
    const bool is_between = c == ' ' || c == '_' || c == '-';
    if (!is_between) letters += c;
  }
  return letters;
}

std::string without_program(std::string name) {
  for (const std::string start : {"matplotlib:", "mpl:", "mpl_", "cmap:", "cm."}) {
    if (name.compare(0, start.size(), start) == 0) name.erase(0, start.size());
  }
  const std::string ending = "(matplotlib)";
  if (name.size() > ending.size() &&
      name.compare(name.size() - ending.size(), ending.size(), ending) == 0) {
    name.resize(name.size() - ending.size());
  }
  return trimmed(name);
}

// ParaView's, matplotlib's and others' words for palettes that are here.
std::string in_our_words(const std::string& letters) {
  constexpr std::array<std::pair<const char*, const char*>, 6> others = {
      {{"cooltowarm", "coolwarm"},
       {"grey", "gray"},
       {"grayscale", "gray"},
       {"greyscale", "gray"},
       {"bwlinear", "gray"},
       {"binary", "greys"}}};
  for (const auto& [other, ours] : others) {
    if (letters == other) return ours;
  }
  return letters;
}

// The one of these names that another program means by a name of its own: in other cases of
// letters, "Viridis (matplotlib)", "Cool to Warm", "grayscale". None where it means none, or more
// than one.
std::optional<std::string> palette_named_otherwise(const std::string& name,
                                                   const std::vector<std::string>& known) {
  const std::string wanted = in_our_words(plain(without_program(lower_case(name))));
  std::optional<std::string> found;
  if (wanted.empty()) return found;
  for (const std::string& candidate : known) {
    if (plain(candidate) != wanted) continue;
    if (found) return std::nullopt;
    found = candidate;
  }
  return found;
}

namespace fs = std::filesystem;

constexpr const char* folder_variable = "SPLOTCHCL_PALETTES";
constexpr std::string_view reversed_ending = "_r";

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

constexpr std::array<const char*, 12> endings = {".txt", ".pal", ".gpl", ".cpt",  ".act", ".lut",
                                                 ".rgb", ".csv", ".sao", ".json", ".xml", ".npy"};

bool is_palette_file(const fs::path& path) {
  std::error_code ignored;
  const std::string ending = path.extension().string();
  const bool is_named_so = std::find(endings.begin(), endings.end(), ending) != endings.end();
  return is_named_so && fs::is_regular_file(path, ignored);
}

// The path of a palette in the user's folder; empty where there is none.
fs::path own_file(const fs::path& folder, const std::string& name) {
  for (const char* const ending : endings) {
    const fs::path path = folder / (name + ending);
    if (is_palette_file(path)) return path;
  }
  return {};
}

// Each name once. Nothing in a folder that cannot be read.
std::set<std::string> names_in(const fs::path& folder) {
  std::set<std::string> names;
  std::error_code error;
  for (fs::directory_iterator entry(folder, error), end; !error && entry != end;
       entry.increment(error)) {
    if (is_palette_file(entry->path())) names.insert(entry->path().stem().string());
  }
  return names;
}

Palette load_file(const fs::path& path, const std::string& name) {
  Palette palette = parse_palette(read_text_file(path), path.string());
  palette.name = name;
  return palette;
}

std::optional<Palette> find_own(const std::string& name, const std::optional<fs::path>& folder) {
  const fs::path path = folder ? own_file(*folder, name) : fs::path();
  if (path.empty()) return std::nullopt;
  return load_file(path, name);
}

std::optional<Palette> find_built_in(const std::string& name) {
  for (const embedded::TextFile& file : embedded::palettes()) {
    if (stem(file.name) == name) return parse_palette(std::string(file.text), name);
  }
  return std::nullopt;
}

std::optional<Palette> find_named(const std::string& name, const std::optional<fs::path>& folder) {
  if (auto palette = find_own(name, folder)) return palette;
  return find_built_in(name);
}

// The name of the palette that this is the reverse of; none where it does not say so.
std::optional<std::string> name_before_reversal(const std::string& name) {
  if (name.size() <= reversed_ending.size()) return std::nullopt;
  const std::size_t length = name.size() - reversed_ending.size();
  if (name.substr(length) != reversed_ending) return std::nullopt;
  return name.substr(0, length);
}

Palette reversed(Palette palette, const std::string& name) {
  palette.name = name;
  std::reverse(palette.emission.begin(), palette.emission.end());
  std::reverse(palette.absorption.begin(), palette.absorption.end());
  return palette;
}

std::optional<std::string> nearest_palette(const std::string& name) {
  std::vector<std::string> names;
  for (const PaletteInfo& palette : list_palettes())
    names.push_back(palette.name);
  if (const auto before = name_before_reversal(name)) {
    if (const auto nearest = nearest_name(*before, names)) {
      return *nearest + std::string(reversed_ending);
    }
  }
  return nearest_name(name, names);
}

[[noreturn]] void refuse(const std::string& found, const std::string& name) {
  throw UsageError(fmt::format(
      "palette \"{}\": found {}, expected a palette file or a name that \"splotchcl palettes\" "
      "lists{}",
      name, found, did_you_mean(nearest_palette(stem(name)))));
}

// As people look for names: upper and lower case together.
bool comes_before(const PaletteInfo& a, const PaletteInfo& b) {
  const auto lower = [](std::string text) {
    for (char& letter : text)
      letter = static_cast<char>(std::tolower(static_cast<unsigned char>(letter)));
    return text;
  };
  return std::make_pair(lower(a.name), a.name) < std::make_pair(lower(b.name), b.name);
}

// Empty where the file cannot be read, which is said when it is used.
std::string description_in(const fs::path& file, const std::string& name) {
  try {
    return palette_description(read_text_file(file), name);
  } catch (const DataError&) {
    return "";
  }
}

}  // namespace

std::vector<std::string> palette_names() {
  std::vector<std::string> names;
  for (const embedded::TextFile& file : embedded::palettes())
    names.push_back(stem(file.name));
  std::sort(names.begin(), names.end());
  return names;
}

std::vector<PaletteInfo> list_palettes() {
  std::vector<PaletteInfo> palettes;
  const std::optional<fs::path> folder = own_folder();
  const std::set<std::string> own = folder ? names_in(*folder) : std::set<std::string>();
  for (const std::string& name : own) {
    const fs::path file = own_file(*folder, name);
    palettes.push_back({name, file, description_in(file, name)});
  }
  for (const embedded::TextFile& file : embedded::palettes()) {
    const std::string name = stem(file.name);
    if (own.count(name) > 0) continue;
    palettes.push_back({name, {}, palette_description(std::string(file.text), name)});
  }
  std::sort(palettes.begin(), palettes.end(), comes_before);
  return palettes;
}

fs::path own_palette_file(const std::string& name) {
  const std::optional<fs::path> folder = own_folder();
  if (!folder || is_palette_path(name)) return {};
  if (const fs::path file = own_file(*folder, name); !file.empty()) return file;
  if (find_built_in(name)) return {};
  const auto before = name_before_reversal(name);
  return before ? own_file(*folder, *before) : fs::path();
}

Palette load_palette(const std::string& name, const std::filesystem::path& relative_to) {
  const std::optional<fs::path> folder = own_folder();
  if (is_palette_path(name)) {
    const fs::path path = relative_to / name;
    std::error_code ignored;
    if (!fs::exists(path, ignored)) refuse("no such file", name);
    return load_file(path, stem(name));
  }
  if (auto palette = find_named(name, folder)) return *palette;
  const auto before = name_before_reversal(name);
  if (before) {
    if (auto palette = find_named(*before, folder)) return reversed(std::move(*palette), name);
  }
  if (const auto ours = palette_named_otherwise(before.value_or(name), palette_names())) {
    Palette palette = *find_built_in(*ours);
    return before ? reversed(std::move(palette), name) : std::move(palette);
  }
  refuse("no such palette", name);
}

}  // namespace splotchcl
