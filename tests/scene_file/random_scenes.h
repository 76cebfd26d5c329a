#pragma once

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <limits>
#include <map>
#include <random>
#include <set>
#include <string>
#include <vector>

#include "scene_file/keys.h"
#include "scene_file/values.h"
#include "splotchcl/error.h"
#include "splotchcl/scene_file.h"

namespace splotchcl::test {

// Values that keys take, made from what each says that it expects, awkward ones included.
class RandomValues {
 public:
  explicit RandomValues(unsigned seed) : random_(seed) {}

  bool coin() { return integer(0, 1) == 1; }
  int integer(int from, int to) { return std::uniform_int_distribution<int>(from, to)(random_); }

  // As TOML.
  std::string value_of(const scene_file::Key& key) {
    const std::vector<std::string> known = samples(key.expected);
    if (!known.empty()) return one_of(known);
    if (key.expected.find("an array of strings") == 0)
      return list(integer(1, 3), [this] { return word(); });
    if (key.expected.find("a string") == 0) return word();
    const std::vector<std::string> words = quoted_words(key.expected);
    if (!words.empty() && (key.expected.find("number") == std::string::npos || coin()))
      return one_of(words);
    if (key.expected.find("two or more of [x, y, z]") == 0)
      return list(integer(2, 4), [this] { return list(3, [this] { return number(""); }); });
    if (key.expected.find("an array of finite numbers") == 0)
      return list(integer(1, 3), [this] { return number(""); });
    if (key.expected[0] != '[') return number(key.expected);
    const std::size_t end = key.expected.find(']');
    const auto commas = std::count(key.expected.begin(),
                                   key.expected.begin() + static_cast<std::ptrdiff_t>(end), ',');
    return list(static_cast<int>(commas) + 1, [&] { return number(key.expected.substr(end)); });
  }

 private:
  // Of what the words do not tell enough.
  static std::vector<std::string> samples(const std::string& expected) {
    static const std::map<std::string, std::vector<std::string>> by_start = {
        {"true or false", {"true", "false"}},
        {"8 or 16", {"8", "16"}},
        {"8 or 10", {"8", "10"}},
        {"[width, height] or", {"[640, 480]", "[512, 512]", "\"1024x512\"", "[16384, 1]"}},
        {"[low, high], numbers", {"[20, 80.5]", "[0, 1e-300]", "[99.9, 100]"}},
        {"[from, to], numbers >= 0 with", {"[20, 80.5]", "[0, 1e-300]", "[1e30, 3e30]"}},
        {"[right ascension", {"[0, -90]", "[359.9, 12.25]"}},
        {"a number > 0, or [x, y, z]", {"1e-9", "[1, 2.5, 3e+40]"}},
        {"a number, or [NX", {"64", "[16, 1, 8192]"}},
        {"a number, or [X", {"64", "[16, 8192]"}},
        {"a particle type", {"31", "\"stars\"", "[1, \"boundary\", 6]"}},
        {"a table of units", {"{mass = \"Msun\"}", "{position = \"kpc/h a\", U = \"(km/s)^2\"}"}},
        {"a whole number from 0 to 2^64",
         {"0", "12", "9007199254740993", "\"18446744073709551615\""}},
        {"a list of paths", {"\"a%03d\"", "\"a%03db%%\"", "[\"a\"]", "[\"é\", \"b\\tc\"]"}},
        {"a formula", {"\"log10(U) * RHO\"", "\"x > 1 ? -x^2 : `é 1`\""}},
        {"a condition", {"\"U > 1e5\"", "[\"U > 1e5\", \"RHO <= -3.5 or \\\"é\\\" != 0\"]"}},
        {"tables in increasing order",
         {"[{ frame = 1e-3, \"image.gamma\" = 1.5, \"component.a.palette\" = \"magma\" }]",
          "[{ frame = 0, \"camera.position\" = [1, 2.5, -3e+40] }, { frame = 7, tolerance = 1 }]"}},
    };
    for (const auto& [start, values] : by_start)
      if (expected.find(start) == 0) return values;
    return {};
  }

