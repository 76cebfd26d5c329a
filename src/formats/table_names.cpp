#include <algorithm>
#include <array>

#include "common/words.h"
#include "formats/table.h"
#include "snapshot/field_names.h"

namespace splotchcl {
namespace {

std::string without_joints(const std::string& text, const char* what = " \t_.-") {
  const std::size_t first = text.find_first_not_of(what);
  if (first == std::string::npos) return {};
  return text.substr(first, text.find_last_not_of(what) - first + 1);
}

// Vectors that have no common name, or none under which they are often kept.
bool is_another_vector(const std::string& name) {
  constexpr std::array<const char*, 8> others = {"v", "a", "acc", "b", "j", "l", "rgb", "color"};
  return std::any_of(others.begin(), others.end(),
                     [&](const char* other) { return equal_ignoring_case(name, other); });
}

}  // namespace

std::string as_utf8(const std::string& name) {
  const std::vector<Character> characters = characters_of(name);
  const bool is_utf8 = std::all_of(characters.begin(), characters.end(),
                                   [](const Character& one) { return one.code.has_value(); });
  if (is_utf8) return name;
  std::string text;
  for (const char c : name) {
    const auto byte = static_cast<unsigned char>(c);
    if (byte >= 0x80) text += static_cast<char>(0xc0U | (byte >> 6U));
    text += byte < 0x80 ? c : static_cast<char>(0x80U | (byte & 0x3fU));
  }
  return text;
}

std::string in_our_units(const std::string& unit) {
  constexpr std::array<std::array<const char*, 2>, 13> words = {{{"cpc", "a pc"},
                                                                 {"ckpc", "a kpc"},
                                                                 {"cMpc", "a Mpc"},
                                                                 {"cGpc", "a Gpc"},
                                                                 {"pccm", "a pc"},
                                                                 {"kpccm", "a kpc"},
                                                                 {"Mpccm", "a Mpc"},
                                                                 {"Gpccm", "a Gpc"},
                                                                 {"ppc", "pc"},
                                                                 {"pkpc", "kpc"},
                                                                 {"pMpc", "Mpc"},
                                                                 {"pGpc", "Gpc"},
                                                                 {"Msol", "Msun"}}};
  const auto is_letter = [](char c) {
    return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || c == '_';
  };
  std::string result;
  for (auto next = unit.begin(); next != unit.end();) {
    const auto end = std::find_if_not(next, unit.end(), is_letter);
    const std::string word(next, end);
    const auto ours = std::find_if(words.begin(), words.end(),
                                   [&word](const auto& known) { return word == known[0]; });
    const std::string text = ours == words.end() ? word : (*ours)[1];
    const bool is_factor = !result.empty() || (end != unit.end() && (*end == '^' || *end == '*'));
    const bool is_product = text.find(' ') != std::string::npos;
    result += is_factor && is_product ? "(" + text + ")" : text;
    next = std::find_if(end, unit.end(), is_letter);
    result.append(end, next);
  }
  return result;
}

NameAndUnit split_unit(const std::string& text) {
  for (const char* brackets : {"[]", "()"}) {
    const std::size_t open = text.find(brackets[0]);
    if (open == std::string::npos || open == 0 || text.back() != brackets[1]) continue;
    const std::string name = without_joints(text.substr(0, open), " \t");
    if (name.empty()) continue;
    return {name,
            in_our_units(without_joints(text.substr(open + 1, text.size() - open - 2), " \t"))};
  }
  return {text, ""};
}

std::optional<NamedColumn> split_named_column(const std::string& text) {
  const std::size_t equals = text.find('=');
  if (equals == std::string::npos) return std::nullopt;
  NamedColumn column = {without_joints(text.substr(0, equals), " \t"),
                        without_joints(text.substr(equals + 1), " \t")};
  if (column.name.empty() || column.source.empty()) return std::nullopt;
  return column;
}

std::string vector_name(const std::string& column) {
  if (column.empty() || (column.back() != 'x' && column.back() != 'X')) return {};
  const std::string stem = without_joints(column.substr(0, column.size() - 1));
  if (stem.empty()) return "position";
  if (equal_ignoring_case(stem, "v")) return "velocity";
  if (equal_ignoring_case(stem, "a")) return "acceleration";
  if (equal_ignoring_case(stem, "b")) return "magnetic_field";
  const std::string canonical = canonical_field_name(stem);
  return canonical.empty() ? stem : canonical;
}

bool is_place_or_size(const std::string& column) {
  std::string first = column;
  const bool is_axis =
      !first.empty() && std::string("yzYZ").find(first.back()) != std::string::npos;
  if (is_axis) first = with_axis(std::move(first), 0);
  const std::string field = canonical_field_name(column);
  return field == "position" || field == "smoothing_length" || vector_name(first) == "position";
}

std::string with_axis(std::string column, int axis) {
  const bool is_upper = column.back() == 'X';
  column.back() = static_cast<char>((is_upper ? 'X' : 'x') + axis);
  return column;
}

std::optional<std::size_t> find_positions(const std::vector<TableColumn>& columns) {
  for (std::size_t i = 0; i < columns.size(); ++i) {
    const std::string name = split_unit(columns[i].name).name;
    const bool is_it = columns[i].values_per_row == 3 ? canonical_field_name(name) == "position"
                                                      : vector_name(name) == "position";
    if (is_it) return i;
  }
  return std::nullopt;
}

std::string lost_axis(const std::vector<TableColumn>& columns,
                      const std::vector<std::string>& left_out) {
  std::vector<TableColumn> all = columns;
  for (const std::string& name : left_out)
    all.push_back({name, 1});
  const auto first = find_positions(all);
  if (!first || all[*first].values_per_row != 1) return {};
  const std::string x = split_unit(all[*first].name).name;
  for (int axis = 0; axis < 3; ++axis) {
    const std::string name = with_axis(x, axis);
    for (const std::string& lost : left_out) {
      if (split_unit(lost).name == name) return lost;
    }
  }
  return {};
}

std::optional<std::size_t> guess_positions(const std::vector<TableColumn>& columns) {
  if (find_positions(columns)) return std::nullopt;
  std::optional<std::size_t> only;
  for (std::size_t i = 0; i < columns.size(); ++i) {
    const std::string name = split_unit(columns[i].name).name;
    const bool may_be_it = columns[i].values_per_row == 3 && canonical_field_name(name).empty() &&
                           !is_another_vector(name);
    if (!may_be_it) continue;
    if (only) return std::nullopt;  // which of them is for the user to say
    only = i;
  }
  return only;
}

}  // namespace splotchcl
