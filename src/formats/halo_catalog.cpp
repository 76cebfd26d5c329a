#include "formats/halo_catalog.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <numeric>
#include <string>
#include <utility>
#include <vector>

#include "common/mapped_file.h"
#include "formats/hdf5/hdf5_column.h"
#include "formats/hdf5/hdf5_file.h"
#include "snapshot/snapshot_files.h"
#include "splotchcl/error.h"

namespace splotchcl {
namespace {

// Catalogs beside a snapshot, by the names that codes give them.

namespace fs = std::filesystem;

bool is_file(const fs::path& path) {
  std::error_code ignored;
  return fs::is_regular_file(path, ignored);
}

bool are_digits(const std::string& text) {
  return !text.empty() && text.find_first_not_of("0123456789") == std::string::npos;
}

// "033" of snapshot_033, snapshot_033_z003 and snapdir_033/snap_033.0.hdf5; empty where it has
// none.
std::string number_of(const fs::path& snapshot) {
  std::string name = snapshot.filename().string();
  name.resize(std::min(name.find('.'), name.size()));
  for (std::size_t line = name.rfind('_'); line != std::string::npos; line = name.rfind('_')) {
    const std::string last = name.substr(line + 1);
    if (are_digits(last)) return last;
    name.resize(line);
  }
  return {};
}

// Gadget-4, AREPO, and what people call their files; SOAP's members.
fs::path catalog_in(const fs::path& place, const std::string& number) {
  for (const char* const stem : {"fof_subhalo_tab_", "fof_tab_", "groups_", "membership_"}) {
    for (const char* const ending : {".hdf5", ".0.hdf5", ".h5"}) {
      fs::path catalog = place / (stem + number + ending);
      if (is_file(catalog)) return catalog;
    }
  }
  return {};
}

// Rockstar's, which counts snapshots with and without zeros before: particles before lists.
fs::path rockstar_in(const fs::path& place, const std::string& number) {
  const std::size_t digits = std::min(number.find_first_not_of('0'), number.size() - 1);
  for (const std::string& own : {number, number.substr(digits)}) {
    for (const std::string& name :
         {"halos_" + own + ".0.particles", "halos_" + own + ".particles", "out_" + own + ".list"}) {
      if (is_file(place / name)) return place / name;
    }
  }
  return {};
}

// snapshot_033.AHF_particles, snapshot_033.z0.000.AHF_halos: the only one of a snapshot.
fs::path ahf_beside(const fs::path& snapshot, const std::string& ending) {
  std::string start = snapshot.filename().string();
  start.resize(std::min(start.find('.'), start.size()));
  fs::path found;
  std::error_code error;
  const fs::path folder = snapshot.has_parent_path() ? snapshot.parent_path() : fs::path(".");
  for (fs::directory_iterator entry(folder, error), end; !error && entry != end;
       entry.increment(error)) {
    const std::string name = entry->path().filename().string();
    const bool is_one = name.size() >= start.size() + ending.size() &&
                        name.compare(0, start.size() + 1, start + ".") == 0 &&
                        name.compare(name.size() - ending.size(), ending.size(), ending) == 0;
    if (!is_one) continue;
    if (!found.empty()) return {};
    found = snapshot.parent_path() / name;
  }
  return found;
}

}  // namespace

std::optional<fs::path> find_halo_catalog(const fs::path& snapshot) {
  const std::string number = number_of(snapshot);
  const fs::path folder = snapshot.parent_path();
  if (!number.empty()) {
    for (const fs::path& place :
         {folder, folder / ("groups_" + number), folder / ".." / ("groups_" + number),
          folder / ("membership_" + number), folder / "SOAP", folder / ".." / "SOAP",
          folder / "SOAP" / ("membership_" + number)}) {
      fs::path catalog = catalog_in(place, number);
      if (!catalog.empty() && catalog != snapshot) return catalog;
    }
  }
  for (const char* const ending : {".AHF_particles", ".AHF_halos"}) {
    fs::path list = ahf_beside(snapshot, ending);
    if (!list.empty()) return list;
  }
  if (number.empty()) return std::nullopt;
  for (const char* const place : {"", "rockstar", "rockstar_halos", "halos"}) {
    fs::path list = rockstar_in(folder / place, number);
    if (!list.empty() && list != snapshot) return list;
  }
  return std::nullopt;
}

namespace {

using ParticleNumbers = std::vector<std::uint64_t>;

constexpr const char* lengths_by_type = "/Group/GroupLenType";
constexpr const char* offsets_by_type = "/Group/GroupOffsetType";

[[noreturn]] void refuse_number(const fs::path& path, std::uint64_t number, std::uint64_t first,
                                std::uint64_t haloes) {
  throw DataError(haloes == 0 ? fmt::format("{}: the catalog has no haloes", path.string())
                              : fmt::format("{}: no halo {}, expected a number from {} to {}",
                                            path.string(), number, first, first + haloes - 1));
}

// One value per row. Throws DataError where the dataset is anything else.
ParticleNumbers read_numbers(const Hdf5File& file, const std::string& dataset) {
  auto numbers =
      file.has(dataset) ? read_integers({{file.path(), file.dataset(dataset)}}) : std::nullopt;
  if (numbers) return std::move(*numbers);
  throw DataError(fmt::format("{}: no dataset {} of whole numbers, as was expected",
                              file.path().string(), dataset));
}

// A table of haloes by types of particles.
struct TypeTable {
  std::uint64_t haloes = 0;
  std::uint64_t types = 0;
  ParticleNumbers numbers;