  static std::vector<std::string> quoted_words(const std::string& text) {
    std::vector<std::string> words;
    for (std::size_t begin = text.find('"'); begin != std::string::npos;) {
      const std::size_t end = text.find('"', begin + 1);
      words.push_back(text.substr(begin, end + 1 - begin));
      begin = text.find('"', end + 1);
    }
    return words;
  }

  const std::string& one_of(const std::vector<std::string>& values) {
    return values[static_cast<std::size_t>(integer(0, static_cast<int>(values.size()) - 1))];
  }

  template <class Value>
  static std::string list(int count, const Value& value) {
    std::string text;
    for (int i = 0; i < count; ++i)
      text += (i == 0 ? "" : ", ") + value();
    return "[" + text + "]";
  }

  std::string word() {
    static const std::vector<std::string> parts = {
        "U", "snap_092.hdf5", "a b", "\"", "\\", "\n", "\t",   "\x01", "\x7f", "é",  "#",
        "'", "[x]",           "= 3", "/",  ".",  "\r", "\"\"", "銀河", "0",    "{}", "\b\f",
    };
    std::string text;
    for (int i = integer(1, 4); i > 0; --i)
      text += one_of(parts);
    return scene_file::write_text(text);
  }

  // What follows this word.
  static double limit(const std::string& expected, const std::string& word, double otherwise) {
    const std::size_t found = expected.find(word);
    return found == std::string::npos ? otherwise : std::stod(expected.substr(found + word.size()));
  }

  std::string number(const std::string& expected) {
    if (expected.find("an integer") == 0)
      return std::to_string(integer(static_cast<int>(limit(expected, " from ", 0)),
                                    static_cast<int>(limit(expected, " to ", 0))));
    const double none = std::numeric_limits<double>::infinity();
    const double at_least = limit(expected, ">= ", -none);
    const double low = limit(expected, "> ", at_least);
    const double high = limit(expected, "<= ", limit(expected, "< ", none));
    if (std::isfinite(at_least) && integer(0, 7) == 0) return scene_file::write_number(at_least);
    if (std::isfinite(high)) return scene_file::write_number(low + (high - low) * part());
    const double powers = coin() ? 2 : 280;  // of ten: with all digits
    const double size = coin() ? integer(1, 1000) : std::pow(10, powers * (2 * part() - 1));
    return scene_file::write_number(std::isfinite(low) ? low + size : coin() ? -size : size);
  }

  // Neither of its ends.
  double part() { return std::uniform_real_distribution<double>(1e-9, 1)(random_); }

  std::mt19937 random_;
};

// Scenes made by settings of every key, those that do not fit together left out.
class RandomScenes {
 public:
  explicit RandomScenes(unsigned seed) : values_(seed) {}

  Scene next() {
    Scene scene;
    scene.components.resize(static_cast<std::size_t>(values_.integer(0, 4)));
    std::map<std::string, bool> has_table;
    for (const scene_file::Key& key : scene_file::all_keys()) {
      const std::string table = key.path.substr(0, key.path.find('.'));
      // A setting of the one does not take the place of the other.
      if (key.path == "map.contour_count" && !scene.map.contours.empty()) continue;
      if (!has_table.try_emplace(table, values_.coin()).first->second) continue;
      const std::string rest = key.path.substr(table.size());
      if (table != "component") give(scene, key, key.path);
      for (std::size_t i = 0; table == "component" && i < scene.components.size(); ++i)
        give(scene, key, "component." + std::to_string(i) + rest);
    }
    return scene;
  }

  // The keys that some scene so far took.
  const std::set<std::string>& taken() const { return taken_; }

 private:
  // Some keys are taken only together with another.
  void give(Scene& scene, const scene_file::Key& key, const std::string& label) {
    if (values_.integer(0, 2) == 0) return;
    const std::string setting = label + "=" + values_.value_of(key);
    for (const std::vector<std::string>& settings : {{setting}, std::vector{refused_, setting}}) {
      try {
        scene = apply_settings(scene, settings);
        taken_.insert(key.path);
        if (settings.size() > 1) taken_.insert(refused_key_);
        return;
      } catch (const UsageError&) {
        // Does not fit.
      }
    }
    refused_ = setting;
    refused_key_ = key.path;
  }

  RandomValues values_;
  std::string refused_ = "tolerance=0", refused_key_;
  std::set<std::string> taken_;
};

}  // namespace splotchcl::test
