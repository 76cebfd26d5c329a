#include "finish/labels.h"

#include <algorithm>
#include <cctype>
#include <cstdlib>

#include "finish/ticks.h"
#include "snapshot/field_names.h"

namespace splotchcl {
namespace {

bool is_digit(char c) {
  return std::isdigit(static_cast<unsigned char>(c)) != 0;
}

// How long the whole number at a place is; 0 where there is none, or one with decimals.
std::size_t length_of_whole(const std::string& text, std::size_t at) {
  std::size_t end = at;
  if (end < text.size() && text[end] == '-') ++end;
  const std::size_t digits = end;
  while (end < text.size() && is_digit(text[end]))
    ++end;
  const bool has_decimals = end < text.size() && text[end] == '.';
  return end == digits || has_decimals ? 0 : end - at;
}

// The whole exponents that follow a mark, "^-3" or the "1e10" of which "1e" is the mark. A mark
// that begins with a digit begins a number.
std::string with_raised(const std::string& text, const std::string& mark,
                        const std::string& instead) {
  std::string result;
  for (std::size_t i = 0; i < text.size();) {
    const bool is_inside_number = is_digit(mark.front()) && i > 0 &&
                                  (std::isalnum(static_cast<unsigned char>(text[i - 1])) != 0 ||
                                   text[i - 1] == '.' || text[i - 1] == '_');
    std::size_t first = i + mark.size();
    const bool is_mark = text.compare(i, mark.size(), mark) == 0 && !is_inside_number;
    if (is_mark && is_digit(mark.front()) && first < text.size() && text[first] == '+') ++first;
    const std::size_t length = is_mark ? length_of_whole(text, first) : 0;
    if (length == 0) {
      result += text[i++];
      continue;
    }
    result += instead + raised(std::atoi(text.substr(first, length).c_str()));
    i = first + length;
  }
  return result;
}

std::string replaced(const std::string& text, const std::string& what, const std::string& with) {
  std::string result = text;
  for (std::size_t at = result.find(what); at != std::string::npos;
       at = result.find(what, at + with.size())) {
    result.replace(at, what.size(), with);
  }
  return result;
}

}  // namespace

std::string readable_unit(const std::string& unit, bool superscripts) {
  if (!superscripts) return unit;
  const std::string text = with_raised(with_raised(unit, "1e", "10"), "^", "");
  // U+2299: the ring of the Sun's own sign, U+2609, is too thin for small letters.
  return replaced(text, "_sun", "⊙");
}

std::string field_label(const std::string& field, int type, const SnapshotInfo& snapshot,
                        bool superscripts) {
  const ParticleTypeInfo* const info = snapshot.find_type(type);
  const FieldInfo* const found = info == nullptr ? nullptr : find_field(*info, field);
  std::string name = found == nullptr ? field : found->name;
  std::replace(name.begin(), name.end(), '_', ' ');
  if (found == nullptr || found->unit.empty()) return name;
  return name + " [" + readable_unit(found->unit, superscripts) + "]";
}

std::string length_unit(const SnapshotInfo& snapshot) {
  for (const ParticleTypeInfo& type : snapshot.types) {
    const FieldInfo* const position = find_field(type, "position");
    if (position != nullptr && !position->unit.empty()) return position->unit;
  }
  return {};
}

}  // namespace splotchcl
