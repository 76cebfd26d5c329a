#pragma once

#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <algorithm>
#include <cmath>
#include <cstddef>
#include <functional>
#include <limits>
#include <memory>
#include <optional>
#include <sstream>
#include <string>
#include <type_traits>
#include <utility>
#include <vector>

#include "cli/console.h"
#include "common/words.h"

// CLI11 is slow to compile: only files that describe commands include this one.
namespace splotchcl::cli {

using Run = std::function<int()>;

// Help beside a column of names, in lines of at most 100 characters.
constexpr std::size_t name_column = 24;
inline std::string wrapped(const std::string& text) {
  constexpr std::size_t width = 99 - name_column;
  std::string lines;
  std::size_t line_start = 0;
  std::istringstream words(text);
  for (std::string word; words >> word;) {
    if (lines.size() > line_start) {
      const bool fits = lines.size() + 1 + word.size() - line_start <= width;
      lines += fits ? ' ' : '\n';
      if (!fits) line_start = lines.size();
    }
    lines += word;
  }
  return lines;
}

// The number that a value is or may hold.
template <typename Value>
struct NumberIn {
  using Type = Value;
};
template <typename Number>
struct NumberIn<std::optional<Number>> {
  using Type = Number;
};

// What stands for one of these names; others are refused.
inline CLI::Validator one_of(const std::vector<std::string>& names) {
  const std::string list = fmt::format("{}", fmt::join(names, ", "));
  return CLI::Validator(
      [names, list](const std::string& name) {
        const bool is_one = std::find(names.begin(), names.end(), name) != names.end();
        return is_one ? std::string() : "found " + name + ", expected one of " + list;
      },
      "{" + list + "}");
}

// A whole number as people type it, 2e6 as well as 2000000, is written in digits; all else is
// refused with what was found.
inline CLI::Validator whole_number(double least, double most) {
  constexpr double exact = 9007199254740992;  // doubles have all whole numbers up to it
  return CLI::Validator(
      [least, most](std::string& text) {
        const std::optional<double> number = parse_number(text);
        if (number && *number >= least && *number <= most && *number == std::floor(*number)) {
          if (*number <= exact) text = fmt::format("{:.0f}", *number);
          if (parse_whole_number(text)) return std::string();
        }
        return most < exact
                   ? fmt::format("found {}, expected a whole number from {:.0f} to {:.0f}", text,
                                 least, most)
                   : fmt::format("found {}, expected a whole number >= {:.0f}", text, least);
      },
      "");
}

inline CLI::Validator any_number() {
  return CLI::Validator(
      [](const std::string& text) {
        return parse_number(text) ? std::string() : "found " + text + ", expected a number";
      },
      "");
}

// An option that takes one number: within these limits, or any that the value can hold.
template <typename Value>
CLI::Option* add_number(CLI::App& sub, const char* names, Value& value, const char* type,
                        const char* help, std::optional<std::pair<int, int>> limits = {}) {
  using Number = typename NumberIn<Value>::Type;
  CLI::Option* const option = sub.add_option(names, value, wrapped(help))->type_name(type);
  if constexpr (std::is_integral_v<Number>) {
    const double least = limits ? limits->first : 0;
    const double most =
        limits ? limits->second : static_cast<double>(std::numeric_limits<Number>::max());
    return option->transform(whole_number(least, most));
  } else {
    return option->check(any_number());
  }
}

// Each command's options live as long as its `run`, which CLI11 fills in and we call.
template <typename Options>
CLI::App* add_command(CLI::App& app, Run& run, const char* name, const char* description,
                      const std::shared_ptr<Options>& options,
                      std::function<int(const Options&)> command) {
  CLI::App* const sub = app.add_subcommand(name, description);
  sub->callback(
      [&run, options, command] { run = [options, command] { return command(*options); }; });
  return sub;
}

// Describe `splotchcl info`, `fields` and `palettes`: what a snapshot holds, and the names that
// scenes may use.
void add_info(CLI::App& app, Run& run, Console& console);
void add_index(CLI::App& app, Run& run, Console& console);
void add_tree(CLI::App& app, Run& run, Console& console);
void add_fields(CLI::App& app, Run& run, Console& console);
void add_palettes(CLI::App& app, Run& run, Console& console);

// Describe `splotchcl generate`, `galaxy` and `evolve`, which make snapshots.
void add_generate(CLI::App& app, Run& run, Console& console);
void add_galaxy(CLI::App& app, Run& run, Console& console);
void add_evolve(CLI::App& app, Run& run, Console& console);

void add_map(CLI::App& app, Run& run, Console& console);

void add_view(CLI::App& app, Run& run, Console& console);

}  // namespace splotchcl::cli
