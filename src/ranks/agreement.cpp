#include "ranks/agreement.h"

#include <algorithm>
#include <cstddef>
#include <new>
#include <vector>

#include "ranks/values.h"
#include "splotchcl/error.h"

namespace splotchcl {
namespace {

template <class Kind>
class Agreed : public Kind, public AgreedFailure {
 public:
  using Kind::Kind;
};

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
  } catch (const UsageError& error) {
    return std::string("U") + error.what();
  } catch (const DeviceError& error) {
    return std::string("V") + error.what();
  } catch (const Error& error) {
    return std::string("D") + error.what();
  } catch (const std::bad_alloc&) {
    return "Dout of memory; fewer particles, a smaller picture or fewer processes on one machine "
           "need less";
  } catch (const FailedElsewhere& elsewhere) {
    return elsewhere.is_usage() ? "u" : "d";
  }
}

void agree(Communicator* ranks, const std::function<void()>& work) {
  if (ranks == nullptr) {
    work();
    return;
  }
  settle(*ranks, told(work));
}

void settle(Communicator& ranks, const std::string& own) {
  const std::vector<std::string> all = gather_texts(ranks, own);
  const auto first =
      std::find_if(all.begin(), all.end(), [](const std::string& text) { return !text.empty(); });
  if (first == all.end()) return;
  const bool is_own = first - all.begin() == ranks.rank();
  if (!is_own || first->size() == 1) throw FailedElsewhere(first->front() == 'U' || *first == "u");
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
