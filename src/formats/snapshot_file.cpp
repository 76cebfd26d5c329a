#include "splotchcl/snapshot_file.h"

#include <fmt/format.h>

#include <algorithm>
#include <map>

#include "formats/snapshot_format.h"
#include "formats/text/table_layout.h"
#include "snapshot/derived_snapshots.h"
#include "snapshot/field_names.h"
#include "snapshot/snapshot_files.h"
#include "splotchcl/error.h"

namespace splotchcl {
namespace fs = std::filesystem;
namespace {

constexpr const char* what_is_expected =
    "expected Gadget format 1 or 2, HDF5 of Gadget, SWIFT, Phantom and the like, Tipsy, NumPy, or "
    "a "
    "table as text";

struct FamiliarFile {
  std::string_view start;
  const char* what;
};

std::string_view content_of(const MappedFile& file) {
  return {reinterpret_cast<const char*>(file.data()), file.size()};
}

// What a file of another kind is by its signature, and what to do; null where it has none.
const char* find_familiar(std::string_view content) {
  using namespace std::string_view_literals;
  static constexpr FamiliarFile known[] = {
      {"\x1f\x8b"sv, "a gzip archive; unpack it first"},
      {"BZh"sv, "a bzip2 archive; unpack it first"},
      {"\xfd\x37zXZ\0"sv, "an xz archive; unpack it first"},
      {"\x28\xb5\x2f\xfd"sv, "a zstd archive; unpack it first"},
      {"7z\xbc\xaf\x27\x1c"sv, "a 7z archive; unpack it first"},
      {"\x89PNG"sv, "a PNG image"},
      {"\xff\xd8\xff"sv, "a JPEG image"},
      {"GIF8"sv, "a GIF image"},
      {"\x76\x2f\x31\x01"sv, "an EXR image"},
      {"II*\0"sv, "a TIFF image"},
      {"%PDF"sv, "a PDF document"},
      {"\xff\xfe"sv, "text in UTF-16; save it as UTF-8"},
      {"\xfe\xff"sv, "text in UTF-16; save it as UTF-8"},
      {"\x7f\x45LF"sv, "a program"},
      {"SIMPLE  ="sv, "a FITS file; convert it to HDF5 or to a NumPy array"}};
  for (const FamiliarFile& other : known) {
    if (content.substr(0, other.start.size()) == other.start) return other.what;
  }
  constexpr std::size_t tar_mark = 257;
  const bool is_tar = content.size() >= tar_mark + 5 && content.substr(tar_mark, 5) == "ustar";
  return is_tar ? "a tar archive; unpack it first" : nullptr;
}

bool are_letters(std::string_view content) {
  return std::all_of(content.begin(), content.end(), [](char c) {
    return c == '\n' || c == '\r' || c == '\t' || static_cast<unsigned char>(c) >= 32;
  });
}

// What a file that is no snapshot is, where its bytes tell, and what to do.
std::string describe_other(const fs::path& path) {
  if (const char* const kind = find_other_kind(path)) return kind;
  const auto file = MappedFile::open(path);
  const bool is_text = are_letters(content_of(*file).substr(0, 4096));
  const auto rows = is_text ? find_rows_in_text(*file) : std::nullopt;
  if (rows) {
    return fmt::format(
        "text with rows of {} columns from line {} on, after lines that do not name them; name "
        "them in their order, as in read.columns = [\"x\", \"y\", \"z\", \"mass\"], \"-\" for "
        "those "
        "that are not needed",
        rows->columns, rows->line);
  }
  return is_text ? "text, but no table with three or more numbers in each line" : "";
}

std::string first_bytes(const fs::path& path) {
  const auto file = MappedFile::open(path);
  std::string text;
  for (std::uint64_t i = 0; i < std::min<std::uint64_t>(file->size(), 8); ++i) {
    text += fmt::format("{}{:02x}", i == 0 ? "" : " ", std::to_integer<unsigned>(file->data()[i]));
  }
  return text;
}

// Whatever else may be missing: without positions there is nothing to draw.
void check_positions(const SnapshotInfo& info) {
  for (const ParticleTypeInfo& type : info.types) {
    const FieldInfo* const position = find_field(type, "position");
    if (position != nullptr && position->values_per_particle == 3) continue;
    throw DataError(
        fmt::format("{}: particles of type {} have no positions of three coordinates in every file "
                    "of the snapshot; the snapshot is incomplete or damaged",
                    info.files.front().string(), type.type));
  }
}

// The format of the file that a path is of, or leads into.
const SnapshotFormat* find_format_of(const fs::path& path) {
  const auto within = path_in_file(path);
  if (!within) return find_format(path);
  const SnapshotFormat* const format = find_format(within->file);
  if (format != nullptr && format->has_groups()) return format;
  throw DataError(fmt::format("{}: {} is a file without groups; give the path of a snapshot",
                              path.string(), within->file.string()));
}

bool is_text(const fs::path& path) {
  std::error_code ignored;
  if (!fs::is_regular_file(path, ignored) || fs::file_size(path, ignored) == 0) return false;
  const auto file = MappedFile::open(path);
  return find_other_kind(path) == nullptr && are_letters(content_of(*file).substr(0, 4096));
}

// Where lines are to be skipped the file is a text table, whatever these lines look like.
const SnapshotFormat* text_format_of(const fs::path& path, const SnapshotFormat* found) {
  const bool may_be_text = found == nullptr || found == &text_table_format();
  const bool is_file = fs::is_regular_file(path) || path_in_file(path);
  if (may_be_text && is_file) return &text_table_format();
  throw UsageError(fmt::format(
      "{}: read.skip_lines is for tables of text, but this is none; leave it out", path.string()));
}

std::unique_ptr<Snapshot> open_file(const fs::path& path, const SnapshotOptions& options) {
  const SnapshotFormat* format = find_format_of(path);
  if (options.skip_lines > 0) format = text_format_of(path, format);
  // Who names columns knows of rows that nothing else tells from other text.
  if (format == nullptr && !options.columns.empty() && is_text(path)) format = &text_table_format();
  if (format != nullptr) {
    auto snapshot = format->open(path, options);
    if (!options.columns.empty() && !format->has_columns(options.columns)) {
      throw UsageError(
          fmt::format("{}: read.columns is for tables, but this is {}, whose fields have "
                      "names; leave read.columns out",
                      path.string(), snapshot->info().format));
    }
    check_positions(snapshot->info());
    return snapshot;
  }
  if (fs::file_size(path) == 0) {
    throw DataError(fmt::format(
        "{}: the file is empty; expected a snapshot: copy or write it again", path.string()));
  }
  const std::string other = describe_other(path);
  if (!other.empty()) {
    const bool says_what_to_do = other.find(';') != std::string::npos;
    throw DataError(fmt::format("{}: not a snapshot: it is {}{}", path.string(), other,
                                says_what_to_do ? "" : fmt::format("; {}", what_is_expected)));
  }
  throw DataError(fmt::format("{}: not a known snapshot format (it starts with the bytes {}); {}",
                              path.string(), first_bytes(path), what_is_expected));
}

// The snapshots of a folder: files by the name that they share. Tables of text do not count:
// simulations write many that are no particles.
std::map<fs::path, std::vector<fs::path>> find_sets(const fs::path& folder) {
  std::map<fs::path, std::vector<fs::path>> sets;
  for (const fs::directory_entry& entry : fs::directory_iterator(folder)) {
    std::error_code ignored;  // a link to itself is none
    if (!entry.is_regular_file(ignored)) continue;
    const SnapshotFormat* const format = find_format(entry.path());
    if (format == nullptr || format == &text_table_format()) continue;
    const auto member = parse_member_name(entry.path());
    // The ending keeps snapshot.0 and snapshot.0.hdf5 apart.
    const fs::path key =
        member ? fs::path(member->base.string() + ".*" + member->ending) : entry.path();
    sets[key].push_back(entry.path());
  }
  for (auto& [key, files] : sets)
    std::sort(files.begin(), files.end());
  return sets;
}

// Of a snapshot beside it.
void leave_out_maps(std::map<fs::path, std::vector<fs::path>>& sets) {
  for (auto set = sets.begin(); set != sets.end() && sets.size() > 1;) {
    const fs::path& file = set->second.front();
    const SnapshotFormat* const format = find_format(file);
    set = format != nullptr && format->is_map(file) ? sets.erase(set) : std::next(set);
  }
}

std::unique_ptr<Snapshot> open_folder(const fs::path& folder, const SnapshotOptions& options) {
  auto sets = find_sets(folder);
  leave_out_maps(sets);
  if (sets.empty()) {
    throw DataError(fmt::format("{}: no snapshot in this folder; give the path of a snapshot file",
                                folder.string()));
  }
  if (sets.size() > 1) {
    throw DataError(fmt::format(
        "{}: the folder holds {} snapshots ({}, {}{}); give the path of one of them",
        folder.string(), sets.size(), sets.begin()->first.filename().string(),
        std::next(sets.begin())->first.filename().string(), sets.size() > 2 ? ", ..." : ""));
  }
  const std::vector<fs::path>& files = sets.begin()->second;
  auto snapshot = open_file(files.front(), options);
  if (snapshot->info().files.size() != files.size()) {
    throw DataError(fmt::format(
        "{}: the folder holds {} files named {}, but the header of {} says that it belongs to a "
        "snapshot of {}; give the path of one file",
        folder.string(), files.size(), sets.begin()->first.filename().string(),
        files.front().filename().string(), snapshot->info().files.size()));
  }
  return snapshot;
}

}  // namespace

std::vector<const SnapshotFormat*> snapshot_formats() {
  return {&gadget_binary_format(), &hdf5_formats(), &numpy_format(), &tipsy_format(),
          &text_table_format()};
}

const char* find_other_kind(const fs::path& path) {
  const auto file = MappedFile::open(path);
  const std::string_view content = content_of(*file);
  if (const char* const familiar = find_familiar(content)) return familiar;
  const std::string_view start = content.substr(0, 4096);
  if (start.find("<VOTABLE") != std::string_view::npos)
    return "a VOTable; write it as ECSV or HDF5, as with astropy's Table.write";
  if (start.find("\\begin{table") != std::string_view::npos)
    return "a LaTeX table; write it as CSV or ECSV, as with astropy's Table.write";
  return nullptr;
}

const SnapshotFormat* find_format(const fs::path& path) {
  const auto file = MappedFile::open(path);
  for (const SnapshotFormat* const format : snapshot_formats()) {
    // Binary files may have three numbers before their first line ends.
    if (format == &text_table_format() && find_familiar(content_of(*file)) != nullptr) continue;
    if (format->recognizes(file)) return format;
  }
  return nullptr;
}

std::unique_ptr<Snapshot> open_snapshot(const fs::path& path, const SnapshotOptions& options) try {
  if (fs::is_directory(path)) return with_named_units(open_folder(path, options), options.units);
  const bool is_there = fs::exists(path) || path_in_file(path);
  return with_named_units(open_file(is_there ? path : find_by_base_name(path), options),
                          options.units);
} catch (const fs::filesystem_error& error) {
  throw DataError(fmt::format("{}: cannot be read: {}; check the path and its permissions",
                              path.string(), error.code().message()));
}

std::unique_ptr<Snapshot> open_snapshot_for(const std::filesystem::path& path,
                                            const ReadSettings& read) {
  std::unique_ptr<Snapshot> whole =
      open_snapshot(path, SnapshotOptions{read.columns, read.skip_lines, read.units});
  if (read.every == 1 && !read.max_particles) return whole;
  return std::make_unique<SubsetSnapshot>(std::move(whole), read);
}

}  // namespace splotchcl
