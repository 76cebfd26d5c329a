#include "palette/palette_file.h"

#include <fmt/format.h>

#include <algorithm>
#include <charconv>
#include <cstddef>
#include <string_view>
#include <vector>

#include "palette/other_palettes.h"
#include "palette/palette_lines.h"
#include "palette/text_palette.h"
#include "splotchcl/error.h"

namespace splotchcl {
namespace {

constexpr std::string_view original_mark = "0100";
using Lines = std::vector<PaletteLine>;

bool is_original(const Lines& lines) {
  return lines.size() >= 2 && lines[1].text == original_mark;
}

std::size_t read_knot_count(const Lines& lines, const std::string& name) {
  std::size_t count = 0;
  if (lines.size() > 2) {
    const std::string_view text = lines[2].text;
    const auto result = std::from_chars(text.data(), text.data() + text.size(), count);
    if (result.ec == std::errc() && result.ptr == text.data() + text.size() && count > 0) {
      return count;
    }
  }
  refuse_palette(name, 3,
                 fmt::format("found \"{}\", expected the number of knots",
                             lines.size() > 2 ? shown(lines[2].text) : ""));
}

// A name, the mark, the number of knots, then as many lines of R G B from 0 to 255.
Palette read_original(const Lines& lines, const std::string& name) {
  const std::size_t count = read_knot_count(lines, name);
  Palette palette;
  palette.name = name;
  for (std::size_t i = 3; i < lines.size(); ++i) {
    if (lines[i].text.empty()) continue;
    palette.emission.push_back(read_bytes_of_color(lines[i], name));
  }
  if (palette.emission.size() != count) {
    throw DataError(fmt::format("{}: found {} knots, expected {} as its third line says", name,
                                palette.emission.size(), count));
  }
  return palette;
}

}  // namespace

bool is_palette_path(const std::string& name) {
  return name.find_first_of("/.") != std::string::npos;
}

Palette parse_palette(const std::string& text, const std::string& name_for_messages) {
  const std::string& name = name_for_messages;
  if (auto palette = read_numpy_palette(text, name)) return std::move(*palette);
  if (auto palette = read_byte_palette(text, name)) return std::move(*palette);
  if (auto palette = read_paraview_palette(text, name)) return std::move(*palette);
  if (auto palette = read_sao_palette(text, name)) return std::move(*palette);
  const Lines lines = palette_lines(text);
  if (is_original(lines)) return read_original(lines, name);
  if (auto palette = read_gmt_palette(lines, name)) return std::move(*palette);
  return read_text_palette(lines, name);
}

std::string palette_description(const std::string& text, const std::string& name) {
  const Lines lines = palette_lines(text);
  if (lines.empty()) return "";
  std::string_view first = lines.front().text;
  if (!is_original(lines)) {
    if (first.empty() || first.front() != '#') return "";
    first = without_spaces(first.substr(1));
  }
  const std::string label = name + ":";
  if (first.substr(0, label.size()) == label) first = without_spaces(first.substr(label.size()));
  const bool is_text = std::none_of(first.begin(), first.end(), [](char c) {
    return static_cast<unsigned char>(c) < ' ' && c != '\t';
  });
  return is_text ? std::string(first) : "";
}

}  // namespace splotchcl
