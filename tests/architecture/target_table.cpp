#include "architecture/target_table.h"

#include "testing.h"

namespace splotchcl::test {
namespace {

// How many parts of the path a folder is, if the file lies in it; 0: it does not.
std::ptrdiff_t depth_in(const std::filesystem::path& folder, const std::filesystem::path& file) {
  const auto [in_folder, in_file] =
      std::mismatch(folder.begin(), folder.end(), file.begin(), file.end());
  (void)in_file;
  return in_folder == folder.end() ? std::distance(folder.begin(), folder.end()) : 0;
}

void add(const std::string& kind, const std::string& word, Target& target) {
  if (kind == "folder") {
    target.folders.emplace_back(word);
  } else if (kind == "header") {
    target.public_headers.push_back(word);
  } else if (kind == "links") {
    target.links.push_back(word);
  } else if (kind == "exports") {
    target.exports.push_back(word);
  } else {
    throw std::runtime_error("table of targets: found " + kind + ", which is no kind of line");
  }
}

}  // namespace

TargetTable TargetTable::read(std::istream& text) {
  std::vector<Target> targets;
  std::string kind, word;
  while (text >> kind >> word) {
    if (kind == "target") {
      targets.push_back({word, {}, {}, {}, {}});
    } else if (targets.empty()) {
      throw std::runtime_error("table of targets: found " + kind + " before any target");
    } else {
      add(kind, word, targets.back());
    }
  }
  return TargetTable(std::move(targets));
}

const Target* TargetTable::find(const std::string& name) const {
  const auto found = std::find_if(targets_.begin(), targets_.end(),
                                  [&](const Target& target) { return target.name == name; });
  return found == targets_.end() ? nullptr : &*found;
}

const Target* TargetTable::owner_of_header(const std::string& public_header) const {
  for (const Target& target : targets_) {
    const auto& headers = target.public_headers;
    if (std::find(headers.begin(), headers.end(), public_header) != headers.end()) return &target;
  }
  return nullptr;
}

const Target* TargetTable::owner_of_file(const std::filesystem::path& file) const {
  const Target* owner = nullptr;
  std::ptrdiff_t deepest = 0;
  for (const Target& target : targets_) {
    for (const std::filesystem::path& folder : target.folders) {
      const std::ptrdiff_t depth = depth_in(folder, file);
      if (depth > deepest) {
        deepest = depth;
        owner = &target;
      }
    }
  }
  return owner;
}

std::set<std::string> TargetTable::may_include(const Target& target) const {
  std::set<std::string> names = {target.name};
  for (const std::string& link : target.links)
    add_with_exports(link, names);
  return names;
}

void TargetTable::add_with_exports(const std::string& name, std::set<std::string>& names) const {
  if (!names.insert(name).second) return;
  const Target* const target = find(name);
  if (target == nullptr) return;
  for (const std::string& exported : target->exports)
    add_with_exports(exported, names);
}

}  // namespace splotchcl::test