  std::uint64_t at(std::uint64_t halo, int type) const {
    const auto column = static_cast<std::uint64_t>(type);
    return column < types ? numbers[halo * types + column] : 0;
  }
};

// Files without haloes may be without the dataset, too.
TypeTable read_type_table(const Hdf5File& file, const char* path) {
  TypeTable table;
  if (!file.has(path)) return table;
  const Hdf5Dataset dataset = file.dataset(path);
  if (dataset.shape.size() != 2 || dataset.kind != Hdf5Dataset::Kind::integer) {
    throw DataError(
        fmt::format("{}: {} is no table of whole numbers for each halo and type; the "
                    "catalog is damaged or of an unknown dialect",
                    file.path().string(), path));
  }
  file.check_complete(dataset);
  table.haloes = dataset.rows();
  table.types = dataset.values_per_row();
  table.numbers.resize(table.haloes * table.types);
  if (!table.numbers.empty()) {
    file.read_rows(dataset, 0, dataset.rows(), table.numbers.data());
  }
  return table;
}

// Numbers of particles; offsets may be below 0 where a halo has none.
TypeTable read_lengths(const Hdf5File& file, const char* path) {
  TypeTable table = read_type_table(file, path);
  for (std::size_t i = 0; i < table.numbers.size(); ++i) {
    const auto number = static_cast<std::int64_t>(table.numbers[i]);
    if (number >= 0) continue;
    throw DataError(fmt::format(
        "{}: {} holds {} for halo {}, expected 0 or more; the catalog is damaged, or was written "
        "with numbers of too few bits",
        file.path().string(), path, number, i / table.types));
  }
  return table;
}

int files_of(const Hdf5File& file) {
  for (const char* name : {"NumFiles", "NumFilesPerSnapshot"}) {
    const double files = file.number("Header", name).value_or(0);
    if (files >= 1 && files <= 1e6) return static_cast<int>(files);
  }
  return 1;
}

// SUBFIND and FOF: the particles of a type lie halo after halo.
HaloMembers read_by_lengths(const fs::path& path, std::uint64_t number, int type) {
  std::uint64_t offset = 0, haloes = 0;
  for (const fs::path& member : find_members(path, files_of(Hdf5File(path)))) {
    const Hdf5File file(member);
    const TypeTable lengths = read_lengths(file, lengths_by_type);
    if (number >= haloes + lengths.haloes) {
      for (std::uint64_t halo = 0; halo < lengths.haloes; ++halo)
        offset += lengths.at(halo, type);
      haloes += lengths.haloes;
      continue;
    }
    const std::uint64_t row = number - haloes;
    for (std::uint64_t halo = 0; halo < row; ++halo)
      offset += lengths.at(halo, type);
    const TypeTable offsets = read_type_table(file, offsets_by_type);
    if (offsets.haloes == lengths.haloes) offset = offsets.at(row, type);
    HaloMembers members;
    members.places.push_back({offset, lengths.at(row, type)});
    return members;
  }
  refuse_number(path, number, 0, haloes);
}

// SOAP's files do not say how many they are.
std::vector<fs::path> membership_files(const fs::path& path) {
  const int files = files_of(Hdf5File(path));
  return files > 1 ? find_members(path, files) : find_siblings(path);
}

// SOAP: the number of each particle's halo, in the snapshot's order.
HaloMembers read_by_membership(const fs::path& path, std::uint64_t number, int type,
                               const std::string& label) {
  HaloMembers members;
  std::uint64_t place = 0;
  for (const fs::path& member : membership_files(path)) {
    const Hdf5File file(member);
    const std::string dataset = fmt::format("/PartType{}/{}", type, label);
    if (!file.has(dataset)) continue;
    for (const std::uint64_t halo : read_numbers(file, dataset)) {
      if (halo == number) {
        const bool goes_on = !members.places.empty() &&
                             members.places.back().first + members.places.back().count == place;
        if (goes_on) {
          ++members.places.back().count;
        } else {
          members.places.push_back({place, 1});
        }
      }
      ++place;
    }
  }
  return members;
}

// The identifiers of one halo: those from its offset to the next one's.
void append_ids(const fs::path& groups, const fs::path& particles, const char* offsets_name,
                std::uint64_t row, ParticleNumbers& ids) {
  const ParticleNumbers offsets = read_numbers(Hdf5File(groups), offsets_name);
  const ParticleNumbers all = read_numbers(Hdf5File(particles), "Particle_IDs");
  const std::uint64_t first = row < offsets.size() ? offsets[row] : all.size();
  const std::uint64_t end = row + 1 < offsets.size() ? offsets[row + 1] : all.size();
  if (first > end || end > all.size()) {
    throw DataError(fmt::format(
        "{}: halo {} has particles {} to {}, but {} has {}; the catalog is damaged, or its files "
        "belong to different ones",
        groups.string(), row + 1, first, end, particles.filename().string(), all.size()));
  }
  ids.insert(ids.end(), all.begin() + static_cast<std::ptrdiff_t>(first),
             all.begin() + static_cast<std::ptrdiff_t>(end));
}

// VELOCIraptor: bound and unbound particles by their identifiers.
HaloMembers read_by_ids(const fs::path& groups, std::uint64_t number) {
  const std::string mark = "catalog_groups", name = groups.filename().string();
  const std::size_t at = name.rfind(mark);
  const auto beside = [&](const std::string& kind) {
    return groups.parent_path() / (name.substr(0, at) + kind + name.substr(at + mark.size()));
  };
  if (at == std::string::npos || !fs::is_regular_file(beside("catalog_particles"))) {
    throw DataError(fmt::format(
        "{}: the catalog_particles of this catalog_groups are not beside it, expected both with "
        "the names that VELOCIraptor gave them",
        groups.string()));
  }
  const Hdf5File file(groups);
  const ParticleNumbers sizes = read_numbers(file, "Group_Size");
  if (number < 1 || number > sizes.size()) refuse_number(groups, number, 1, sizes.size());
  ParticleNumbers ids;
  append_ids(groups, beside("catalog_particles"), "Offset", number - 1, ids);
  const fs::path unbound = beside("catalog_particles.unbound");
  if (fs::is_regular_file(unbound)) append_ids(groups, unbound, "Offset_unbound", number - 1, ids);
  std::sort(ids.begin(), ids.end());
  return {{}, std::move(ids), {}};
}

bool is_hdf5(const fs::path& path) {
  const auto file = MappedFile::open(path);
  return Hdf5File::has_signature(file->data(), file->size());
}

// SOAP's properties of haloes say nothing of their particles; what does may lie beside them.
std::optional<fs::path> membership_beside(const fs::path& properties) {
  const std::string mark = "halo_properties_", name = properties.filename().string();
  const std::size_t at = name.rfind(mark);
  if (at == std::string::npos) return std::nullopt;
  const std::string rest = name.substr(at + mark.size());
  const std::string number = rest.substr(0, rest.find('.'));
  const fs::path folder = properties.parent_path();
  for (const fs::path& place :
       {folder, folder / ("membership_" + number), folder / ".." / ("membership_" + number)}) {
    for (const char* const ending : {".hdf5", ".0.hdf5"}) {
      const fs::path membership = place / ("membership_" + number + ending);
      std::error_code ignored;
      if (fs::is_regular_file(membership, ignored)) return membership;
    }
  }
  return std::nullopt;
}

// By its particles where they are listed.
HaloMembers read_halo_text(const fs::path& path, std::uint64_t number) {
  if (has_halo_list(path)) return {{}, read_halo_list(path, number), {}};
  if (auto sphere = read_halo_sphere(path, number)) return {{}, {}, std::move(sphere)};
  throw DataError(fmt::format(
      "{}: no halo {} in a list that Rockstar (out_*.list, .ascii, .particles) or AHF (AHF_halos, "
      "AHF_particles) wrote, expected one of its identifiers, or a catalog in HDF5; select.ids "
      "takes lists of particles' identifiers",
      path.string(), number));
}

// SUBFIND: a halo's particles are those of its subhaloes, one after the other, then those of none.
class Subhaloes {
 public:
  Subhaloes(const fs::path& path, int type)
      : path_(path), members_(find_members(path, files_of(Hdf5File(path)))) {
    for (const fs::path& member : members_) {
      const Hdf5File file(member);
      append(read_lengths(file, lengths_by_type), type, group_lengths_);
      append(read_lengths(file, "/Subhalo/SubhaloLenType"), type, lengths_);
      const char* const owner =
          file.has("/Subhalo/SubhaloGroupNr") ? "/Subhalo/SubhaloGroupNr" : "/Subhalo/SubhaloGrNr";
      if (!file.has(owner)) continue;
      const ParticleNumbers owners = read_numbers(file, owner);
      owners_.insert(owners_.end(), owners.begin(), owners.end());
    }
    if (owners_.size() != lengths_.size()) {
      throw DataError(fmt::format(
          "{}: {} subhaloes have a halo and {} have lengths by type, expected as many; the catalog "
          "is damaged or of an unknown dialect",
          path.string(), owners_.size(), lengths_.size()));
    }
  }

