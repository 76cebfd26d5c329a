#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "common/mapped_file.h"
#include "common/words.h"
#include "formats/halo_catalog.h"
#include "formats/text/table_header.h"
#include "formats/text/text_cells.h"
#include "snapshot/snapshot_files.h"
#include "splotchcl/error.h"

namespace splotchcl {
namespace {

namespace fs = std::filesystem;
using HaloIds = std::vector<std::uint64_t>;
using WordsOfLine = std::vector<std::string_view>;

[[noreturn]] void refuse_line(const fs::path& path, const TextLines& lines,
                              const std::string& expected) {
  throw DataError(
      fmt::format("{}: line {}: found \"{}\", expected {}; the file is truncated or "
                  "damaged: copy or write it again",
                  path.string(), lines.number(), lines.line().substr(0, 40), expected));
}

void sort_once(HaloIds& ids) {
  std::sort(ids.begin(), ids.end());
  ids.erase(std::unique(ids.begin(), ids.end()), ids.end());
}

// The first column of AHF_halos, in the order of the haloes; none where it is not there.
HaloIds ids_of_ahf_halos(const fs::path& path) {
  HaloIds ids;
  std::error_code ignored;
  if (!fs::is_regular_file(path, ignored)) return ids;
  const auto file = MappedFile::open(path);
  for (TextLines lines(*file); lines.next();) {
    if (lines.line().front() == '#') continue;
    const WordsOfLine words = split_cells(lines.line(), ' ');
    const auto id = parse_whole_number(words.front());
    if (!id) refuse_line(path, lines, "a halo's identifier");
    ids.push_back(*id);
  }
  return ids;
}

// Goes through AHF_particles: the number of haloes, then for each how many particles it has, often
// with its identifier, and as many lines of a particle's identifier and type.
class AhfParticles {
 public:
  AhfParticles(const fs::path& path, const MappedFile& file) : path_(path), lines_(file) {
    if (!next() || words_.size() != 1) refuse_line(path_, lines_, "the number of haloes");
    haloes_ = number(0, "the number of haloes");
  }
  std::uint64_t haloes() const { return haloes_; }
  // Of the next halo; none where the file does not say.
  std::optional<std::uint64_t> begin_halo() {
    const char* const expected = "the number of a halo's particles";
    if (!next()) refuse_line(path_, lines_, expected);
    particles_ = number(0, expected);
    if (words_.size() < 2) return std::nullopt;
    return number(1, "a halo's identifier");
  }
  void skip_particles() {
    for (; particles_ > 0; --particles_) {
      if (!next_line()) refuse_line(path_, lines_, "a particle's identifier");
    }
  }
  void read_particles(HaloIds& ids) {
    for (; particles_ > 0; --particles_) {
      if (!next()) refuse_line(path_, lines_, "a particle's identifier");
      ids.push_back(number(0, "a particle's identifier"));
    }
  }

 private:
  bool next_line() {
    while (lines_.next()) {
      if (lines_.line().front() != '#') return true;
    }
    return false;
  }
  bool next() {
    if (!next_line()) return false;
    words_.clear();
    for (const std::string_view word : split_cells(lines_.line(), ' '))
      words_.push_back(word);
    return true;
  }
  std::uint64_t number(std::size_t word, const char* expected) const {
    const auto found = parse_whole_number(words_[word]);
    if (!found) refuse_line(path_, lines_, expected);
    return *found;
  }

