#include "cli/scene_argument.h"

#include <algorithm>
#include <array>
#include <cctype>
#include <fstream>

#include "splotchcl/par_file.h"
#include "splotchcl/scene_file.h"

namespace splotchcl::cli {
namespace {

std::string lower_ending(const std::filesystem::path& path) {
  std::string ending = path.extension().string();
  std::transform(ending.begin(), ending.end(), ending.begin(),
                 [](unsigned char c) { return static_cast<char>(std::tolower(c)); });
  return ending;
}

// Snapshots are binary: their first bytes hold some that no text does.
bool begins_like_text(const std::filesystem::path& path) {
  std::error_code error;
  if (!std::filesystem::is_regular_file(path, error)) return false;
  std::array<char, 256> start;
  std::ifstream file(path, std::ios::binary);
  file.read(start.data(), start.size());
  const auto length = file.gcount();
  return length > 0 && std::all_of(start.begin(), start.begin() + length, [](unsigned char c) {
           return c == '\n' || c == '\r' || c == '\t' || (c >= 32 && c != 127);
         });
}

}  // namespace

bool is_par_file(const std::filesystem::path& path) {
  return lower_ending(path) == ".par";
}

SceneWithSnapshot open_scene(const std::filesystem::path& path,
                             const std::vector<std::string>& settings) {
  SceneWithSnapshot result;
  if (is_par_file(path)) {
    result.scene = read_par_file(path, settings, result.notes);
    result.snapshot = SnapshotSource().at(result.scene);
  } else if (lower_ending(path) == ".toml" || begins_like_text(path)) {
    result.scene = read_scene_file(path, settings);
    result.snapshot = SnapshotSource().at(result.scene);
  } else {
    result.snapshot = open_snapshot(path);
    result.scene = apply_settings(suggest_scene(*result.snapshot), settings);
  }
  return result;
}

}  // namespace splotchcl::cli
