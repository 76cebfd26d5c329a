#include "formats/text/halo_spheres.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <string>
#include <string_view>
#include <vector>

#include "common/mapped_file.h"
#include "common/words.h"
#include "formats/text/table_header.h"
#include "formats/text/text_cells.h"
#include "formats/text/text_lines.h"
#include "splotchcl/error.h"

namespace splotchcl {
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
