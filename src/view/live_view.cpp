#include "view/live_view.h"

#include <fmt/format.h>

#include <utility>

#include "view/draw_loop.h"
#include "view/page_server.h"
#include "view/requests/page_requests.h"

namespace splotchcl::view {

struct LiveView::State {
  State(SceneWithSnapshot source, const LiveViewOptions& options, std::vector<std::string>& notes)
      : token(make_token()),
        pages(std::move(source), {options.device, options.shape, {}}, notes),
        server(options.address, options.port,
               AccessRules(token, options.address, options.framed_in), pages) {}
  // What is drawn at the end is still sent by the server.
  ~State() { pages.stop(); }
  State(const State&) = delete;
  State& operator=(const State&) = delete;

  std::string token;
  DrawLoop pages;
  PageServer server;
};

LiveView::LiveView(SceneWithSnapshot source, const LiveViewOptions& options,
                   std::vector<std::string>& notes)
    : state_(std::make_unique<State>(std::move(source), options, notes)),
      address_(options.address) {}
LiveView::~LiveView() = default;

std::string LiveView::address() const {
  const bool is_version_6 = address_.find(':') != std::string::npos;
  const std::string host = is_version_6 ? "[" + address_ + "]" : address_;
  return fmt::format("http://{}:{}/{}/", host, state_->server.port(), state_->token);
}

void LiveView::run() {
  state_->server.run();
}

bool LiveView::end_within(std::chrono::milliseconds patience) {
  return state_->pages.stop_within(patience);
}

}  // namespace splotchcl::view
