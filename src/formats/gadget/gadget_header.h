#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "snapshot/snapshot_files.h"
#include "splotchcl/snapshot.h"

namespace splotchcl {

// What the header of one file of a snapshot says, whatever the container. The arrays have
// one entry per particle type and the same length.
struct GadgetHeader {
  std::vector<std::uint64_t> counts;  // in this file
  // In all files, but for what the high words add; all 0 in many initial conditions.
  std::vector<std::uint64_t> total_counts;
  // How often 2^32 is to be added to the total counts. Some codes keep other things here.
  std::vector<std::uint64_t> total_counts_high;
  std::vector<double> table_masses;  // 0: masses are stored per particle
  double time = 0;
  double redshift = 0;
  int files = 1;
  std::optional<BoxSides> box_size;
  double omega_matter = 0;
  double omega_lambda = 0;
  double hubble_parameter = 0;
  bool has_cooling = false;
  bool has_star_formation = false;
  bool has_stellar_age = false;
  bool has_metals = false;

  std::uint64_t particles() const;
  // The total counts with their high words.
  std::vector<std::uint64_t> full_total_counts() const;
};

// Refuses a header that cannot be right, naming `path`: masses below zero or not finite,
// no particles at all in a snapshot of one file.
void check_header(const GadgetHeader& header, const std::filesystem::path& path);

// Whether the named file holds the whole snapshot although its header speaks of more files:
// the header's number of files is not always set.
bool is_complete_alone(const GadgetHeader& header);

// Whether files beside one that is complete alone may belong to it: its header counts more
// particles in all than it holds, or speaks of as many files as are there.
bool may_have_siblings(const GadgetHeader& header, std::size_t files_there);

// Whether two files are of one state of the same simulation.
bool are_of_one_time(const GadgetHeader& a, const GadgetHeader& b);

// The members' headers as one snapshot: counts added, everything else as in the first.
// Refuses members that do not belong together and counts that do not add up; high words of the
// totals that the counts contradict are ignored, with a note.
GadgetHeader merge_headers(const std::vector<GadgetHeader>& headers,
                           const std::vector<std::filesystem::path>& paths,
                           std::vector<std::string>& notes);

// Adds the field `label` to a type whose masses are in the header's table, and notes where
// there are none at all. Masses of the particles' own go before the table.
void add_table_mass(ParticleTypeInfo& type, const char* label, std::vector<std::string>& notes);

// Of fields of the files of a snapshot each label once, as the first file has it that does.
template <class Field>
void add_if_new(const Field& field, std::vector<const Field*>& fields) {
  for (const Field* const known : fields) {
    if (known->label == field.label) return;
  }
  fields.push_back(&field);
}

// Fills what follows from the header: time, redshift, box, h, types with count and mass.
void describe(const GadgetHeader& header, SnapshotInfo& info);

// Of files whose time is the scale factor, where there are cosmologies: a note where the redshift
// tells another.
void note_other_scale_factor(SnapshotInfo& info);

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
