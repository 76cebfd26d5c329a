// Catalogs beside a snapshot, by the names that codes give them.
#include <algorithm>
#include <array>
#include <string>
#include <vector>

#include "formats/halo_catalog.h"

namespace splotchcl {
namespace {

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

}  // namespace splotchcl
