#include "formats/text/table_header.h"

#include <algorithm>
#include <array>
#include <cctype>

#include "common/words.h"
#include "formats/table_names.h"
#include "snapshot/field_names.h"

namespace splotchcl {
namespace {

bool has(const std::vector<std::string>& names, const std::string& wanted) {
  return std::find(names.begin(), names.end(), wanted) != names.end();
}

// "Xc(6)", "#ID(1)" as the sixth and the first column.
std::string without_number(const std::string& name, std::size_t column) {
  const std::string number = "(" + std::to_string(column + 1) + ")";
  const bool ends_with_it = name.size() > number.size() &&
                            name.compare(name.size() - number.size(), number.size(), number) == 0;
  return ends_with_it ? name.substr(0, name.size() - number.size()) : name;
}

// Where all three axes of a vector are written in another way, those that are ours.
void rename_axes(std::vector<std::string>& names, const std::string& before,
                 const std::array<const char*, 3>& axes, const std::string& after,
                 const std::string& stem) {
  for (const char* const axis : axes) {
    if (!has(names, before + axis + after)) return;
  }
  for (std::size_t axis = 0; axis < axes.size(); ++axis) {
    std::replace(names.begin(), names.end(), before + axes[axis] + after,
                 stem + static_cast<char>('x' + axis));
  }
}

// "smoothing length" is a name of ours but for its blank.
std::string with_our_blanks(const std::string& name) {
  NameAndUnit parts = split_unit(name);
  std::string joined = parts.name;
  std::replace(joined.begin(), joined.end(), ' ', '_');
  if (canonical_field_name(joined).empty()) return name;
  return parts.unit.empty() ? joined : joined + " [" + parts.unit + "]";
}

// The value of a key of "{name: x, unit: km / s, datatype: float64}"; empty where it has none.
std::string value_of(const std::string& text, const std::string& key) {
  std::size_t begin = text.find("{" + key + ": ");
  if (begin == std::string::npos) begin = text.find(", " + key + ": ");
  if (begin == std::string::npos) return {};
  begin = text.find(": ", begin) + 2;
  const char quote = text[begin];
  if (quote == '\'' || quote == '"') {
    return text.substr(begin + 1, text.find(quote, begin + 1) - begin - 1);
  }
  return trimmed(text.substr(begin, text.find_first_of(",}", begin) - begin));
}

}  // namespace

std::vector<std::string> in_our_words(std::vector<std::string> names) {
  for (std::size_t i = 0; i < names.size(); ++i)
    names[i] = without_number(names[i], i);
  for (const char* const stem : {"", "V", "v"})
    rename_axes(names, stem, {"Xc", "Yc", "Zc"}, "", stem);
  const std::vector<std::string> before = names;
  for (const std::string& name : before) {
    const std::size_t colon = name.rfind(":0");
    if (colon != std::string::npos && colon > 0 && colon + 2 == name.size()) {
      const std::string stem = name.substr(0, colon);
      rename_axes(names, stem, {":0", ":1", ":2"}, "", stem + " ");
    }
  }
  return names;
}

void add_ecsv_units(const std::vector<std::string_view>& comments,
                    std::vector<std::string>& names) {
  for (const std::string_view comment : comments) {
    const std::string text = trimmed(std::string(comment));
    if (text.compare(0, 9, "- {name: ") != 0) continue;
    const std::string unit = value_of(text, "unit");
    const auto named = std::find(names.begin(), names.end(), value_of(text, "name"));
    if (unit.empty() || named == names.end() || !split_unit(*named).unit.empty()) continue;
    *named += " [" + unit + "]";
  }
}

std::vector<std::string> names_by_number(const std::vector<std::string_view>& comments,
                                         std::size_t columns) {
  std::vector<std::string> names;
  for (const std::string_view comment : comments) {
    const std::string text = trimmed(std::string(comment));
    const std::string start = "column " + std::to_string(names.size() + 1) + ":";
    if (lower_case(text.substr(0, start.size())) != start) continue;
    names.push_back(with_our_blanks(trimmed(text.substr(start.size()))));
  }
  return names.size() == columns ? names : std::vector<std::string>();
}

std::vector<std::string> names_in_columns(std::string_view line) {
  constexpr std::size_t width = 16;
  std::vector<std::string> names;
  for (std::size_t begin = 0; begin < line.size(); begin += width) {
    if (line[begin] != ' ') return {};
    const std::string name = trimmed(std::string(line.substr(begin, width)));
    if (name.empty()) return {};
    const bool is_cut = name.find('[') != std::string::npos && name.back() != ']';
    names.push_back(is_cut ? trimmed(name.substr(0, name.find('['))) : name);
  }
  return names;
}

std::vector<std::string> words_far_apart(std::string_view line) {
  std::vector<std::string> words;
  bool is_new = true;
  for (std::size_t i = 0; i < line.size(); ++i) {
    const bool is_blank = line[i] == ' ' || line[i] == '\t';
    const bool is_end =
        is_blank && (i + 1 == line.size() || line[i + 1] == ' ' || line[i + 1] == '\t');
    if (is_end) is_new = true;
    if (is_blank && (is_end || is_new)) continue;
    if (is_new) words.emplace_back();
    is_new = false;
    words.back() += line[i];
  }
  return words;
}

}  // namespace splotchcl
