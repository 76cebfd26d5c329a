#pragma once

#include <cstdint>
#include <memory>
#include <string>

#include "view/draw_loop.h"
#include "view/requests/page_requests.h"

namespace splotchcl::view {

// Serves the page and its sockets, in the thread that calls run().
class PageServer {
 public:
  // Listens. `port` 0: one that is free. Throws UsageError for what is no address, DataError where
  // it cannot be listened on.
  PageServer(const std::string& address, std::uint16_t port, AccessRules rules, DrawLoop& pages);
  ~PageServer();

  std::uint16_t port() const;
  // Until SIGINT or SIGTERM comes.
  void run();

 private:
  struct State;
  std::unique_ptr<State> state_;
};

}  // namespace splotchcl::view
