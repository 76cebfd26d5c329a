#include "architecture/project_files.h"
#include "architecture/rules.h"
#include "testing.h"

namespace splotchcl::test {
namespace {

namespace fs = std::filesystem;

constexpr const char* public_folder = "include";
// Headers that the build writes: text that is embedded.
constexpr const char* generated_folder = "splotchcl_embedded";

struct Include {
  fs::path file;  // that includes
  std::string text;
  const Target* from = nullptr;
  const Target* to = nullptr;  // null: no file of the project is called so
};

// Where an include is found, as the compiler looks for it.
std::optional<fs::path> find_included(const fs::path& root, const fs::path& file,
                                      const std::string& text) {
  for (const fs::path& folder :
       {file.parent_path(), fs::path("src"), fs::path(public_folder), fs::path()}) {
    const fs::path found = (folder / text).lexically_normal();
    if (fs::is_regular_file(root / found)) return found;
  }
  return std::nullopt;
}

const Target* owner_of(const TargetTable& table, const fs::path& file) {
  const fs::path as_included = file.lexically_relative(public_folder);
  const bool is_public = !as_included.empty() && *as_included.begin() != "..";
  return is_public ? table.owner_of_header(as_included.string()) : table.owner_of_file(file);
}

// All includes of files that belong to a target.
std::vector<Include> find_includes(const TargetTable& table, const fs::path& root) {
  std::vector<Include> includes;
  for (const char* const folder : {"src", public_folder}) {
    for (const fs::path& file : source_files(root, folder)) {
      const Target* const from = owner_of(table, file);
      if (from == nullptr) continue;  // told as a stray file
      for (const std::string& text : quoted_includes(root / file)) {
        if (*fs::path(text).begin() == generated_folder) continue;
        const std::optional<fs::path> found = find_included(root, file, text);
        includes.push_back({file, text, from, found ? owner_of(table, *found) : nullptr});
      }
    }
  }
  return includes;
}

}  // namespace

std::vector<std::string> find_wrong_includes(const TargetTable& table, const fs::path& root) {
  std::vector<std::string> wrong;
  for (const Include& include : find_includes(table, root)) {
    const std::string what = include.file.string() + " includes " + include.text;
    if (include.to == nullptr) {
      wrong.push_back(what + ", which is in no target");
    } else if (table.may_include(*include.from).count(include.to->name) == 0) {
      wrong.push_back(what + ", but " + include.from->name + " does not link " + include.to->name);
    }
  }
  return wrong;
}

std::vector<std::string> find_idle_links(const TargetTable& table, const fs::path& root) {
  std::map<std::string, std::set<std::string>> used;
  for (const Include& include : find_includes(table, root)) {
    if (include.to != nullptr) used[include.from->name].insert(include.to->name);
  }
  std::vector<std::string> idle;
  for (const Target& target : table.targets()) {
    for (const std::string& link : target.links) {
      if (used[target.name].count(link) == 0)
        idle.push_back(target.name + " links " + link + ", of which it includes nothing");
    }
  }
  return idle;
}

std::vector<std::string> find_stray_headers(const TargetTable& table, const fs::path& root) {
  std::map<std::string, int> owners;
  for (const fs::path& file : source_files(root, public_folder))
    owners[file.lexically_relative(public_folder).string()] = 0;
  std::vector<std::string> strays;
  for (const Target& target : table.targets()) {
    for (const std::string& header : target.public_headers) {
      const auto owned = owners.find(header);
      if (owned == owners.end()) {
        strays.push_back(header + " of " + target.name + " does not exist");
      } else {
        ++owned->second;
      }
    }
  }
  for (const auto& [header, count] : owners) {
    if (count != 1) strays.push_back(header + " belongs to " + std::to_string(count) + " targets");
  }
  return strays;
}

std::vector<std::string> find_stray_files(const TargetTable& table, const fs::path& root) {
  std::vector<std::string> strays;
  for (const fs::path& file : source_files(root, "src")) {
    if (table.owner_of_file(file) == nullptr) strays.push_back(file.string());
  }
  return strays;
}

}  // namespace splotchcl::test
