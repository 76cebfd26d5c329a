#include <fmt/format.h>

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <string>
#include <utility>
#include <vector>

#include "cli/commands.h"
#include "index/snapshot_index.h"
#include "load/component_tree.h"
#include "splotchcl/error.h"
#include "splotchcl/load.h"
#include "splotchcl/scene.h"
#include "splotchcl/scene_file.h"
#include "splotchcl/snapshot_file.h"
#include "tree/build_tree.h"
#include "tree/tree_file.h"

namespace splotchcl::cli {

int run_index(const IndexOptions& options, Console& console) {
  const auto snapshot = open_snapshot(options.snapshot);
  const SnapshotIndex index = SnapshotIndex::make(
      *snapshot, [&console](double done) { console.progress("reading positions", done); });
  index.write(snapshot->info());
  std::size_t blocks = 0;
  for (const SnapshotIndex::Type& type : index.types()) {
    blocks += type.boxes.size();
    if (type.has_smoothing_lengths) continue;
    console.note(fmt::format(
        "type {} has no smoothing lengths in its file: its index serves scenes that say their "
        "size (size.fixed)",
        type.type));
  }
  console.done(
      fmt::format("{}: {} blocks", SnapshotIndex::path_for(snapshot->info()).string(), blocks));
  return 0;
}

namespace {

std::vector<int> types_of(const TreeCommandOptions& options, const SnapshotInfo& info) {
  std::vector<int> types;
  for (const ParticleTypeInfo& type : info.types)
    types.push_back(type.type);
  if (options.types.empty()) return types;
  for (const int type : options.types) {
    if (std::find(types.begin(), types.end(), type) == types.end()) {
      throw UsageError(
          fmt::format("--types: found {}, expected types that {} has; splotchcl info "
                      "lists them",
                      type, info.files.front().string()));
    }
  }
  return options.types;
}

// For its colors, which do not need reference columns.
DecidedScene scene_of(const TreeCommandOptions& options, const Snapshot& snapshot,
                      Console& console) {
  Scene scene = options.scene ? read_scene_file(*options.scene) : suggest_scene(snapshot);
  for (Component& component : scene.components)
    component.reference_column = 1;
  std::vector<std::string> notes;
  DecidedScene decided = decide(scene, snapshot, notes, [&](const std::string& what, double done) {
    console.progress(what, done);
  });
  console.note_each_once(notes);
  return decided;
}

}  // namespace

int run_tree(const TreeCommandOptions& options, Console& console) {
  const auto snapshot = open_snapshot(options.snapshot);
  const SnapshotInfo& info = snapshot->info();
  if (!tree_is_of_use(info)) {
    throw UsageError(fmt::format(
        "{}: expected a whole snapshot in files, whose tree can lie beside them; store it as one "
        "first, such as HDF5 by h5py",
        options.snapshot.string()));
  }
  if (options.fields.size() > most_fields) {
    throw UsageError(fmt::format("--fields: found {} fields, expected at most {}",
                                 options.fields.size(), most_fields));
  }
  const DecidedScene decided = scene_of(options, *snapshot, console);
  std::vector<TreeOfType> trees;
  std::vector<TreeSource> particles_of_trees;
  std::uint64_t particles = 0, nodes = 0;
  for (const int type : types_of(options, info)) {
    const std::vector<std::string> fields =
        options.fields.empty() ? fields_shown(decided.scene, type) : options.fields;
    std::vector<std::string> notes;
    const LoadProgress reading = [&](const std::string& what, double fraction) {
      console.progress(what, fraction);
    };
    TreeSource source = tree_source(*snapshot, type, fields, notes, reading);
    source.colors = colors_shown(decided, type, fields);
    console.note_each_once(notes);
    TreeOptions of_tree;
    of_tree.least = options.least;
    trees.push_back(build_tree(source, of_tree, [&](double fraction) {
      console.progress(fmt::format("merging type {}", type), fraction);
    }));
    trees.back().sample = sample_to_keep(*snapshot, source);
    if (trees.back().bad > 0) {
      console.note(
          fmt::format("type {}: {} particles are not in the tree, since a value of theirs "
                      "is not finite, the smoothing length not above 0 or the mass below "
                      "0",
                      type, trees.back().bad));
    }
    particles += trees.back().count;
    nodes += trees.back().node_count();
    if (options.with_particles) particles_of_trees.push_back(std::move(source));
  }
  write_trees(info, trees, particles_of_trees);
  const std::filesystem::path path = tree_path(info);
  const auto bytes = static_cast<double>(std::filesystem::file_size(path));
  console.done(fmt::format("{}: {} particles, {} nodes, {:.2f} bytes per particle", path.string(),
                           particles, nodes,
                           particles > 0 ? bytes / static_cast<double>(particles) : 0.0));
  return 0;
}

}  // namespace splotchcl::cli
