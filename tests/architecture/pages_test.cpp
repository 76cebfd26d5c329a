// Pages: their links lead to what is there, the site has all of them, and they are not too long.
#include <cctype>

#include "matches.h"
#include "testing.h"

namespace splotchcl::test {
namespace {

namespace fs = std::filesystem;

std::string text_of(const fs::path& path) {
  std::ifstream file(path);
  return {std::istreambuf_iterator<char>(file), {}};
}

std::vector<fs::path> pages() {
  std::vector<fs::path> found;
  for (const char* name : {"README.md", "CHANGELOG.md", "SECURITY.md"})
    found.push_back(source_folder() / name);
  for (const fs::directory_entry& entry :
       fs::recursive_directory_iterator(source_folder() / "docs")) {
    if (entry.path().extension() == ".md") found.push_back(entry.path());
  }
  return found;
}

// Lines inside of ``` are examples: they hold neither headings nor links.
std::string without_examples(const std::string& page) {
  std::istringstream lines(page);
  std::string text;
  bool is_example = false;
  for (std::string line; std::getline(lines, line);) {
    if (line.rfind("```", 0) == 0) is_example = !is_example;
    if (!is_example) text += line + '\n';
  }
  return text;
}

// As GitHub makes a heading's anchor: lower case, hyphens for spaces, no punctuation.
std::string anchor_of(const std::string& heading) {
  std::string anchor;
  for (const char letter : heading) {
    const auto byte = static_cast<unsigned char>(letter);
    if (letter == ' ') anchor += '-';
    if (std::isalnum(byte) != 0 || letter == '-' || letter == '_' || byte >= 0x80)
      anchor += static_cast<char>(std::tolower(byte));
  }
  return anchor;
}

std::set<std::string> anchors_of(const fs::path& page) {
  std::set<std::string> anchors;
  for (const Match& found : matches_of(without_examples(text_of(page)), R"((?:^|\n)#+ ([^\n]+))"))
    anchors.insert(anchor_of(found[1]));
  return anchors;
}

bool leads_elsewhere(const std::string& target) {
  return target.rfind("http://", 0) == 0 || target.rfind("https://", 0) == 0;
}

class Anchors {
 public:
  bool hold(const fs::path& page, const std::string& anchor) {
    const auto [known, is_new] = known_.try_emplace(page);
    if (is_new) known->second = anchors_of(page);
    return known->second.count(anchor) > 0;
  }

 private:
  std::map<fs::path, std::set<std::string>> known_;
};

void expect_target(const fs::path& page, const std::string& target, Anchors& anchors) {
  const std::size_t mark = target.find('#');
  const std::string name = target.substr(0, mark);
  const fs::path file = name.empty() ? page : page.parent_path() / name;
  EXPECT_TRUE(fs::exists(file)) << page << " links " << target;
  if (mark == std::string::npos || file.extension() != ".md") return;
  EXPECT_TRUE(anchors.hold(fs::weakly_canonical(file), target.substr(mark + 1)))
      << page << " links " << target;
}

TEST(PageLinks, LeadToWhatIsThere) {
  Anchors anchors;
  std::size_t links = 0;
  for (const fs::path& page : pages()) {
    for (const Match& found : matches_of(without_examples(text_of(page)), R"(\]\(([^)\s]+)\))")) {
      if (leads_elsewhere(found[1])) continue;
      expect_target(page, found[1], anchors);
      ++links;
    }
  }
  EXPECT_GT(links, 100U);
}

TEST(Pages, AreAllInTheNavigationOfTheSite) {
  const std::string site = text_of(source_folder() / "mkdocs.yml");
  for (const fs::path& page : pages()) {
    const std::string name = fs::relative(page, source_folder() / "docs").generic_string();
    if (name.rfind("..", 0) == 0) continue;
    EXPECT_NE(site.find(": " + name + '\n'), std::string::npos) << name;
  }
}

TEST(Pages, AreFewEnoughWordsToBeRead) {
  std::size_t words = 0;
  for (const fs::path& page : pages()) {
    if (page.filename() == "CHANGELOG.md" || page.filename() == "SECURITY.md") continue;
    std::istringstream text(text_of(page));
    for (std::string word; text >> word;)
      ++words;
  }
  EXPECT_LT(words, 50'000U);
}

}  // namespace
}  // namespace splotchcl::test
