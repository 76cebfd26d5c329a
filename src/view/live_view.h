#pragma once

#include <chrono>
#include <cstdint>
#include <memory>
#include <string>
#include <vector>

#include "splotchcl/open_scene.h"
#include "splotchcl/renderer.h"

namespace splotchcl::view {

struct LiveViewOptions {
  std::string device;  // as FrameDrawerOptions has it
  CompositeShape shape = CompositeShape::automatic;
  std::string address = "127.0.0.1";  // what the server is bound to
  std::uint16_t port = 0;             // 0: one that is free
  std::string framed_in = {};         // as AccessRules has it
};

// A scene that is looked at in a browser (docs/view.md).
class LiveView {
 public:
  // Decides what the scene leaves to the data, and listens; `notes` takes what the user should
  // know. Throws as decide does, DeviceError, UsageError for what is no address, DataError where it
  // cannot be listened on.
  LiveView(SceneWithSnapshot source, const LiveViewOptions& options,
           std::vector<std::string>& notes);
  ~LiveView();

  // Of the page, with the token that lets one see it.
  std::string address() const;
  // Until SIGINT or SIGTERM comes.
  void run();
  // Ends what is being drawn, where that ends so soon. A frame that has one part does not. Returns
  // whether it has ended.
  bool end_within(std::chrono::milliseconds patience);

 private:
  struct State;
  std::unique_ptr<State> state_;
  std::string address_;
};

}  // namespace splotchcl::view