  const fs::path& path_;
  TextLines lines_;
  WordsOfLine words_;
  std::uint64_t haloes_ = 0, particles_ = 0;
};

fs::path with_kind(const fs::path& path, const std::string& before, const std::string& after) {
  std::string name = path.filename().string();
  const std::size_t at = name.rfind(before);
  return path.parent_path() / name.replace(at, before.size(), after);
}

// Newer versions have identifiers beyond it, which nobody remembers: places count as well.
constexpr std::uint64_t largest_number = 2147483647;

HaloIds read_ahf(const fs::path& halos, const fs::path& particles, std::uint64_t number) {
  const auto file = MappedFile::open(particles);
  AhfParticles list(particles, *file);
  const HaloIds known = ids_of_ahf_halos(halos);
  for (std::uint64_t halo = 0; halo < list.haloes(); ++halo) {
    const std::uint64_t stated =
        list.begin_halo().value_or(halo < known.size() ? known[halo] : halo);
    const bool is_it = stated == number || (stated > largest_number && halo == number);
    if (!is_it) {
      list.skip_particles();
      continue;
    }
    HaloIds ids;
    list.read_particles(ids);
    sort_once(ids);
    return ids;
  }
  throw DataError(fmt::format("{}: no halo {} among its {}, expected a halo's identifier as in {}",
                              particles.string(), number, list.haloes(),
                              halos.filename().string()));
}

// Where columns of Rockstar's particles are, by the line that names them.
struct ParticleColumns {
  std::size_t id = 6, halo = 9;
};

void find_columns(std::string_view comment, ParticleColumns& columns) {
  const WordsOfLine words = split_cells(comment.substr(1), ' ');
  const auto id = std::find(words.begin(), words.end(), "particle_id");
  const auto halo = std::find(words.begin(), words.end(), "external_haloid");
  if (id == words.end() || halo == words.end()) return;
  columns.id = static_cast<std::size_t>(id - words.begin());
  columns.halo = static_cast<std::size_t>(halo - words.begin());
}

void append_rockstar(const fs::path& path, std::uint64_t number, HaloIds& ids) {
  const auto file = MappedFile::open(path);
  ParticleColumns columns;
  for (TextLines lines(*file); lines.next();) {
    if (lines.line().front() == '#') {
      find_columns(lines.line(), columns);
      continue;
    }
    const WordsOfLine words = split_cells(lines.line(), ' ');
    const bool is_row = words.size() > std::max(columns.id, columns.halo);
    const auto id = is_row ? parse_whole_number(words[columns.id]) : std::nullopt;
    if (!id) refuse_line(path, lines, "a particle with its identifier and that of its halo");
    // -1: of a halo that is in no list.
    if (parse_whole_number(words[columns.halo]) == number) ids.push_back(*id);
  }
}

// halos_33.0.particles, halos_33.1.particles, ... as far as they are there.
std::vector<fs::path> rockstar_files(const fs::path& path) {
  const std::string stem = path.stem().string();
  const std::size_t dot = stem.rfind('.');
  if (dot == std::string::npos || !parse_whole_number(stem.substr(dot + 1))) return {path};
  const std::vector<fs::path> files =
      numbered_files({path.parent_path() / stem.substr(0, dot), 0, path.extension().string()});
  return std::find(files.begin(), files.end(), path) == files.end() ? std::vector<fs::path>{path}
                                                                    : files;
}

HaloIds read_rockstar(const fs::path& path, std::uint64_t number) {
  HaloIds ids;
  for (const fs::path& file : rockstar_files(path))
    append_rockstar(file, number, ids);
  if (ids.empty()) {
    throw DataError(fmt::format(
        "{}: no particles of halo {}, expected a number that its column external_haloid has",
        path.string(), number));
  }
  sort_once(ids);
  return ids;
}

bool contains(const fs::path& path, const std::string& text) {
  return path.filename().string().find(text) != std::string::npos;
}

fs::path with_extension(fs::path path, const char* extension) {
  return path.replace_extension(extension);
}

}  // namespace

bool has_halo_list(const fs::path& path) {
  std::error_code ignored;
  if (contains(path, "AHF_particles") || path.extension() == ".particles") return true;
  if (contains(path, "AHF_halos"))
    return fs::is_regular_file(with_kind(path, "AHF_halos", "AHF_particles"), ignored);
  return path.extension() == ".ascii" &&
         fs::is_regular_file(with_extension(path, ".particles"), ignored);
}

HaloIds read_halo_list(const fs::path& path, std::uint64_t number) {
  if (contains(path, "AHF_particles"))
    return read_ahf(with_kind(path, "AHF_particles", "AHF_halos"), path, number);
  if (contains(path, "AHF_halos"))
    return read_ahf(path, with_kind(path, "AHF_halos", "AHF_particles"), number);
  return read_rockstar(with_extension(path, ".particles"), number);
}

namespace {

namespace fs = std::filesystem;

// Where a list has what a sphere is made of: identifier, axes, radius.
using SphereColumns = std::array<std::size_t, 5>;

// In Mpc/h, as Rockstar has positions and AHF nothing.
struct ListUnits {
  double position = 1, radius = 1e-3;
};

std::vector<std::string> words_of(std::string_view comment) {
  std::vector<std::string> words;
  for (const std::string_view word : split_cells(without_blanks(comment.substr(1)), ' '))
    words.emplace_back(word);
  return in_our_words(std::move(words));
}

std::optional<SphereColumns> find_sphere_columns(const std::vector<std::string>& names) {
  constexpr std::array<const char*, 5> wanted = {"id", "x", "y", "z", "rvir"};
  SphereColumns columns;
  for (std::size_t i = 0; i < wanted.size(); ++i) {
    const auto found = std::find_if(names.begin(), names.end(), [&](const std::string& name) {
      const std::string lower = lower_case(name);
      return lower == wanted[i] || (i == 4 && lower == "rhalo");
    });
    if (found == names.end()) return std::nullopt;
    columns[i] = static_cast<std::size_t>(found - names.begin());
  }
  return columns;
}

bool is_of_ahf(const fs::path& path) {
  return path.filename().string().find("AHF_halos") != std::string::npos;
}

[[noreturn]] void refuse_halo_line(const fs::path& path, const TextLines& lines) {
  throw DataError(
      fmt::format("{}: line {}: found \"{}\", expected a halo with its identifier, position and "
                  "radius; the file is truncated or damaged: copy or write it again",
                  path.string(), lines.number(), lines.line().substr(0, 40)));
}

HaloSphere sphere_in(const std::vector<std::string_view>& words, const SphereColumns& columns,
                     const ListUnits& units, const fs::path& path, const TextLines& lines) {
  std::array<double, 4> numbers;
  for (std::size_t i = 0; i < numbers.size(); ++i) {
    const auto number = parse_number(std::string(words[columns[i + 1]]));
    if (!number) refuse_halo_line(path, lines);
    numbers[i] = *number * (i < 3 ? units.position : units.radius);
  }
  return {{{numbers[0], numbers[1], numbers[2]}}, numbers[3], "Mpc/h a"};
}

}  // namespace

std::optional<HaloSphere> read_halo_sphere(const fs::path& path, std::uint64_t number) {
  const auto file = MappedFile::open(path);
  const ListUnits units = is_of_ahf(path) ? ListUnits{1e-3, 1e-3} : ListUnits{};
  std::optional<SphereColumns> columns;
  for (TextLines lines(*file); lines.next();) {
    if (lines.line().front() == '#') {
      if (!columns) columns = find_sphere_columns(words_of(lines.line()));
      continue;
    }
    if (!columns) return std::nullopt;
    const std::vector<std::string_view> words = split_cells(lines.line(), ' ');
    if (words.size() <= *std::max_element(columns->begin(), columns->end()))
      refuse_halo_line(path, lines);
    if (parse_whole_number(words[(*columns)[0]]) == number)
      return sphere_in(words, *columns, units, path, lines);
  }
  return std::nullopt;
}

}  // namespace splotchcl
