#include "formats/hdf5/hdf5_steps.h"

#include <algorithm>
#include <array>
#include <map>
#include <utility>

#include "common/words.h"
#include "snapshot/field_names.h"

namespace splotchcl {
namespace {

struct NumberedName {
  std::string stem;
  std::string number;  // without leading zeros
};

NumberedName split_number(const std::string& name) {
  const std::size_t last = name.find_last_not_of("0123456789");
  const std::size_t digits = last == std::string::npos ? 0 : last + 1;
  const std::size_t significant = std::min(name.find_first_not_of('0', digits), name.size());
  return {name.substr(0, digits), digits == name.size() ? "" : "0" + name.substr(significant)};
}

bool is_stem_of_steps(const std::string& stem) {
  constexpr std::array<const char*, 10> known = {"",     "step", "timestep", "time",  "snapshot",
                                                 "snap", "t",    "frame",    "cycle", "output"};
  const std::string word = lower_case(trimmed(stem.substr(stem.rfind('/') + 1), "#_-. "));
  return std::find(known.begin(), known.end(), word) != known.end();
}

std::optional<double> time_of(const Hdf5File& file, const std::string& group) {
  const auto time = file.number(group, "time");
  return time ? time : file.number(group, "Time");
}

bool are_steps(const Hdf5File& file, const std::string& stem,
               const std::vector<std::string>& groups) {
  if (groups.size() < 2) return false;
  return is_stem_of_steps(stem) ||
         std::all_of(groups.begin(), groups.end(),
                     [&](const std::string& group) { return time_of(file, group).has_value(); });
}

bool is_before(const std::string& a, const std::string& b) {
  const std::string x = split_number(a).number, y = split_number(b).number;
  return x.size() != y.size() ? x.size() < y.size() : x < y;
}

}  // namespace

namespace {

// A group that may be a step, and how its numbered name begins.
struct NumberedGroup {
  std::string stem, path;
};

// On the way to a group of particles, from the outside in.
std::vector<NumberedGroup> numbered_groups(const std::string& path) {
  std::vector<NumberedGroup> groups;
  for (std::size_t end = path.find('/', 1);; end = path.find('/', end + 1)) {
    const std::string group = path.substr(0, end);
    const NumberedName name = split_number(group);
    const bool may_be_step =
        !name.number.empty() && !find_particle_type(group.substr(group.rfind('/') + 1));
    if (may_be_step) groups.push_back({name.stem, group});
    if (end == std::string::npos) return groups;
  }
}

// Groups of other names, each at a time of its own.
std::vector<std::string> steps_by_time(const Hdf5File& file,
                                       const std::vector<std::string>& groups) {
  std::map<double, std::string> by_time;
  for (const std::string& group : groups) {
    const auto time = time_of(file, group);
    const bool is_type = find_particle_type(group.substr(group.rfind('/') + 1)).has_value();
    if (!time || is_type || !by_time.emplace(*time, group).second) return {};
  }
  std::vector<std::string> steps;
  for (const auto& [time, group] : by_time)
    steps.push_back(group);
  return steps.size() > 1 ? steps : std::vector<std::string>();
}

}  // namespace

std::vector<std::string> find_steps(const Hdf5File& file, const std::vector<std::string>& groups) {
  std::map<std::string, std::vector<std::string>> by_stem;
  for (const std::string& group : groups) {
    for (const NumberedGroup& numbered : numbered_groups(group)) {
      std::vector<std::string>& steps = by_stem[numbered.stem];
      if (std::find(steps.begin(), steps.end(), numbered.path) == steps.end())
        steps.push_back(numbered.path);
    }
  }
  for (auto& [stem, steps] : by_stem) {
    if (!are_steps(file, stem, steps)) continue;
    std::sort(steps.begin(), steps.end(), is_before);
    return std::move(steps);
  }
  return steps_by_time(file, groups);
}

}  // namespace splotchcl
