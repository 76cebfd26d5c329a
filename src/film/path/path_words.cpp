#include "film/path/path_words.h"

#include <algorithm>
#include <cstddef>
#include <optional>
#include <sstream>

#include "common/words.h"

namespace splotchcl {

std::vector<std::string> path_words(std::string line) {
  line = line.substr(0, line.find('#'));
  std::replace(line.begin(), line.end(), ',', ' ');
  std::istringstream words(line);
  std::vector<std::string> result;
  for (std::string word; words >> word;)
    result.push_back(word);
  return result;
}

bool is_path_header(const std::vector<std::string>& words) {
  return !std::all_of(words.begin(), words.end(),
                      [](const std::string& word) { return parse_number(word).has_value(); });
}

const std::vector<std::string>& path_columns_without_header() {
  static const std::vector<std::string> names = {"camera_x", "camera_y", "camera_z", "lookat_x",
                                                 "lookat_y", "lookat_z", "sky_x",    "sky_y",
                                                 "sky_z",    "fidx"};
  return names;
}

std::map<std::string, double> first_path_row(const std::string& text) {
  std::istringstream lines(text);
  std::vector<std::string> names;
  for (std::string line; std::getline(lines, line);) {
    const std::vector<std::string> words = path_words(line);
    if (words.empty()) continue;
    if (names.empty() && is_path_header(words)) {
      names = words;
      continue;
    }
    if (names.empty()) names = path_columns_without_header();
    std::map<std::string, double> row;
    for (std::size_t i = 0; i < std::min(names.size(), words.size()); ++i) {
      if (const std::optional<double> value = parse_number(words[i])) row[names[i]] = *value;
    }
    return row;
  }
  return {};
}

}  // namespace splotchcl
