#include "view/tree_maker.h"

#include <cstdint>
#include <set>
#include <string>
#include <utility>

#include "load/component_tree.h"
#include "splotchcl/error.h"

namespace splotchcl::view {
namespace {

struct GivenUp {};

std::vector<std::string> fields_of(const Scene& scene, int type) {
  const std::vector<std::string> fields = fields_shown(scene, type);
  return fields.size() > most_fields ? std::vector<std::string>() : fields;
}

std::set<int> types_of(const Scene& scene, const SnapshotInfo& info) {
  std::set<int> types;
  for (const Component& component : scene.components) {
    if (!component.snapshot.empty()) continue;
    for (const int type : component.types) {
      if (info.find_type(type) != nullptr) types.insert(type);
    }
  }
  return types;
}

std::uint64_t count_of(const std::set<int>& types, const SnapshotInfo& info) {
  std::uint64_t count = 0;
  for (const int type : types)
    count += info.find_type(type)->count;
  return count;
}

std::vector<TreeSource> sources_of(const Scene& scene, const Snapshot& snapshot,
                                   const std::set<int>& types) {
  std::vector<TreeSource> sources;
  std::vector<std::string> told_already;
  for (const int type : types)
    sources.push_back(tree_source(snapshot, type, fields_of(scene, type), told_already, {}));
  return sources;
}

}  // namespace

TreeMaker::TreeMaker(const Scene& scene, std::shared_ptr<const Snapshot> snapshot,
                     std::uint64_t fewest_particles)
    : snapshot_(std::move(snapshot)) {
  const std::set<int> types = types_of(scene, snapshot_->info());
  const bool is_wanted = !scene.time.is_set() && !has_tree(*snapshot_) &&
                         count_of(types, snapshot_->info()) >= fewest_particles;
  if (!is_wanted) return;
  std::vector<TreeSource> sources;
  try {
    sources = sources_of(scene, *snapshot_, types);
  } catch (const Error&) {
    return;  // a random part is shown, as of what no tree serves
  }
  is_at_work_ = true;
  thread_ = std::thread([this, sources = std::move(sources)] { make(sources); });
}

TreeMaker::~TreeMaker() {
  is_given_up_ = true;
  if (thread_.joinable()) thread_.join();
}

void TreeMaker::make(const std::vector<TreeSource>& sources) {
  try {
    for (const TreeSource& source : sources) {
      trees_.push_back(std::make_shared<TreeOfType>(build_tree(source, {}, [this](double) {
        if (is_given_up_) throw GivenUp();
      })));
    }
    is_made_ = true;
  } catch (const GivenUp&) {
  } catch (const Error&) {
    // More than 255 particles lie in one place: a random part is shown.
  }
  is_at_work_ = false;
}

}  // namespace splotchcl::view
