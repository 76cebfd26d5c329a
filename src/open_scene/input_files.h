#pragma once

#include <filesystem>
#include <map>
#include <optional>
#include <set>
#include <string>

#include "common/file_identity.h"
#include "splotchcl/scene.h"

namespace splotchcl {

class Communicator;
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
  // What the scene's keys name: also the files of the user's palettes and of the font that go by
  // names of their own.
  void add_named_files(const Scene& scene);

  // As they are named, of snapshots the base name of several files, too, with the files that are
  // there of every set.
  std::set<std::filesystem::path> with_sets() const;
  // Those, and the user's own palettes.
  std::set<std::filesystem::path> all() const;

 private:
  void add_palettes(const Scene& scene);
  void add_font(const Scene& scene);

  std::set<std::filesystem::path> named_;
  std::set<std::string> others_;  // scenes
  // By the names of fonts, which are looked for in many folders.
  std::map<std::string, std::optional<std::filesystem::path>> fonts_;
};

// All that drawing a scene from a file reads: InputFiles::all() of the file, the scene, and the
// snapshot that is open.
std::set<std::filesystem::path> files_read(const std::filesystem::path& file, const Scene& scene,
                                           const Snapshot& snapshot);

// What of these is read as long as a picture is drawn: the snapshot, and what the scene's keys
// name.
WatchedFiles watched_files(const Scene& scene, const Snapshot& snapshot);

// Collective, before anything is drawn. Throws DeviceError on all ranks where they have not as many
// files, or one of these that holds something else: hosts may have disks of their own. Of large
// files stretches are compared.
void require_same_files(Communicator& ranks, const std::set<std::filesystem::path>& files,
                        ContentMarks& marks);

}  // namespace splotchcl
