#include "sequence/match_ids.h"

#include <algorithm>

#include "splotchcl/error.h"

namespace splotchcl {
namespace {

struct IdPlace {
  std::uint64_t id;
  std::uint32_t place;
};

std::vector<IdPlace> sorted_by_id(const std::vector<std::uint64_t>& ids) {
  if (ids.size() >= IdMatch::nobody) {
    throw DataError(
        "snapshots are matched for up to 4 billion particles of a type; set time.interpolation to "
        "\"none\"");
  }
  std::vector<IdPlace> sorted;
  sorted.reserve(ids.size());
  for (std::size_t i = 0; i < ids.size(); ++i)
    sorted.push_back({ids[i], static_cast<std::uint32_t>(i)});
  std::sort(sorted.begin(), sorted.end(),
            [](const IdPlace& a, const IdPlace& b) { return a.id < b.id; });
  return sorted;
}

// How many from `i` on have the id of `i`.
std::size_t run_length(const std::vector<IdPlace>& sorted, std::size_t i) {
  std::size_t end = i + 1;
  while (end < sorted.size() && sorted[end].id == sorted[i].id)
    ++end;
  return end - i;
}

}  // namespace

IdMatch match_ids(const std::vector<std::uint64_t>& first,
                  const std::vector<std::uint64_t>& second) {
  const std::vector<IdPlace> a = sorted_by_id(first);
  const std::vector<IdPlace> b = sorted_by_id(second);
  IdMatch match;
  match.place_in_second.assign(first.size(), IdMatch::nobody);
  const auto appear = [&](std::size_t from, std::size_t count) {
    for (std::size_t k = from; k < from + count; ++k)
      match.appearing.push_back(b[k].place);
  };
  std::size_t i = 0, j = 0;
  while (i < a.size() || j < b.size()) {
    const bool takes_a = j == b.size() || (i < a.size() && a[i].id <= b[j].id);
    const bool takes_b = i == a.size() || (j < b.size() && b[j].id <= a[i].id);
    const std::size_t of_a = takes_a ? run_length(a, i) : 0;
    const std::size_t of_b = takes_b ? run_length(b, j) : 0;
    if (of_a == 1 && of_b == 1) {
      match.place_in_second[a[i].place] = b[j].place;
      ++match.in_common;
    } else {
      appear(j, of_b);
      match.ambiguous += (of_a > 1 ? of_a : 0) + (of_b > 1 ? of_b : 0);
    }
    i += of_a;
    j += of_b;
  }
  std::sort(match.appearing.begin(), match.appearing.end());
  return match;
}

}  // namespace splotchcl
