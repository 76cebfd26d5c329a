#include "ranks/exchange.h"

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <exception>
#include <new>
#include <vector>

#include "splotchcl/error.h"

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

namespace {

template <class Kind>
class Agreed : public Kind, public AgreedFailure {
 public:
  using Kind::Kind;
};

// Another rank has failed: what it says is asked for where the work began. No Error, so that nobody
// on the way takes it for one.
struct Interrupted {};

bool have_failed(Communicator& ranks, bool own) {
  std::vector<std::uint64_t> failed = {own ? 1u : 0u};
  ranks.add_up(failed);
  return failed.front() > 0;
}

[[noreturn]] void fail(char kind, const std::string& message) {
  if (kind == 'U') throw Agreed<UsageError>(message);
  if (kind == 'V') throw Agreed<DeviceError>(message);
  throw Agreed<DataError>(message);
}

}  // namespace

// The first letter says which, the rest is the message; empty: none.
std::string told(const std::function<void()>& work) {
  try {
    work();
    return "";
  } catch (const AgreedFailure&) {
    throw;
  } catch (const UsageError& error) {
    return std::string("U") + error.what();
  } catch (const DeviceError& error) {
    return std::string("V") + error.what();
  } catch (const Error& error) {
    return std::string("D") + error.what();
  } catch (const std::bad_alloc&) {
    return "Dout of memory; fewer particles, a smaller picture or fewer processes on one machine "
           "need less";
  } catch (const std::exception& failure) {
    return std::string("D") + failure.what();
  }
}

void agree(Communicator* ranks, const std::function<void()>& work) {
  if (ranks == nullptr) {
    work();
    return;
  }
  std::string own;
  try {
    own = told(work);
    if (!have_failed(*ranks, !own.empty())) return;
  } catch (const Interrupted&) {
  }
  settle(*ranks, own);
}

void wait_for_all(Communicator& ranks) {
  if (have_failed(ranks, false)) throw Interrupted();
}

void settle(Communicator& ranks, const std::string& own) {
  const std::vector<std::string> all = gather_texts(ranks, own);
  const auto first =
      std::find_if(all.begin(), all.end(), [](const std::string& text) { return !text.empty(); });
  if (first == all.end()) return;
  const bool is_own = first - all.begin() == ranks.rank();
  if (!is_own) throw FailedElsewhere(first->front() == 'U');
  const bool all_alike =
      std::all_of(all.begin(), all.end(), [&](const std::string& text) { return text == *first; });
  const std::string where =
      all_alike ? "" : "process " + std::to_string(ranks.rank()) + " on " + ranks.host() + ": ";
  fail(first->front(), where + first->substr(1));
}

void require_same(Communicator& ranks, const std::string& what, const std::string& own,
                  const std::string& advice) {
  const std::vector<std::string> all = gather_texts(ranks, own);
  const std::vector<std::string> hosts = gather_texts(ranks, ranks.host());
  for (std::size_t other = 1; other < all.size(); ++other) {
    if (all[other] == all[0]) continue;
    if (ranks.rank() != 0) throw FailedElsewhere(false);
    throw Agreed<DeviceError>("process " + std::to_string(other) + " on " + hosts[other] +
                              ": found " + what + " " + all[other] +
                              ", expected that of process 0 on " + hosts[0] + ", " + all[0] +
                              ", since pictures of the two differ; " + advice);
  }
}

}  // namespace splotchcl
