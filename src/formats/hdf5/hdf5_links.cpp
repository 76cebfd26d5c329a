#include <fmt/format.h>

#include <algorithm>

#include "common/mapped_file.h"
#include "common/words.h"
#include "formats/hdf5/hdf5_file.h"
#include "splotchcl/error.h"

namespace splotchcl {
namespace {

namespace fs = std::filesystem;

// In a folder or below it, and a regular file.
bool may_be_followed(const fs::path& folder, const fs::path& file) {
  std::error_code error;
  if (!fs::is_regular_file(file, error)) return false;
  const fs::path inside =
      fs::absolute(file, error)
          .lexically_normal()
          .lexically_relative(fs::absolute(folder, error).lexically_normal() / "");
  return !inside.empty() && *inside.begin() != "..";
}

// HDF5 asks before it opens the file of an external link; below 0 it does not.
herr_t judge_link(const char* parent, const char*, const char* child, const char*, unsigned*, hid_t,
                  void* data) {
  auto& links = *static_cast<Hdf5Links*>(data);
  try {
    const fs::path folder = folder_of(parent);
    const fs::path file = folder / child;
    if (may_be_followed(folder, file)) {
      links.followed.insert(file);
      return 0;
    }
    if (fs::exists(file)) links.refused.insert(child);  // where there is no file, the link is dead
  } catch (...) {
    // No memory: nothing may be thrown through HDF5.
  }
  return -1;
}

// Of a name with a number of a block in it, "part_%b.hdf5".
std::string fill_block(const std::string& pattern, std::size_t block) {
  std::string name = pattern;
  const std::size_t place = name.find("%b");
  if (place != std::string::npos) name.replace(place, 2, std::to_string(block));
  return name;
}

void check_source(const fs::path& place, Hdf5Links& links) {
  require_regular_file(place);
  links.followed.insert(place);
}

}  // namespace

void note_refused(const Hdf5Links& links, std::vector<std::string>& notes) {
  for (const std::string& other : links.refused) {
    notes.push_back(
        fmt::format("what lies in {} is left out: links are followed to files in the snapshot's "
                    "own folder only",
                    other));
  }
  for (const std::string& link : links.dead)
    notes.push_back(fmt::format("{} is left out: nothing is there", link));
}

Hdf5LinkRules::Hdf5LinkRules(Hdf5Links& links)
    : of_links_(H5Pcreate(H5P_LINK_ACCESS)),
      of_groups_(H5Pcreate(H5P_GROUP_ACCESS)),
      of_datasets_(H5Pcreate(H5P_DATASET_ACCESS)) {
  for (const hid_t properties : {of_links(), of_groups(), of_datasets()})
    H5Pset_elink_cb(properties, judge_link, &links);
}

std::string virtual_source_name(ssize_t (*get)(hid_t, std::size_t, char*, std::size_t),
                                hid_t properties, std::size_t source) {
  const ssize_t length = get(properties, source, nullptr, 0);
  std::string name(static_cast<std::size_t>(std::max<ssize_t>(length, 0)), '\0');
  get(properties, source, name.data(), name.size() + 1);
  return name;
}

fs::path find_virtual_source(const fs::path& virtual_file, const fs::path& name) {
  const fs::path folder = virtual_file.parent_path();
  std::error_code ignored;
  for (const auto& place : {folder / name, folder / name.filename(), name}) {
    if (fs::exists(place, ignored)) return place;
  }
  return folder / name;
}

fs::path file_of_dataset(hid_t dataset) {
  const ssize_t length = H5Fget_name(dataset, nullptr, 0);
  std::string name(static_cast<std::size_t>(std::max<ssize_t>(length, 0)), '\0');
  H5Fget_name(dataset, name.data(), name.size() + 1);
  return name;
}

void check_virtual_sources(hid_t dataset, Hdf5Links& links) {
  const Hdf5Handle<H5Pclose> properties(H5Dget_create_plist(dataset));
  if (H5Pget_layout(properties.id()) != H5D_VIRTUAL) return;
  const fs::path file = file_of_dataset(dataset);
  std::size_t sources = 0;
  H5Pget_virtual_count(properties.id(), &sources);
  std::error_code ignored;
  for (std::size_t i = 0; i < sources; ++i) {
    const std::string name = virtual_source_name(H5Pget_virtual_filename, properties.id(), i);
    if (name == ".") continue;
    const bool is_pattern = name.find("%b") != std::string::npos;
    for (std::size_t block = 0;; ++block) {
      const fs::path place = find_virtual_source(file, fill_block(name, block));
      if (!fs::exists(place, ignored)) break;  // said elsewhere
      check_source(place, links);
      if (!is_pattern) break;
    }
  }
}

}  // namespace splotchcl
