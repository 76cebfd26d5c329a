#include "map/fits_unit.h"

#include <fmt/format.h>

#include <algorithm>
#include <cctype>
#include <cmath>
#include <cstddef>
#include <map>

#include "snapshot/unit.h"
#include "splotchcl/error.h"

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
      {"Msun", "solMass"},    {"M_sun", "solMass"},  {"Rsun", "solRad"}, {"R_sun", "solRad"},
      {"Lsun", "solLum"},     {"L_sun", "solLum"},   {"ly", "lyr"},      {"au", "AU"},
      {"particles", "count"}, {"a", "scale_factor"}, {"h", "little_h"},
  };
  const auto found = names.find(name);
  return found == names.end() ? name : found->second;
}

// 1e10, the only numbers that the standard has.
std::string power_of_ten(const std::string& number) {
  return number.rfind("1e", 0) == 0 ? "10**" + number.substr(2) : number;
}

bool is_whole(const std::string& number) {
  const std::size_t first = number.rfind('-', 0) == 0 ? 1 : 0;
  return number.size() > first &&
         std::all_of(number.begin() + static_cast<std::ptrdiff_t>(first), number.end(),
                     [](char c) { return std::isdigit(static_cast<unsigned char>(c)) != 0; });
}

// Whether the standard has this factor of a unit: a name to a whole power, or, as the first one, a
// power of ten.
bool is_factor_of_fits(const std::string& factor, bool is_first) {
  const std::size_t mark = std::min(factor.find("**"), factor.size());
  const std::string base = factor.substr(0, mark);
  const bool is_to_whole = mark == factor.size() || is_whole(factor.substr(mark + 2));
  if (base == "10") return is_first && mark != factor.size();
  return is_to_whole && base != "m_p" && !base.empty() &&
         std::all_of(base.begin(), base.end(), [](char c) { return begins_name(c) || c == '_'; });
}

bool is_of_fits(const std::string& text) {
  for (std::size_t first = 0; first < text.size();) {
    const std::size_t end = std::min(text.find_first_of(" /", first), text.size());
    if (end > first && !is_factor_of_fits(text.substr(first, end - first), first == 0))
      return false;
    first = end + 1;
  }
  return true;
}

// "cm**-2", "g**(0.5)": powers that are not whole are in parentheses.
void append_power(std::string& text, const char* base, double power) {
  constexpr double rounding = 1e-6;
  if (std::abs(power) < rounding) return;
  const double whole = std::round(power);
  const bool is_near_whole = std::abs(power - whole) < rounding;
  text += (text.empty() ? "" : " ") + std::string(base);
  if (is_near_whole && whole != 1) text += fmt::format("**{:.0f}", whole);
  if (!is_near_whole) text += fmt::format("**({:.6g})", power);
}

FitsUnit in_cgs(const Unit& unit) {
  // A factor of ten by itself is no number of the standard's.
  double exponent = std::floor(std::log10(unit.in_cgs));
  if (exponent == 1) exponent = 0;
  FitsUnit result;
  result.factor = unit.in_cgs / std::pow(10, exponent);
  append_power(result.text, "10", exponent);
  constexpr const char* names[] = {"cm", "g", "s", "K"};
  for (const std::size_t i : {1U, 0U, 2U, 3U})
    append_power(result.text, names[i], unit.powers[i]);
  return result;
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

FitsUnit readable_fits_unit(const std::string& unit) {
  const std::string text = fits_unit(unit);
  if (is_of_fits(text)) return {text};
  try {
    const Unit known = parse_unit(unit, {}, "unit");
    if (known.in_cgs > 0 && std::isfinite(known.in_cgs)) return in_cgs(known);
  } catch (const UsageError&) {
    // With a and h, or names that nobody else knows.
  }
  return {text};
}

}  // namespace splotchcl
