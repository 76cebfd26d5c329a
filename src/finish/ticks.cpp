#include "finish/ticks.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cctype>
#include <cmath>
#include <cstdlib>

#include "formula/formula.h"
#include "formula/formula_units.h"
#include "scene/scalar_map.h"
#include "snapshot/field_names.h"

namespace splotchcl {
namespace {

// A hair beyond the ends still belongs to the axis.
constexpr double slack = 1e-9;

// The marks of one axis, while they are found.
class Axis {
 public:
  Axis(const ScalarMap& map, int most, bool superscripts)
      : map_(map),
        most_(std::max(2, most)),
        superscripts_(superscripts),
        low_(unscaled(map.minimum, map.scaling)),
        high_(unscaled(map.maximum, map.scaling)) {}

  std::vector<Tick> ticks() {
    if (!(map_.maximum > map_.minimum)) {
      ticks_.push_back({0, low_, number_label(low_, superscripts_)});
    } else if (map_.scaling == Scaling::log) {
      logarithmic();
    } else if (map_.scaling == Scaling::asinh && std::max(-low_, high_) > 20) {
      symmetric();
    } else {
      linear();
    }
    std::sort(ticks_.begin(), ticks_.end(),
              [](const Tick& a, const Tick& b) { return a.position < b.position; });
    return ticks_;
  }

 private:
  void add(double value, const std::string& label) {
    const double position =
        (scaled(value, map_.scaling) - map_.minimum) / (map_.maximum - map_.minimum);
    if (position < -slack || position > 1 + slack) return;
    ticks_.push_back({std::clamp(position, 0.0, 1.0), value, label});
  }
  void add(double value) { add(value, number_label(value, superscripts_)); }

  // Steps of 1, 2 or 5 times a power of ten.
  void linear() {
    double step = round_below((high_ - low_) / most_);
    while ((high_ - low_) / step > most_)
      step = round_below(step * 2.6);
    const double first = std::ceil(low_ / step - slack);
    for (double i = first; i * step <= high_ + slack * step; ++i) {
      add(i * step == 0 ? 0 : i * step);
    }
  }

  void logarithmic() {
    const double decades = map_.maximum - map_.minimum;
    if (decades < 0.7) return linear();
    const int first = static_cast<int>(std::floor(map_.minimum));
    const int last = static_cast<int>(std::ceil(map_.maximum));
    const int step = static_cast<int>(std::ceil(decades / most_));
    const bool has_numbers_between = decades < 2;
    const bool has_powers = superscripts_ && !has_numbers_between && (first < -2 || last > 4);
    for (int exponent = first; exponent <= last; ++exponent) {
      const double decade = std::pow(10.0, exponent);
      if (exponent % step != 0) {
        add(decade, "");
      } else {
        add(decade, has_powers ? "10" + raised(exponent) : number_label(decade, superscripts_));
      }
      if (step > 1) continue;
      for (int digit = 2; digit < 10; ++digit) {
        const bool has_number = has_numbers_between && (digit == 2 || digit == 5);
        add(digit * decade, has_number ? number_label(digit * decade, superscripts_) : "");
      }
    }
  }

  // Powers of ten on both sides of 0, as far as the axis reaches.
  void symmetric() {
    const bool has_zero = low_ <= 0 && high_ >= 0;
    if (has_zero) add(0);
    const double decades = (map_.maximum - map_.minimum) / std::log(10.0);
    const int step = std::max(1, static_cast<int>(std::ceil(decades / (most_ - 1))));
    const int last = static_cast<int>(std::ceil(std::log10(std::max(-low_, high_))));
    // Closer to 0 asinh is nearly linear, and powers of ten crowd there.
    for (int exponent = last; exponent >= (has_zero ? 1 : 0); --exponent) {
      const double decade = std::pow(10.0, exponent);
      const bool has_number = (last - exponent) % step == 0;
      for (const double value : {-decade, decade})
        add(value, has_number ? number_label(value, superscripts_) : "");
    }
  }

  const ScalarMap& map_;
  int most_;
  bool superscripts_;
  double low_, high_;
  std::vector<Tick> ticks_;
};

}  // namespace

std::vector<Tick> ticks_of(const ScalarMap& map, int most, bool superscripts) {
  return Axis(map, most, superscripts).ticks();
}

double round_below(double value) {
  const double decade = std::pow(10.0, std::floor(std::log10(value)));
  for (const double digit : {5.0, 2.0, 1.0}) {
    if (digit * decade <= value * (1 + slack)) return digit * decade;
  }
  return decade;
}

std::string raised(int exponent) {
  static const std::array<const char*, 10> digits = {"⁰", "¹", "²", "³", "⁴",
                                                     "⁵", "⁶", "⁷", "⁸", "⁹"};
  std::string text;
  for (const char c : std::to_string(exponent))
    text += c == '-' ? "⁻" : digits[static_cast<std::size_t>(c - '0')];
  return text;
}

std::string number_label(double value, bool superscripts) {
  const double size = std::abs(value);
  if (value == 0) return "0";
  if (size < 1e5 * (1 - slack) && size >= 1e-2 * (1 - slack)) return fmt::format("{:.5g}", value);
  if (!superscripts) return fmt::format("{:.4g}", value);
  int exponent = static_cast<int>(std::floor(std::log10(size) + slack));
  const std::string digits = fmt::format("{:.4g}", value / std::pow(10.0, exponent));
  const std::string power = "10" + raised(exponent);
  if (digits == "1") return power;
  return digits == "-1" ? "-" + power : digits + "×" + power;
}

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

namespace {

// As far as it follows from what the file says; else empty.
std::string unit_of_formula_in(const ParticleTypeInfo& type, const std::string& text,
                               const SnapshotInfo& snapshot) {
  if (!Formula::may_be(text)) return {};
  const auto unit_of_field = [&](const std::string& name) -> std::optional<WrittenUnit> {
    const FieldInfo* const field = find_field(type, name);
    if (field == nullptr) return std::nullopt;
    return written_unit(field->unit, unit_factors(snapshot));
  };
  const auto unit = unit_of_formula(Formula::parse(text, "formula"), unit_of_field, "formula");
  return unit ? unit->text() : std::string();
}

}  // namespace

std::string field_label(const std::string& field, int type, const SnapshotInfo& snapshot,
                        bool superscripts) {
  const ParticleTypeInfo* const info = snapshot.find_type(type);
  const FieldInfo* const found = info == nullptr ? nullptr : find_field(*info, field);
  std::string name = found == nullptr ? field : found->name;
  std::replace(name.begin(), name.end(), '_', ' ');
  const std::string unit = found != nullptr  ? found->unit
                           : info != nullptr ? unit_of_formula_in(*info, field, snapshot)
                                             : std::string();
  return unit.empty() ? name : name + " [" + readable_unit(unit, superscripts) + "]";
}

std::string length_unit(const SnapshotInfo& snapshot) {
  for (const ParticleTypeInfo& type : snapshot.types) {
    const FieldInfo* const position = find_field(type, "position");
    if (position != nullptr && !position->unit.empty()) return position->unit;
  }
  return {};
}

}  // namespace splotchcl
