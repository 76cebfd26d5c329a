#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <functional>
#include <map>
#include <nlohmann/json.hpp>
#include <vector>

#include "common/words.h"
#include "palette/palette_file.h"
#include "splotchcl/error.h"

namespace splotchcl {
namespace {

using Three = std::array<double, 3>;

// The color at a part of the way from one to the next.
using Between = std::function<Rgb(const Rgb& before, const Rgb& after, double part)>;

// IEC 61966-2-1.
constexpr std::array<Three, 3> xyz_of_rgb = {{{0.4124564, 0.3575761, 0.1804375},
                                              {0.2126729, 0.7151522, 0.0721750},
                                              {0.0193339, 0.1191920, 0.9503041}}};
constexpr std::array<Three, 3> rgb_of_xyz = {{{3.2404542, -1.5371385, -0.4985314},
                                              {-0.9692660, 1.8760108, 0.0415560},
                                              {0.0556434, -0.2040259, 1.0572252}}};
constexpr Three white_point = {0.95047, 1, 1.08883};
// CIE 15: below it the cube root is a line.
constexpr double linear_end = 6.0 / 29;

Three times(const std::array<Three, 3>& matrix, const Three& v) {
  Three result = {0, 0, 0};
  for (std::size_t i = 0; i < 3; ++i) {
    for (std::size_t j = 0; j < 3; ++j)
      result[i] += matrix[i][j] * v[j];
  }
  return result;
}

double linear_of_display(double value) {
  return value <= 0.04045 ? value / 12.92 : std::pow((value + 0.055) / 1.055, 2.4);
}

double display_of_linear(double light) {
  return light <= 0.0031308 ? 12.92 * light : 1.055 * std::pow(light, 1 / 2.4) - 0.055;
}

double root_of(double ratio) {
  if (ratio > linear_end * linear_end * linear_end) return std::cbrt(ratio);
  return ratio / (3 * linear_end * linear_end) + 4.0 / 29;
}

double ratio_of(double root) {
  if (root > linear_end) return root * root * root;
  return 3 * linear_end * linear_end * (root - 4.0 / 29);
}

// CIE's L*a*b* of white D65, of colors as a display shows them.
Three lab_of(const Rgb& color) {
  Three light;
  for (std::size_t c = 0; c < 3; ++c)
    light[c] = linear_of_display(static_cast<double>(color[c]));
  const Three xyz = times(xyz_of_rgb, light);
  const double x = root_of(xyz[0] / white_point[0]), y = root_of(xyz[1] / white_point[1]),
               z = root_of(xyz[2] / white_point[2]);
  return {116 * y - 16, 500 * (x - y), 200 * (y - z)};
}

Rgb color_of_lab(const Three& lab) {
  const double y = (lab[0] + 16) / 116, x = y + lab[1] / 500, z = y - lab[2] / 200;
  const Three light = times(rgb_of_xyz, {white_point[0] * ratio_of(x), white_point[1] * ratio_of(y),
                                         white_point[2] * ratio_of(z)});
  Rgb color;
  for (std::size_t c = 0; c < 3; ++c)
    color[c] = static_cast<float>(display_of_linear(std::clamp(light[c], 0.0, 1.0)));
  return color;
}

// With colors between these, so near to each other that RGB joins them alike.
std::vector<PlacedColor> joined(const std::vector<PlacedColor>& colors, const Between& between) {
  constexpr int steps = 64;
  std::vector<PlacedColor> all;
  for (std::size_t i = 0; i + 1 < colors.size(); ++i) {
    const PlacedColor &before = colors[i], &after = colors[i + 1];
    all.push_back(before);
    for (int step = 1; step < steps; ++step) {
      const double part = static_cast<double>(step) / steps;
      all.push_back({before.place + part * (after.place - before.place),
                     between(before.color, after.color, part)});
    }
  }
  if (!colors.empty()) all.push_back(colors.back());
  return all;
}

// On straight lines in L*a*b*, as ParaView joins them where a color map says Lab.
std::vector<PlacedColor> joined_in_lab(const std::vector<PlacedColor>& colors) {
  return joined(colors, [](const Rgb& before, const Rgb& after, double part) {
    const Three a = lab_of(before), b = lab_of(after);
    Three lab;
    for (std::size_t c = 0; c < 3; ++c)
      lab[c] = a[c] + part * (b[c] - a[c]);
    return color_of_lab(lab);
  });
}

constexpr double pi = 3.14159265358979323846;

// L*a*b* in polar coordinates.
struct Msh {
  double magnitude = 0, saturation = 0, hue = 0;

  bool is_gray() const { return saturation <= 0.05; }
};

Msh msh_of(const Rgb& color) {
  const Three lab = lab_of(color);
  Msh msh;
  msh.magnitude = std::hypot(lab[0], lab[1], lab[2]);
  msh.saturation = msh.magnitude > 1e-3 ? std::acos(lab[0] / msh.magnitude) : 0;
  msh.hue = msh.saturation > 1e-3 ? std::atan2(lab[2], lab[1]) : 0;
  return msh;
}

Rgb color_of_msh(const Msh& msh) {
  const double chroma = msh.magnitude * std::sin(msh.saturation);
  return color_of_lab({msh.magnitude * std::cos(msh.saturation), chroma * std::cos(msh.hue),
                       chroma * std::sin(msh.hue)});
}

double angle_between(double a, double b) {
  const double angle = std::fmod(std::abs(a - b), 2 * pi);
  return std::min(angle, 2 * pi - angle);
}

// Of a gray that is joined to a color: turned so that the way between them looks even.
double hue_of_gray(const Msh& color, double magnitude) {
  if (color.magnitude >= magnitude) return color.hue;
  const double turn = color.saturation *
                      std::sqrt(magnitude * magnitude - color.magnitude * color.magnitude) /
                      (color.magnitude * std::sin(color.saturation));
  return color.hue > -pi / 3 ? color.hue + turn : color.hue - turn;
}

Rgb color_between(const Rgb& before, const Rgb& after, double part) {
  Msh a = msh_of(before), b = msh_of(after);
  const bool are_far_apart = !a.is_gray() && !b.is_gray() && angle_between(a.hue, b.hue) > pi / 3;
  if (are_far_apart) {
    const Msh white = {std::max({a.magnitude, b.magnitude, 88.0}), 0, 0};
    const bool is_first_half = part < 0.5;
    (is_first_half ? b : a) = white;
    part = is_first_half ? 2 * part : 2 * part - 1;
  }
  if (a.is_gray() && !b.is_gray()) a.hue = hue_of_gray(b, a.magnitude);
  if (b.is_gray() && !a.is_gray()) b.hue = hue_of_gray(a, b.magnitude);
  return color_of_msh({a.magnitude + part * (b.magnitude - a.magnitude),
                       a.saturation + part * (b.saturation - a.saturation),
                       a.hue + part * (b.hue - a.hue)});
}

// With colors between these as ParaView has them where a color map says Diverging: in polar
// coordinates of L*a*b*, and over white between two colors that are far apart (K. Moreland,
// "Diverging Color Maps for Scientific Visualization", 2009).
std::vector<PlacedColor> joined_over_white(const std::vector<PlacedColor>& colors) {
  return joined(colors, color_between);
}

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
