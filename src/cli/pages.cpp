#include "cli/pages.h"

#include <string>
#include <system_error>

#include "cli/completion.h"
#include "cli/manual_pages.h"
#include "common/unfinished_file.h"
#include "splotchcl/error.h"

namespace splotchcl::cli {
namespace {

constexpr char source[] = "splotchcl " SPLOTCHCL_VERSION;

void write(const std::filesystem::path& path, const std::string& text) {
  std::error_code error;
  std::filesystem::create_directories(path.parent_path(), error);
  if (error) {
    throw DataError(path.parent_path().string() + ": " + error.message() +
                    ", expected a folder that can be made");
  }
  UnfinishedFile file(path);
  file.write(text.data(), text.size());
  file.finish();
}

}  // namespace

int write_pages(const CommandTree& tree, const std::filesystem::path& folder) {
  write(folder / "man1" / "splotchcl.1", program_page(tree, source));
  for (const CommandWords& command : tree.commands)
    write(folder / "man1" / ("splotchcl-" + command.name + ".1"), command_page(command, source));
  write(folder / "bash" / "splotchcl", bash_completion(tree));
  write(folder / "zsh" / "_splotchcl", zsh_completion(tree));
  write(folder / "fish" / "splotchcl.fish", fish_completion(tree));
  return 0;
}

}  // namespace splotchcl::cli
