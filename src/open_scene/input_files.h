#pragma once

#include <filesystem>
#include <map>
#include <set>
#include <string>

#include "splotchcl/scene.h"

namespace splotchcl {

class Snapshot;

// The files that drawing scenes reads: snapshots, palettes, lists, pictures, fonts, paths, and all
// of these that the scenes name to which they fade.
class InputFiles {
 public:
  void add(const std::filesystem::path& file) { named_.insert(file); }
  // All files of a snapshot that is open.
  void add(const Snapshot& snapshot);
  // What the scene draws; opens it where it is a single snapshot.
  void add_snapshots(const Scene& scene);
  // What the scene's keys name.
  void add_named_files(const Scene& scene);

  // As they are named, of snapshots the base name of several files, too, with the files that are
  // there of every set.
  std::set<std::filesystem::path> with_sets() const;
  // Those, and the user's own palettes.
  std::set<std::filesystem::path> all() const;

 private:
  std::set<std::filesystem::path> named_;
  std::set<std::string> others_;  // scenes
};

// All that drawing a scene from a file reads: InputFiles::all() of the file, the scene, and the
// snapshot that is open.
std::set<std::filesystem::path> files_read(const std::filesystem::path& file, const Scene& scene,
                                           const Snapshot& snapshot);

}  // namespace splotchcl
