#include "io/finish/labels.h"

#include <algorithm>
#include <cstdlib>
#include <regex>

#include "io/finish/ticks.h"
#include "io/snapshot/field_names.h"

namespace splotchcl {
namespace {

// Whole exponents that follow a mark: "^-3" or the "e10" of "1e10".
std::string with_raised(const std::string& text, const std::regex& power,
                        const std::string& before) {
  std::string result;
  std::string rest = text;
  for (std::smatch found; std::regex_search(rest, found, power);) {
    result += found.prefix().str() + before + raised(std::atoi(found[1].str().c_str()));
    rest = found.suffix().str();
  }
  return result + rest;
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
  static const std::regex caret(R"(\^(-?[0-9]+)(?![.0-9]))");
  static const std::regex power_of_ten(R"(\b1e\+?(-?[0-9]+)\b)");
  std::string text = with_raised(unit, power_of_ten, "10");
  text = with_raised(text, caret, "");
  return replaced(text, "_sun", "☉");
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
