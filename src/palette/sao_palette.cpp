#include <fmt/format.h>

#include <algorithm>
#include <array>

#include "palette/other_palettes.h"
#include "splotchcl/error.h"

namespace splotchcl {
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

}  // namespace splotchcl
