#include <fmt/format.h>

#include <algorithm>
#include <cctype>
#include <cstddef>

#include "palette/other_palettes.h"
#include "splotchcl/error.h"

namespace splotchcl {
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

}  // namespace splotchcl
