#include "palette/palette_names.h"

#include <array>
#include <utility>

#include "common/words.h"

namespace splotchcl {
namespace {

// In lower case without anything between words.
std::string plain(const std::string& name) {
  std::string letters;
  for (const char c : lower_case(name)) {
    const bool is_between = c == ' ' || c == '_' || c == '-';
    if (!is_between) letters += c;
  }
  return letters;
}

std::string without_program(std::string name) {
  for (const std::string start : {"matplotlib:", "mpl:", "mpl_", "cmap:", "cm."}) {
    if (name.compare(0, start.size(), start) == 0) name.erase(0, start.size());
  }
  const std::string ending = "(matplotlib)";
  if (name.size() > ending.size() &&
      name.compare(name.size() - ending.size(), ending.size(), ending) == 0) {
    name.resize(name.size() - ending.size());
  }
  return trimmed(name);
}

// ParaView's, matplotlib's and others' words for palettes that are here.
std::string in_our_words(const std::string& letters) {
  constexpr std::array<std::pair<const char*, const char*>, 6> others = {
      {{"cooltowarm", "coolwarm"},
       {"grey", "gray"},
       {"grayscale", "gray"},
       {"greyscale", "gray"},
       {"bwlinear", "gray"},
       {"binary", "greys"}}};
  for (const auto& [other, ours] : others) {
    if (letters == other) return ours;
  }
  return letters;
}

}  // namespace

std::optional<std::string> palette_named_otherwise(const std::string& name,
                                                   const std::vector<std::string>& known) {
  const std::string wanted = in_our_words(plain(without_program(lower_case(name))));
  std::optional<std::string> found;
  if (wanted.empty()) return found;
  for (const std::string& candidate : known) {
    if (plain(candidate) != wanted) continue;
    if (found) return std::nullopt;
    found = candidate;
  }
  return found;
}

}  // namespace splotchcl
