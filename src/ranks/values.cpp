#include "ranks/values.h"

#include <algorithm>

namespace splotchcl {

std::vector<std::uint64_t> gather_values(Communicator& ranks, std::uint64_t own) {
  Communicator::Bytes bytes(sizeof(own));
  std::memcpy(bytes.data(), &own, sizeof(own));
  std::vector<std::uint64_t> values;
  for (const Communicator::Bytes& of_rank : ranks.gather(bytes)) {
    values.emplace_back();
    std::memcpy(&values.back(), of_rank.data(), sizeof(own));
  }
  return values;
}

std::vector<std::string> gather_texts(Communicator& ranks, const std::string& own) {
  Communicator::Bytes bytes(own.size());
  std::transform(own.begin(), own.end(), bytes.begin(),
                 [](char letter) { return static_cast<std::byte>(letter); });
  std::vector<std::string> texts;
  for (const Communicator::Bytes& of_rank : ranks.gather(bytes)) {
    std::string& text = texts.emplace_back(of_rank.size(), '\0');
    std::transform(of_rank.begin(), of_rank.end(), text.begin(),
                   [](std::byte letter) { return static_cast<char>(letter); });
  }
  return texts;
}

std::vector<std::uint64_t> gather_lists(Communicator& ranks,
                                        const std::vector<std::uint64_t>& own) {
  Communicator::Bytes bytes(own.size() * sizeof(std::uint64_t));
  if (!bytes.empty()) std::memcpy(bytes.data(), own.data(), bytes.size());
  std::vector<std::uint64_t> all;
  for (const Communicator::Bytes& of_rank : ranks.gather(bytes)) {
    const std::size_t before = all.size();
    all.resize(before + of_rank.size() / sizeof(std::uint64_t));
    if (!of_rank.empty()) std::memcpy(all.data() + before, of_rank.data(), of_rank.size());
  }
  return all;
}

std::uint64_t smallest_of(Communicator& ranks, std::uint64_t own) {
  const std::vector<std::uint64_t> values = gather_values(ranks, own);
  return *std::min_element(values.begin(), values.end());
}

void join_stretches(Communicator& ranks, std::vector<float>& values,
                    const std::vector<std::size_t>& begins) {
  for (std::size_t rank = 0; rank + 1 < begins.size(); ++rank) {
    const std::size_t count = begins[rank + 1] - begins[rank];
    if (count > 0)
      ranks.broadcast(values.data() + begins[rank], count * sizeof(float), static_cast<int>(rank));
  }
}

void add_up(Communicator& ranks, const std::vector<std::uint64_t*>& counts) {
  std::vector<std::uint64_t> sums;
  for (const std::uint64_t* const count : counts)
    sums.push_back(*count);
  ranks.add_up(sums);
  for (std::size_t i = 0; i < counts.size(); ++i)
    *counts[i] = sums[i];
}

}  // namespace splotchcl
