#include "formats/text/table_header.h"

#include <algorithm>
#include <array>
#include <cctype>
#include <utility>

#include "common/words.h"
#include "formats/table.h"
#include "formats/text/text_cells.h"
#include "snapshot/field_names.h"
#include "snapshot/unit.h"
#include "splotchcl/error.h"

namespace splotchcl {
namespace {

bool has(const std::vector<std::string>& names, const std::string& wanted) {
  return std::find(names.begin(), names.end(), wanted) != names.end();
}

bool ends_with(const std::string& text, const std::string& ending) {
  return text.size() > ending.size() &&
         text.compare(text.size() - ending.size(), ending.size(), ending) == 0;
}

// The digits of a name that ends in "(6)", "[6]" or "{6}"; empty where it does not.
std::string number_behind(const std::string& name) {
  const std::size_t open = name.find_last_of("([{");
  const bool is_behind = open != std::string::npos && open > 0 &&
                         name.back() == (name[open] == '(' ? ')' : name[open] + 2);
  if (!is_behind) return {};
  const std::string digits = name.substr(open + 1, name.size() - open - 2);
  const bool is_number = digits.find_first_not_of("0123456789") == std::string::npos;
  return is_number && digits.size() < 6 ? digits : std::string();
}

std::string name_before_number(const std::string& name) {
  return trimmed(name.substr(0, name.find_last_of("([{")));
}

// "Xc(6)", "#ID(1)" as the sixth and the first column, "x[17]" as the eighteenth; "2:x", "[2]=x".
std::string without_number(const std::string& name, std::size_t column) {
  for (const std::size_t number : {column + 1, column}) {
    const std::string digits = std::to_string(number);
    if (number_behind(name) == digits) return name_before_number(name);
    for (const std::string& start : {digits + ":", "[" + digits + "]=", "[" + digits + "]"}) {
      const bool begins_with_it =
          name.size() > start.size() && name.compare(0, start.size(), start) == 0;
      if (begins_with_it) return name.substr(start.size());
    }
  }
  return name;
}

// Whether each has a number behind it that grows from column to column: also where columns between
// them were cut out.
bool are_numbered(const std::vector<std::string>& names) {
  int last = -1;
  return std::all_of(names.begin(), names.end(), [&last](const std::string& name) {
    const std::string digits = number_behind(name);
    const int before = std::exchange(last, digits.empty() ? -1 : std::stoi(digits));
    return last > before;
  });
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

std::string without_quotes(std::string name) {
  const bool is_quoted = name.size() > 2 && name.front() == '\'' && name.back() == '\'';
  return is_quoted ? name.substr(1, name.size() - 2) : name;
}

bool is_vector(const std::string& name) {
  const std::string field = canonical_field_name(name);
  return field == "position" || field == "velocity" || field == "acceleration" ||
         field == "magnetic_field" || equal_ignoring_case(name, "v");
}

// "Points:0" of ParaView, "pos_0", "vel[0]", "pos1": axes by number.
void rename_numbered_axes(std::vector<std::string>& names) {
  struct Form {
    const char *before, *after;
    char first;
  };
  constexpr std::array<Form, 7> forms = {{{":", "", '0'},
                                          {"_", "", '0'},
                                          {"[", "]", '0'},
                                          {"(", ")", '0'},
                                          {"_", "", '1'},
                                          {"[", "]", '1'},
                                          {"", "", '1'}}};
  const std::vector<std::string> all = names;
  for (const auto& [before, after, first] : forms) {
    const std::string ending = std::string(before) + first + after;
    for (const std::string& name : all) {
      if (!ends_with(name, ending)) continue;
      const std::string stem = name.substr(0, name.size() - ending.size());
      if (*before != ':' && !is_vector(stem)) continue;
      std::array<std::string, 3> numbers;
      std::array<const char*, 3> axes{};
      for (std::size_t axis = 0; axis < 3; ++axis) {
        numbers[axis] = static_cast<char>(first + static_cast<char>(axis));
        axes[axis] = numbers[axis].c_str();
      }
      rename_axes(names, stem + before, axes, after, stem + " ");
    }
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

// A unit in brackets belongs to the name before it: "x [kpc] y [kpc]" are two names.
std::vector<std::string> with_units(const std::vector<std::string_view>& words) {
  std::vector<std::string> names;
  char closing = 0;  // of the bracket that is open
  for (const std::string_view word : words) {
    const bool is_bracket = !word.empty() && (word.front() == '[' || word.front() == '(');
    const bool opens = closing == 0 && !names.empty() && is_bracket;
    const bool continues = closing != 0;
    if (opens) closing = word.front() == '[' ? ']' : ')';
    if (opens || continues) {
      names.back() += ' ';
      names.back() += word;
    } else {
      names.emplace_back(word);
    }
    if (closing != 0 && !word.empty() && word.back() == closing) closing = 0;
  }
  return names;
}

}  // namespace

std::vector<std::string> names_of_columns(std::string_view line, std::size_t wanted) {
  for (const char candidate : separators_of_names) {
    const std::vector<std::string_view> words = split_cells(line, candidate);
    // Lines of SPLASH end in a comma.
    const auto end = words.end() - (words.size() > 2 && words.back().empty() ? 1 : 0);
    // One comma more than between the columns.
    const bool has_end = words.size() == wanted + 1 && wanted > 1 && words.back().empty();
    if (has_end && candidate != ' ')
      return names_of_columns(line.substr(0, line.rfind(candidate)), wanted);
    const bool is_complete =
        words.size() == wanted &&
        std::none_of(words.begin() + 1, end, [](std::string_view word) { return word.empty(); });
    if (is_complete) return {words.begin(), words.end()};
  }
  const bool is_empty = without_blanks(line).empty();
  const std::vector<std::string> names =
      is_empty ? std::vector<std::string>() : with_units(split_cells(line, ' '));
  if (names.size() == wanted) return names;
  const std::vector<std::string> far_apart = words_far_apart(line);
  return far_apart.size() == wanted ? far_apart : std::vector<std::string>();
}

std::vector<std::string> names_in_line(const std::string_view line, bool begins_with_blank,
                                       std::size_t wanted) {
  std::vector<std::string> names = names_of_columns(line, wanted);
  if (!names.empty() || !begins_with_blank || wanted == 0) return names;
  names = names_of_columns(line, wanted - 1);
  if (!names.empty()) names.insert(names.begin(), "");
  return names;
}

std::vector<std::string> in_our_words(std::vector<std::string> names) {
  for (std::string& name : names)
    name = without_quotes(std::move(name));
  rename_numbered_axes(names);
  const bool have_numbers = are_numbered(names);
  for (std::size_t i = 0; i < names.size(); ++i) {
    names[i] = have_numbers ? name_before_number(names[i]) : without_number(names[i], i);
  }
  for (const char* const stem : {"", "V", "v"})
    rename_axes(names, stem, {"Xc", "Yc", "Zc"}, "", stem);
  return names;
}

namespace {

struct DescribedName {
  std::string name, unit;
};

// Of each column, as ECSV describes them: in braces, in which case the header need not be ECSV's,
// or line by line, as the archive of Gaia has it: a dash, then name: x and unit: kpc.
std::vector<DescribedName> described_names(const std::vector<std::string_view>& comments) {
  std::vector<DescribedName> columns;
  bool is_ecsv = false, is_open = false;
  for (const std::string_view comment : comments) {
    const std::string text = trimmed(std::string(comment));
    is_ecsv = is_ecsv || text.rfind("%ECSV", 0) == 0;
    const bool has_braces = text.rfind("- {", 0) == 0, has_dash = !text.empty() && text[0] == '-';
    if (has_braces) columns.push_back({value_of(text, "name"), value_of(text, "unit")});
    if (has_dash) is_open = is_ecsv && !has_braces && text.rfind("--", 0) != 0;
    // Other lists follow.
    if (text.rfind("meta:", 0) == 0 || text.rfind("schema:", 0) == 0) is_ecsv = is_open = false;
    if (!is_open) continue;
    if (has_dash) columns.emplace_back();
    const std::string pair = trimmed(text.substr(has_dash ? 1 : 0));
    for (const auto& [key, value] :
         {std::pair("name", &DescribedName::name), std::pair("unit", &DescribedName::unit)}) {
      if (pair.rfind(std::string(key) + ": ", 0) == 0)
        columns.back().*value = value_of("{" + pair + "}", key);
    }
  }
  return columns;
}

}  // namespace

void add_ecsv_units(const std::vector<std::string_view>& comments,
                    std::vector<std::string>& names) {
  for (const DescribedName& column : described_names(comments)) {
    const auto named = std::find(names.begin(), names.end(), column.name);
    if (column.unit.empty() || named == names.end() || !split_unit(*named).unit.empty()) continue;
    *named += " [" + column.unit + "]";
  }
}

namespace {

// Without brackets; empty where it says that there is none.
std::string unit_in(const std::string& word) {
  const std::string unit = trimmed(word, " \t[]()\"");
  const bool is_none = unit == "-" || unit == "--" || unit == "1" || unit == "none" ||
                       lower_case(unit) == "dimensionless";
  return is_none ? std::string() : unit;
}

}  // namespace

namespace {

// "Mpc/h" of "Units: Positions in Mpc / h (comoving)", with the factor a of comoving lengths.
std::string unit_of_rockstar(const std::string& comment) {
  const std::size_t begin = comment.find(" in ") + 4,
                    end = std::min(comment.find('('), comment.size());
  std::string unit = trimmed(comment.substr(begin, end - begin));
  unit.erase(std::remove(unit.begin(), unit.end(), ' '), unit.end());
  const bool is_comoving = comment.find("(comoving)") != std::string::npos;
  return is_unit(unit) ? unit + (is_comoving ? " a" : "") : std::string();
}

// Which quantity a column of Rockstar's is; empty for others.
const char* kind_of_rockstar(const std::string& name) {
  const std::string lower = lower_case(name);
  const auto begins_with = [&lower](const char* start) { return lower.rfind(start, 0) == 0; };
  if (lower == "x" || lower == "y" || lower == "z") return "Positions";
  if (lower == "rvir" || lower == "rs" || begins_with("rs_")) return "Halo Distances";
  if (lower == "mvir" || begins_with("m200") || begins_with("m500") || begins_with("mbound"))
    return "Masses";
  if (lower == "vmax" || lower == "vrms" || lower == "vx" || lower == "vy" || lower == "vz")
    return "Velocities";
  return "";
}

}  // namespace

void add_rockstar_units(const std::vector<std::string_view>& comments,
                        std::vector<std::string>& names) {
  for (const std::string_view line : comments) {
    const std::string comment = trimmed(std::string(line));
    const std::string start = "Units: ";
    if (comment.rfind(start, 0) != 0 || comment.find(" in ") == std::string::npos) continue;
    const std::string unit = unit_of_rockstar(comment);
    for (std::string& name : names) {
      const std::string kind = kind_of_rockstar(name);
      const bool is_it = !kind.empty() && comment.compare(start.size(), kind.size(), kind) == 0;
      if (is_it && !unit.empty() && split_unit(name).unit.empty()) name += " [" + unit + "]";
    }
  }
}

bool add_units_below(std::string_view line, std::vector<std::string>& names) {
  std::vector<std::string> units;
  for (const std::string& word : names_of_columns(without_blanks(line), names.size()))
    units.push_back(unit_in(word));
  const bool has_letters = std::any_of(units.begin(), units.end(), [](const std::string& unit) {
    return unit.find_first_not_of("0123456789.eE+-^/* ") != std::string::npos;
  });
  const bool are_units =
      has_letters && std::all_of(units.begin(), units.end(), [](const std::string& unit) {
        return unit.empty() || is_unit(unit);
      });
  if (!are_units || units.size() != names.size()) return false;
  for (std::size_t i = 0; i < names.size(); ++i) {
    if (!units[i].empty() && split_unit(names[i]).unit.empty()) names[i] += " [" + units[i] + "]";
  }
  return true;
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

std::vector<std::string> names_in_brackets(std::string_view line) {
  std::vector<std::string> names;
  std::size_t open = line.find('[');
  while (open != std::string_view::npos) {
    const std::size_t close = line.find(']', open);
    if (close == std::string_view::npos) return {};
    const std::string text = trimmed(std::string(line.substr(open + 1, close - open - 1)));
    const std::size_t digits = std::min(text.find_first_not_of("0123456789"), text.size());
    const std::string name = trimmed(text.substr(digits));
    const bool is_numbered =
        digits > 0 && text.substr(0, digits).find_first_not_of('0') != std::string::npos;
    if (!is_numbered || name.empty()) return {};
    names.push_back(name);
    open = line.find('[', close);
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
