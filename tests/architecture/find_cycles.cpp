#include "architecture/rules.h"
#include "testing.h"

namespace splotchcl::test {
namespace {

class CycleSearch {
 public:
  explicit CycleSearch(const TargetTable& table) : table_(table) {}

  void visit(const std::string& name) {
    const auto again = std::find(path_.begin(), path_.end(), name);
    if (again != path_.end()) {
      std::string cycle;
      for (auto step = again; step != path_.end(); ++step)
        cycle += *step + " -> ";
      cycles_.push_back(cycle + name);
      return;
    }
    const Target* const target = table_.find(name);
    if (target == nullptr || !finished_.insert(name).second) return;
    path_.push_back(name);
    for (const std::vector<std::string>* const links : {&target->links, &target->exports}) {
      for (const std::string& link : *links)
        visit(link);
    }
    path_.pop_back();
  }

  const std::vector<std::string>& cycles() const { return cycles_; }

 private:
  const TargetTable& table_;
  std::vector<std::string> path_;   // from where the search began
  std::set<std::string> finished_;  // seen before, or on the path
  std::vector<std::string> cycles_;
};

}  // namespace

std::vector<std::string> find_cycles(const TargetTable& table) {
  CycleSearch search(table);
  for (const Target& target : table.targets())
    search.visit(target.name);
  return search.cycles();
}

}  // namespace splotchcl::test
