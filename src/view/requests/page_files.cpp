#include "view/requests/page_files.h"

#include "splotchcl_embedded/view_page.h"

namespace splotchcl::view {
namespace {

std::string_view type_of(std::string_view name) {
  const std::string_view ending = name.substr(name.rfind('.') + 1);
  if (ending == "html") return "text/html; charset=utf-8";
  if (ending == "css") return "text/css; charset=utf-8";
  if (ending == "svg") return "image/svg+xml";
  return "text/javascript; charset=utf-8";
}

}  // namespace

std::optional<PageFile> find_page_file(std::string_view name) {
  if (name.empty()) name = "index.html";
  for (const embedded::TextFile& file : embedded::view_page()) {
    if (file.name == name) return PageFile{file.text, type_of(name)};
  }
  return std::nullopt;
}

}  // namespace splotchcl::view
