#include <fast_float/fast_float.h>
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <system_error>

#include "palette/palette_file.h"
#include "splotchcl/error.h"

namespace splotchcl {

std::string_view without_spaces(std::string_view text) {
  constexpr std::string_view spaces = " \t\r\v\f";
  const std::size_t begin = text.find_first_not_of(spaces);
  if (begin == std::string_view::npos) return {};
  return text.substr(begin, text.find_last_not_of(spaces) - begin + 1);
}

std::vector<PaletteLine> palette_lines(std::string_view text) {
  std::vector<PaletteLine> lines;
  std::size_t number = 0;
  while (!text.empty()) {
    const std::size_t end = text.find('\n');
    lines.push_back({without_spaces(text.substr(0, end)), ++number});
    text.remove_prefix(end == std::string_view::npos ? text.size() : end + 1);
  }
  return lines;
}

std::vector<std::string_view> palette_words(std::string_view text) {
  constexpr std::string_view between = " \t\r\v\f,;";
  std::vector<std::string_view> words;
  for (std::size_t begin = text.find_first_not_of(between); begin != std::string_view::npos;
       begin = text.find_first_not_of(between)) {
    text.remove_prefix(begin);
    words.push_back(text.substr(0, text.find_first_of(between)));
    text.remove_prefix(words.back().size());
  }
  return words;
}

std::optional<float> palette_number(std::string_view word) {
  float value = 0;
  const char* const end = word.data() + word.size();
  const auto result = fast_float::from_chars(word.data(), end, value);
  const bool is_number = result.ec == std::errc() && result.ptr == end;
  return is_number ? std::optional(value) : std::nullopt;
}

std::string shown(std::string_view text) {
  constexpr std::size_t longest = 40;
  std::string clean;
  for (const char c : text.substr(0, longest)) {
    if (c >= ' ' && c <= '~') clean += c;
  }
  return clean;
}

void refuse_palette(const std::string& name, std::size_t line, const std::string& problem) {
  throw DataError(fmt::format("{}:{}: {}", name, line, problem));
}

namespace {

bool are_even(const std::vector<PlacedColor>& colors) {
  constexpr double rounding = 1e-3;  // of a step
  const double first = colors.front().place;
  const double step = (colors.back().place - first) / static_cast<double>(colors.size() - 1);
  for (std::size_t i = 0; i < colors.size(); ++i) {
    const double expected = first + step * static_cast<double>(i);
    if (std::abs(colors[i].place - expected) > rounding * step) return false;
  }
  return true;
}

Rgb color_at(const std::vector<PlacedColor>& colors, double place) {
  const auto after = std::upper_bound(
      colors.begin(), colors.end(), place,
      [](double wanted, const PlacedColor& color) { return wanted < color.place; });
  if (after == colors.begin()) return colors.front().color;
  if (after == colors.end()) return colors.back().color;
  const PlacedColor& before = *std::prev(after);
  const auto part = static_cast<float>((place - before.place) / (after->place - before.place));
  Rgb color;
  for (std::size_t c = 0; c < color.size(); ++c)
    color[c] = before.color[c] + part * (after->color[c] - before.color[c]);
  return color;
}

}  // namespace

std::vector<Rgb> even_knots(const std::vector<PlacedColor>& colors) {
  constexpr std::size_t many = 1024;
  std::vector<Rgb> knots;
  const double first = colors.front().place, last = colors.back().place;
  if (colors.size() == 1 || !(last > first) || are_even(colors)) {
    for (const PlacedColor& color : colors)
      knots.push_back(color.color);
    return knots;
  }
  for (std::size_t i = 0; i < many; ++i) {
    const double part = static_cast<double>(i) / static_cast<double>(many - 1);
    knots.push_back(color_at(colors, first + part * (last - first)));
  }
  return knots;
}

}  // namespace splotchcl
