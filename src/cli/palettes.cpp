#include <fmt/format.h>

#include <algorithm>
#include <iostream>

#include "cli/commands.h"
#include "cli/json_answer.h"
#include "cli/palette_preview.h"
#include "common/output_files.h"
#include "common/utf8.h"
#include "splotchcl/error.h"
#include "splotchcl/image_file.h"
#include "splotchcl/palette_file.h"

namespace splotchcl::cli {
namespace {

struct ListedPalette {
  PaletteInfo info;
  Palette palette;
};

// Those that are named; all where none is. One of the user's files that is no palette does not keep
// the others from being listed.
std::vector<ListedPalette> choose(const std::vector<std::string>& names, Console& console) {
  std::vector<ListedPalette> chosen;
  const std::vector<PaletteInfo> all = list_palettes();
  for (const std::string& name : names) {
    const auto found = std::find_if(all.begin(), all.end(),
                                    [&](const PaletteInfo& info) { return info.name == name; });
    chosen.push_back({found == all.end() ? PaletteInfo{name, {}, ""} : *found, load_palette(name)});
  }
  if (!names.empty()) return chosen;
  for (const PaletteInfo& info : all) {
    try {
      chosen.push_back({info, load_palette(info.name)});
    } catch (const DataError& error) {
      console.note(std::string("left out: ") + error.what());
    }
  }
  return chosen;
}

// Where it comes from, if that is a file, and what its file says of it.
std::string remark(const PaletteInfo& info) {
  if (info.file.empty()) return info.description;
  const std::string separator = info.description.empty() ? "" : ": ";
  return info.file.string() + separator + info.description;
}

void print_text(const std::vector<ListedPalette>& palettes) {
  std::size_t width = 0;
  for (const ListedPalette& listed : palettes)
    width = std::max(width, listed.info.name.size());
  for (const ListedPalette& listed : palettes) {
    const std::string line = fmt::format("{:{}}  {:>3}  {}", listed.info.name, width,
                                         listed.palette.emission.size(), remark(listed.info));
    std::cout << printable(line) << "\n";
  }
}

Json json_of_palette(const ListedPalette& listed) {
  Json json = {{"name", listed.info.name},
               {"knots", listed.palette.emission.size()},
               {"has_own_absorption", listed.palette.has_own_absorption()},
               {"description", listed.info.description}};
  if (!listed.info.file.empty()) json["file"] = listed.info.file.string();
  return json;
}

std::set<std::filesystem::path> files_read(const PalettesOptions& options) {
  std::set<std::filesystem::path> files(options.names.begin(), options.names.end());
  for (const PaletteInfo& info : list_palettes()) {
    if (!info.file.empty()) files.insert(info.file);
  }
  return files;
}

void write_preview(const std::filesystem::path& path, const std::vector<ListedPalette>& listed) {
  std::vector<Palette> palettes;
  for (const ListedPalette& one : listed) {
    palettes.push_back(one.palette);
    palettes.back().name = one.info.name;
  }
  write_image(path, draw_palette_preview(palettes));
}

}  // namespace

int run_palettes(const PalettesOptions& options, Console& console) {
  if (options.preview) {
    check_image_path(*options.preview);
    check_outputs({{*options.preview, "--preview"}}, [&] { return files_read(options); });
  }
  const std::vector<ListedPalette> palettes = choose(options.names, console);
  if (options.preview) write_preview(*options.preview, palettes);
  if (options.json) {
    print_json_list(palettes, json_of_palette);
  } else {
    print_text(palettes);
  }
  return 0;
}

}  // namespace splotchcl::cli
