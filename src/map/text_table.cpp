#include <fmt/format.h>

#include <cmath>

#include "map/map_files.h"

namespace splotchcl {
namespace {

// YAML in double quotes, on one line.
std::string quoted(const std::string& text) {
  std::string line = "\"";
  for (const char c : text) {
    if (c == '"' || c == '\\') line += '\\';
    line += c == '\n' ? "\\n" : std::string(1, c);
  }
  return line + "\"";
}

// The enhanced CSV of astropy (APE 6): its header is YAML behind marks of comments.
std::string header_of(const Map& map, const MapMetadata& metadata) {
  const std::string length = fits_unit(map.axes[0].unit), value = fits_unit(map.unit);
  std::string header = "# %ECSV 1.0\n# ---\n# delimiter: ','\n# datatype:\n";
  const std::pair<const char*, const std::string*> columns[] = {
      {"inner", &length}, {"outer", &length}, {"value", &value}};
  for (const auto& [name, unit] : columns)
    header += fmt::format("# - {{name: {}, unit: {}, datatype: float64}}\n", name, quoted(*unit));
  header += fmt::format("# meta:\n#   quantity: {}\n", quoted(map.quantity));
  for (const auto& [key, text] : metadata)
    header += fmt::format("#   {}: {}\n", quoted(key), quoted(text));
  return header + "# schema: astropy-2.0\ninner,outer,value\n";
}

std::string plain_header(const Map& map) {
  return fmt::format("inner [{0}],outer [{0}],{1} [{2}]\n", map.axes[0].unit, map.quantity,
                     map.unit);
}

}  // namespace

std::string profile_as_text(const Map& map, bool with_header, const MapMetadata& metadata) {
  std::string text = with_header ? header_of(map, metadata) : plain_header(map);
  for (int i = 0; i < map.width; ++i) {
    const float value = map.values[static_cast<std::size_t>(i)];
    text += fmt::format("{:.9g},{:.9g},{}\n", map.axes[0].edge(i), map.axes[0].edge(i + 1),
                        std::isnan(value) ? "nan" : fmt::format("{:.9g}", value));
  }
  return text;
}

}  // namespace splotchcl
