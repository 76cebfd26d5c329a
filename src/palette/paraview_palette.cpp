#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <nlohmann/json.hpp>

#include "common/words.h"
#include "palette/diverging_colors.h"
#include "palette/lab_colors.h"
#include "palette/other_palettes.h"
#include "palette/placed_colors.h"
#include "splotchcl/error.h"

namespace splotchcl {
namespace {

// Between few colors other spaces than RGB have other ones.
constexpr std::size_t enough_colors = 16;

std::vector<PlacedColor> joined_in(const std::string& space, std::vector<PlacedColor> colors,
                                   const std::string& name) {
  const std::string lower = lower_case(space);
  if (lower == "lab" || lower == "cielab") return joined_in_lab(colors);
  if (lower == "diverging") return joined_over_white(colors);
  if (colors.size() >= enough_colors || lower.empty() || lower == "rgb") return colors;
  throw DataError(
      fmt::format("{}: found {} colors to be joined in the space {}, expected RGB, Lab, Diverging, "
                  "or {} colors at least; export it from ParaView in RGB",
                  name, colors.size(), shown(space), enough_colors));
}

Palette make_palette(std::vector<PlacedColor> colors, const std::string& space,
                     const std::string& name) {
  for (const PlacedColor& color : colors) {
    const bool is_color = std::all_of(color.color.begin(), color.color.end(),
                                      [](float light) { return light >= 0 && light <= 1; });
    if (std::isfinite(color.place) && is_color) continue;
    throw DataError(fmt::format(
        "{}: found a color or place beyond limits, expected numbers from 0 to 1 for colors", name));
  }
  const auto is_before = [](const PlacedColor& a, const PlacedColor& b) {
    return a.place < b.place;
  };
  std::stable_sort(colors.begin(), colors.end(), is_before);
  if (colors.empty()) {
    throw DataError(fmt::format("{}: found a color map without colors, expected some", name));
  }
  Palette palette;
  palette.name = name;
  palette.emission = even_knots(joined_in(space, std::move(colors), name));
  return palette;
}

[[noreturn]] void refuse_json(const std::string& name) {
  throw DataError(fmt::format(
      "{}: found JSON that is no color map of ParaView, expected RGBPoints of a place, red, green "
      "and blue each",
      name));
}

Palette read_json(const std::string& text, const std::string& name) {
  const nlohmann::json root = nlohmann::json::parse(text, nullptr, false);
  const nlohmann::json map = root.is_array() && !root.empty() ? root.front() : root;
  if (!map.is_object() || !map.contains("RGBPoints") || !map["RGBPoints"].is_array())
    refuse_json(name);
  const nlohmann::json& numbers = map["RGBPoints"];
  const bool are_numbers = std::all_of(numbers.begin(), numbers.end(),
                                       [](const nlohmann::json& n) { return n.is_number(); });
  if (!are_numbers || numbers.size() % 4 != 0) refuse_json(name);
  std::vector<PlacedColor> colors;
  for (std::size_t i = 0; i < numbers.size(); i += 4) {
    colors.push_back(
        {numbers[i].get<double>(),
         {numbers[i + 1].get<float>(), numbers[i + 2].get<float>(), numbers[i + 3].get<float>()}});
  }
  const bool says_space = map.contains("ColorSpace") && map["ColorSpace"].is_string();
  return make_palette(std::move(colors), says_space ? map["ColorSpace"].get<std::string>() : "",
                      name);
}

// name="value" of a tag.
std::map<std::string, std::string> attributes_of(const std::string& tag) {
  std::map<std::string, std::string> attributes;
  std::size_t at = tag.find('=');
  for (; at != std::string::npos; at = tag.find('=', at)) {
    const std::size_t begin = tag.find_last_of(" \t\r\n", at);
    const std::size_t open = at + 1;
    if (begin == std::string::npos || open >= tag.size()) break;
    const std::size_t close = tag.find(tag[open], open + 1);
    if (close == std::string::npos) break;
    attributes[trimmed(tag.substr(begin, at - begin))] = tag.substr(open + 1, close - open - 1);
    at = close;
  }
  return attributes;
}

std::optional<PlacedColor> read_point(const std::string& tag) {
  const auto attributes = attributes_of(tag);
  std::array<double, 4> values{};
  constexpr std::array<const char*, 4> names = {"x", "r", "g", "b"};
  for (std::size_t i = 0; i < names.size(); ++i) {
    const auto found = attributes.find(names[i]);
    const auto number = found == attributes.end() ? std::nullopt : parse_number(found->second);
    if (!number) return std::nullopt;
    values[i] = *number;
  }
  return PlacedColor{values[0],
                     {static_cast<float>(values[1]), static_cast<float>(values[2]),
                      static_cast<float>(values[3])}};
}

Palette read_xml(const std::string& text, std::size_t map, const std::string& name) {
  const std::size_t end = std::min(text.find("</ColorMap>", map), text.size());
  const auto of_map = attributes_of(text.substr(map, text.find('>', map) - map));
  std::vector<PlacedColor> colors;
  for (std::size_t tag = text.find("<Point", map); tag < end; tag = text.find("<Point", tag + 1)) {
    const auto point = read_point(text.substr(tag, text.find_first_of("/>", tag) - tag));
    if (!point) {
      throw DataError(fmt::format(
          "{}: found a Point without numbers x, r, g and b, expected them in each", name));
    }
    colors.push_back(*point);
  }
  const auto space = of_map.find("space");
  return make_palette(std::move(colors), space == of_map.end() ? "" : space->second, name);
}

}  // namespace

std::optional<Palette> read_paraview_palette(const std::string& text, const std::string& name) {
  const std::size_t start = text.find_first_not_of(" \t\r\n");
  if (start == std::string::npos) return std::nullopt;
  if (text[start] == '{' || text[start] == '[') return read_json(text, name);
  if (text[start] != '<') return std::nullopt;
  for (const char* const tag : {"<ColorMap ", "<ColorMap\n", "<ColorMap>"}) {
    const std::size_t map = text.find(tag);
    if (map != std::string::npos) return read_xml(text, map, name);
  }
  throw DataError(
      fmt::format("{}: found XML without a ColorMap, expected one, as of ParaView", name));
}

}  // namespace splotchcl