  PlaceRange places_of(std::uint64_t number) const {
    if (number >= lengths_.size()) refuse_number(path_, number, 0, lengths_.size());
    const std::uint64_t owner = owners_[number];
    PlaceRange range;
    for (std::uint64_t halo = 0; halo < std::min<std::uint64_t>(owner, group_lengths_.size());
         ++halo)
      range.first += group_lengths_[halo];
    for (std::uint64_t before = 0; before < number; ++before)
      range.first += owners_[before] == owner ? lengths_[before] : 0;
    range.count = lengths_[number];
    return range;
  }

 private:
  static void append(const TypeTable& table, int type, ParticleNumbers& lengths) {
    for (std::uint64_t row = 0; row < table.haloes; ++row)
      lengths.push_back(table.at(row, type));
  }

  const fs::path& path_;
  std::vector<fs::path> members_;
  ParticleNumbers group_lengths_, lengths_, owners_;
};

HaloMembers read_in_group(const PathInFile& path, std::uint64_t number, int type) {
  if (path.group != "Subhalo") {
    throw DataError(fmt::format(
        "{}: found the group {}, expected the catalog alone for haloes, or {}/Subhalo for the "
        "subhaloes of SUBFIND",
        path.file.string(), path.group, path.file.string()));
  }
  HaloMembers members;
  members.places.push_back(Subhaloes(path.file, type).places_of(number));
  return members;
}

}  // namespace

bool HaloMembers::has_place(std::uint64_t place) const {
  const auto after = std::upper_bound(
      places.begin(), places.end(), place,
      [](std::uint64_t wanted, const PlaceRange& range) { return wanted < range.first; });
  return after != places.begin() && place - std::prev(after)->first < std::prev(after)->count;
}

HaloMembers read_halo(const fs::path& path, std::uint64_t number, int type) {
  if (const auto within = path_in_file(path)) return read_in_group(*within, number, type);
  if (!is_hdf5(path)) return read_halo_text(path, number);
  const Hdf5File file(path);
  if (file.has(lengths_by_type) || file.number("Header", "Ngroups_Total")) {
    return read_by_lengths(path, number, type);
  }
  if (file.has("/Group_Size") && file.has("/Offset")) return read_by_ids(path, number);
  for (const std::string& group : file.groups("/")) {
    for (const char* label : {"GroupNr_bound", "FOFGroupIDs", "GroupNr_all"}) {
      if (file.has("/" + group + "/" + label)) {
        return read_by_membership(path, number, type, label);
      }
    }
  }
  if (const auto membership = membership_beside(path)) return read_halo(*membership, number, type);
  throw DataError(fmt::format(
      "{}: found no Group/GroupLenType (SUBFIND, FOF), PartType0/GroupNr_bound (SOAP's "
      "membership files) nor "
      "Group_Size with Offset (VELOCIraptor), expected a catalog that says which particles a halo "
      "has",
      path.string()));
}

}  // namespace splotchcl
