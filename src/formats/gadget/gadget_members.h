#pragma once

#include <algorithm>
#include <filesystem>
#include <string>
#include <utility>
#include <vector>

#include "formats/gadget/gadget_header.h"
#include "snapshot/snapshot_files.h"
#include "splotchcl/snapshot.h"

namespace splotchcl {

// The files of the snapshot that `path`, with this header, belongs to. A header may say that its
// file is all there is and be wrong: files beside it of the same time then count as well.
template <typename Read>
std::vector<std::filesystem::path> find_set(const std::filesystem::path& path,
                                            const GadgetHeader& header, Read&& read) {
  if (!is_complete_alone(header)) return find_members(path, header.files);
  const std::vector<std::filesystem::path> siblings = find_siblings(path);
  if (siblings.size() < 2 || !may_have_siblings(header, siblings.size())) return {path};
  std::vector<std::string> ignored;
  const bool are_of_one_snapshot =
      std::all_of(siblings.begin(), siblings.end(), [&](const std::filesystem::path& sibling) {
        return sibling == path || are_of_one_time(header, read(sibling, ignored).header());
      });
  if (are_of_one_snapshot) return siblings;
  return {path};
}

// The files of the snapshot that `path` belongs to, in order, each as `read` gives it:
// read(path, notes) returns a Member, which has a header(). Fills in what `info` says of
// the whole. Throws DataError when they do not belong together.
template <typename Read>
auto read_members(const std::filesystem::path& path, Read&& read, SnapshotInfo& info) {
  std::vector<std::string> notes;
  // The named file first: what is wrong with it matters more than what is missing beside it.
  auto named = read(path, notes);
  info.files = find_set(path, named.header(), read);
  std::vector<decltype(named)> members;
  std::vector<GadgetHeader> headers;
  for (const auto& file : info.files) {
    members.push_back(file == path ? std::move(named) : read(file, notes));
    headers.push_back(members.back().header());
  }
  for (std::string& note : notes) {  // members tend to have the same ones
    const bool is_new = std::find(info.notes.begin(), info.notes.end(), note) == info.notes.end();
    if (is_new) info.notes.push_back(std::move(note));
  }
  describe(merge_headers(headers, info.files, info.notes), info);
  return members;
}

}  // namespace splotchcl
