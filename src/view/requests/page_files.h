#pragma once

#include <optional>
#include <string_view>

namespace splotchcl::view {

// A file of the page, which is embedded in the program.
struct PageFile {
  std::string_view text;
  std::string_view type;  // as HTTP names it
};

// By its name, "app.js"; the page itself has none. Nothing where there is no such file.
std::optional<PageFile> find_page_file(std::string_view name);

}  // namespace splotchcl::view
