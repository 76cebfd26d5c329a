#include "finish/ticks.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>

#include "scene/scalar_map.h"

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

}  // namespace splotchcl
