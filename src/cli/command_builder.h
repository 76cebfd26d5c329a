#pragma once

#include <CLI/CLI.hpp>
#include <cstddef>
#include <functional>
#include <memory>
#include <sstream>
#include <string>

#include "cli/console.h"

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
