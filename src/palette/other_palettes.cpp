#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cctype>
#include <cmath>
#include <cstddef>
#include <vector>

#include "common/words.h"
#include "formats/numpy/numpy_array.h"
#include "palette/palette_file.h"
#include "splotchcl/error.h"

namespace splotchcl {
namespace {

bool is_color_of_ends(std::string_view word) {
  return word == "B" || word == "F" || word == "N";
}

// "0 0 0 255 1 255 255 255", and "0 0/0/255 1 255/255/255" of later versions.
std::vector<float> numbers_of(const PaletteLine& line, const std::string& name) {
  std::string text(line.text);
  std::replace(text.begin(), text.end(), '/', ' ');
  std::vector<float> numbers;
  for (const std::string_view word : palette_words(text)) {
    constexpr std::size_t all = 8;
    const auto number = palette_number(word);
    if (number) numbers.push_back(*number);
    if (numbers.size() == all) return numbers;  // a letter or a label may follow
    if (number) continue;
    refuse_palette(name, line.number,
                   fmt::format("found \"{}\", expected a value, red, green, blue, and these again",
                               shown(word)));
  }
  refuse_palette(name, line.number,
                 fmt::format("found {} numbers, expected 8: a value, red, green, blue, and these "
                             "again",
                             numbers.size()));
}

Rgb color_in(const std::vector<float>& numbers, std::size_t first, const PaletteLine& line,
             const std::string& name) {
  Rgb color;
  for (std::size_t c = 0; c < color.size(); ++c) {
    const float value = numbers[first + c];
    if (!(value >= 0 && value <= 255)) {
      refuse_palette(name, line.number,
                     fmt::format("found {} for a color, expected numbers from 0 to 255", value));
    }
    color[c] = value / 255;
  }
  return color;
}

// Of comments: # COLOR_MODEL = HSV.
void refuse_other_model(const std::vector<PaletteLine>& lines, const std::string& name) {
  for (const PaletteLine& line : lines) {
    const std::string text = lower_case(std::string(line.text));
    const bool is_other =
        text.find("color_model") != std::string::npos && text.find("rgb") == std::string::npos;
    if (!is_other) continue;
    refuse_palette(name, line.number,
                   fmt::format("found \"{}\", expected COLOR_MODEL = RGB", shown(line.text)));
  }
}

bool ends_as_gmt(const std::string& name) {
  return lower_ending(name) == ".cpt";
}

}  // namespace

std::optional<Palette> read_gmt_palette(const std::vector<PaletteLine>& lines,
                                        const std::string& name) {
  if (!ends_as_gmt(name)) return std::nullopt;
  refuse_other_model(lines, name);
  std::vector<PlacedColor> colors;
  for (const PaletteLine& line : lines) {
    const std::vector<std::string_view> words = palette_words(line.text);
    if (words.empty() || line.text.front() == '#' || is_color_of_ends(words.front())) continue;
    const std::vector<float> numbers = numbers_of(line, name);
    const bool goes_on = numbers[4] > numbers[0] &&
                         (colors.empty() || static_cast<double>(numbers[0]) >= colors.back().place);
    if (!goes_on) refuse_palette(name, line.number, "found values that fall, expected rising ones");
    colors.push_back({static_cast<double>(numbers[0]), color_in(numbers, 1, line, name)});
    colors.push_back({static_cast<double>(numbers[4]), color_in(numbers, 5, line, name)});
  }
  if (colors.empty()) {
    throw DataError(fmt::format("{}: found no colors, expected lines of 8 numbers", name));
  }
  // Where one part ends as the next begins.
  const auto is_same = [](const PlacedColor& a, const PlacedColor& b) {
    return a.place == b.place && a.color == b.color;
  };
  colors.erase(std::unique(colors.begin(), colors.end(), is_same), colors.end());
  Palette palette;
  palette.name = name;
  palette.emission = even_knots(colors);
  return palette;
}

namespace {

struct Level {
  double place = 0, light = 0;
};

// "(0,0)(.5,1)" up to the next word.
std::vector<Level> levels_after(const std::string& text, std::size_t begin,
                                const std::string& name) {
  std::vector<Level> levels;
  while (begin < text.size()) {
    begin = text.find_first_not_of(" \t\r\n", begin);
    if (begin == std::string::npos || text[begin] != '(') break;
    const std::size_t close = std::min(text.find(')', begin), text.size());
    const std::string inside = text.substr(begin + 1, close - begin - 1);
    const std::vector<std::string_view> words = palette_words(inside);
    const auto place = words.size() == 2 ? palette_number(words[0]) : std::nullopt;
    const auto light = words.size() == 2 ? palette_number(words[1]) : std::nullopt;
    const bool goes_on = place && light && *place >= 0 && *place <= 1 && *light >= 0 &&
                         *light <= 1 &&
                         (levels.empty() || static_cast<double>(*place) >= levels.back().place);
    if (!goes_on) {
      throw DataError(
          fmt::format("{}: found ({}), expected a place and a light from 0 to 1, at rising places",
                      name, shown(inside)));
    }
    levels.push_back({static_cast<double>(*place), static_cast<double>(*light)});
    begin = close + 1;
  }
  return levels;
}

float light_at(const std::vector<Level>& levels, double place) {
  const auto after =
      std::upper_bound(levels.begin(), levels.end(), place,
                       [](double wanted, const Level& level) { return wanted < level.place; });
  if (after == levels.begin()) return static_cast<float>(levels.front().light);
  const Level& before = *std::prev(after);
  if (after == levels.end()) return static_cast<float>(before.light);
  const double part = (place - before.place) / (after->place - before.place);
  return static_cast<float>(before.light + part * (after->light - before.light));
}

}  // namespace

std::optional<Palette> read_sao_palette(const std::string& text, const std::string& name) {
  if (text.find("PSEUDOCOLOR") == std::string::npos) return std::nullopt;
  std::array<std::vector<Level>, 3> levels;
  constexpr std::array<const char*, 3> words = {"RED:", "GREEN:", "BLUE:"};
  for (std::size_t c = 0; c < words.size(); ++c) {
    const std::string word = words[c];
    const std::size_t at = text.find(word);
    if (at != std::string::npos) levels[c] = levels_after(text, at + word.size(), name);
    if (levels[c].empty()) {
      throw DataError(fmt::format("{}: found no levels after {}, expected some", name, word));
    }
  }
  constexpr std::size_t many = 1024;
  Palette palette;
  palette.name = name;
  for (std::size_t i = 0; i < many; ++i) {
    const double place = static_cast<double>(i) / static_cast<double>(many - 1);
    palette.emission.push_back(
        {light_at(levels[0], place), light_at(levels[1], place), light_at(levels[2], place)});
  }
  return palette;
}

namespace {

constexpr std::size_t colors = 256, table_bytes = 3 * colors;

bool has_ending(const std::string& name, const std::string& ending) {
  if (name.size() < ending.size()) return false;
  return std::equal(ending.rbegin(), ending.rend(), name.rbegin(), [](char a, char b) {
    return a == std::tolower(static_cast<unsigned char>(b));
  });
}

// Not what a table of colors as text has.
bool is_binary(const std::string& bytes) {
  return std::any_of(bytes.begin(), bytes.end(), [](char c) {
    const auto code = static_cast<unsigned char>(c);
    return code == 0x7f || (code < ' ' && (code < '\t' || code > '\r'));
  });
}

float light_of(char byte) {
  return static_cast<float>(static_cast<unsigned char>(byte)) / 255;
}

[[noreturn]] void refuse_bytes(const std::string& name, std::size_t size) {
  throw DataError(fmt::format(
      "{}: found {} bytes that are no text, expected lines of 3 or 6 numbers, or 256 colors as 768 "
      "bytes named .act or .lut; write it as text, or as an array of NumPy",
      name, size));
}

}  // namespace

std::optional<Palette> read_byte_palette(const std::string& bytes, const std::string& name) {
  const bool is_act = has_ending(name, ".act"), is_lut = has_ending(name, ".lut");
  // Behind Adobe's table there may be the number of its colors, before ImageJ's a header.
  constexpr std::size_t with_count = table_bytes + 4, lut_header = 32;
  const bool has_header = is_lut && bytes.size() == table_bytes + lut_header;
  const bool is_table = bytes.size() == table_bytes && (is_act || is_lut);
  const bool has_count = is_act && bytes.size() == with_count;
  if (!is_table && !has_count && !has_header) {
    if (is_binary(bytes)) refuse_bytes(name, bytes.size());
    return std::nullopt;
  }
  const std::size_t first = has_header ? lut_header : 0;
  const auto byte = [&bytes](std::size_t place) {
    return static_cast<unsigned char>(bytes[place]);
  };
  std::size_t count = has_count ? 256U * byte(table_bytes) + byte(table_bytes + 1) : colors;
  if (count == 0 || count > colors) count = colors;
  Palette palette;
  palette.name = name;
  for (std::size_t i = 0; i < count; ++i) {
    Rgb color;
    for (std::size_t c = 0; c < color.size(); ++c)
      color[c] = light_of(bytes[first + (is_act ? 3 * i + c : colors * c + i)]);
    palette.emission.push_back(color);
  }
  return palette;
}

namespace {

[[noreturn]] void refuse_array(const std::string& name, const std::string& found) {
  throw DataError(fmt::format(
      "{}: found {}, expected an array of at most {} rows of red, green and blue (and an "
      "opacity of 1), from 0 to 1, or whole numbers to 255",
      name, found, most_knots));
}

bool may_be_colors(const NumpyHeader& header) {
  return !header.is_structured && !header.is_pickled && header.members.front().is_usable &&
         header.shape.size() == 2 && (header.shape[1] == 3 || header.shape[1] == 4) &&
         header.shape[0] > 0 && header.shape[0] <= most_knots;
}

StoredValues values_of(const std::string& bytes, const NumpyHeader& header,
                       const std::string& name) {
  const auto* const first = reinterpret_cast<const std::byte*>(bytes.data());
  const NumpyMember& number = header.members.front();
  StoredValues values;
  values.file = MappedFile::of_bytes(name, {first, first + bytes.size()});
  values.offset = header.data_offset;
  values.particles = header.rows();
  values.values_per_particle = static_cast<int>(header.shape[1]);
  values.kind = number.kind;
  values.is_swapped = number.is_swapped;
  values.stride =
      header.is_fortran_order ? header.record_bytes : header.record_bytes * header.shape[1];
  values.axis_stride =
      header.is_fortran_order ? header.record_bytes * header.rows() : header.record_bytes;
  return values;
}

bool is_float(ValueKind kind) {
  return kind == ValueKind::float16 || kind == ValueKind::float32 || kind == ValueKind::float64;
}

// Whether colors are whole numbers up to 255, also where they are kept as floats.
bool are_bytes(const StoredValues& values) {
  bool is_any_large = !is_float(values.kind);
  for (std::uint64_t row = 0; row < values.particles; ++row) {
    for (int c = 0; c < values.values_per_particle; ++c) {
      const double value = value_at(values, row, c);
      if (value != std::floor(value)) return false;
      is_any_large = is_any_large || value > 1;
    }
  }
  return is_any_large;
}

}  // namespace

std::optional<Palette> read_numpy_palette(const std::string& bytes, const std::string& name) {
  const auto* const first = reinterpret_cast<const std::byte*>(bytes.data());
  if (!is_numpy_array(first, bytes.size())) return std::nullopt;
  const NumpyHeader header = read_numpy_header(first, bytes.size(), bytes.size(), name);
  if (!may_be_colors(header))
    refuse_array(name, fmt::format("an array of the shape {}", fmt::join(header.shape, " x ")));
  const StoredValues values = values_of(bytes, header, name);
  const double white = are_bytes(values) ? 255 : 1;
  Palette palette;
  palette.name = name;
  for (std::uint64_t row = 0; row < header.rows(); ++row) {
    Rgb color;
    for (int c = 0; c < values.values_per_particle; ++c) {
      const double light = value_at(values, row, c) / white;
      const bool is_opacity = c == 3;
      if (!(light >= 0 && light <= 1) || (is_opacity && light != 1))
        refuse_array(name, fmt::format("{} in row {}", light * white, row));
      if (!is_opacity) color[static_cast<std::size_t>(c)] = static_cast<float>(light);
    }
    palette.emission.push_back(color);
  }
  return palette;
}

}  // namespace splotchcl
