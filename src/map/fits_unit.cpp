#include "map/fits_unit.h"

#include <cctype>
#include <map>

namespace splotchcl {
namespace {

bool begins_name(char c) {
  return std::isalpha(static_cast<unsigned char>(c)) != 0;
}
bool belongs_to_name(char c) {
  return std::isalnum(static_cast<unsigned char>(c)) != 0 || c == '_';
}

std::string name_in_fits(const std::string& name) {
  static const std::map<std::string, std::string> names = {
      {"Msun", "solMass"}, {"M_sun", "solMass"},   {"Rsun", "solRad"},    {"R_sun", "solRad"},
      {"au", "AU"},        {"particles", "count"}, {"a", "scale_factor"}, {"h", "little_h"},
  };
  const auto found = names.find(name);
  return found == names.end() ? name : found->second;
}

// 1e10, the only numbers that the standard has.
std::string power_of_ten(const std::string& number) {
  return number.rfind("1e", 0) == 0 ? "10**" + number.substr(2) : number;
}

}  // namespace

std::string fits_unit(const std::string& unit) {
  std::string result;
  for (std::size_t i = 0; i < unit.size();) {
    const bool is_name = begins_name(unit[i]);
    const bool is_number = !is_name && std::isdigit(static_cast<unsigned char>(unit[i])) != 0;
    if (!is_name && !is_number) {
      result += unit[i] == '^' ? "**" : std::string(1, unit[i]);
      ++i;
      continue;
    }
    std::size_t end = i;
    while (end < unit.size() && (belongs_to_name(unit[end]) || (is_number && unit[end] == '.')))
      ++end;
    const std::string word = unit.substr(i, end - i);
    result += is_name ? name_in_fits(word) : power_of_ten(word);
    i = end;
  }
  return result;
}

}  // namespace splotchcl
