#include <fmt/format.h>
#include <unistd.h>

#include <chrono>
#include <csignal>
#include <iostream>
#include <string>
#include <utility>
#include <vector>

#include "cli/command_builder.h"
#include "cli/commands.h"
#include "cli/scene_options.h"
#include "common/unfinished_file.h"
#include "splotchcl/error.h"
#include "splotchcl/open_scene.h"
#include "splotchcl/snapshot.h"
#include "view/draw_loop.h"
#include "view/page_server.h"
#include "view/requests/page_requests.h"

namespace splotchcl::cli {

void add_view(CLI::App& app, Run& run, Console& console) {
  const auto options = std::make_shared<ViewOptions>();
  CLI::App* const sub =
      add_command<ViewOptions>(app, run, "view", "Explore a scene in a browser", options,
                               [&console](const ViewOptions& o) { return run_view(o, console); });
  sub->add_option("SCENE", options->scene, wrapped("A scene file (.toml, .par) or a snapshot"))
      ->required();
  add_number(*sub, "--port", options->port, "N", "Port of the page; 0: any that is free")
      ->capture_default_str();
  sub->add_option("--bind", options->address,
                  wrapped("Address to listen on. Any other than this machine's own lets others on "
                          "the network in, who can see the token on its way"))
      ->type_name("ADDRESS")
      ->capture_default_str();
  sub->add_option("--frame-in", options->framed_in,
                  wrapped("The page of a notebook or the like that may show this one in a frame, "
                          "by its origin, such as http://localhost:8888"))
      ->type_name("ORIGIN");
  add_live_options(*sub, *options);
  sub->footer(
      "Prints the page's address, which holds a secret token, and serves it until Ctrl-C.\n"
      "For a remote machine run splotchcl view FILE --port 8765 there and\n"
      "ssh -L 8765:127.0.0.1:8765 MACHINE here, and open the address printed there.\n"
      "Examples:\n"
      "  splotchcl view snapshot_006\n"
      "  splotchcl view snapshot_006 --types gas --center densest --width 4Mpc\n"
      "  splotchcl view scene.toml --port 8765");
}

namespace {

constexpr std::chrono::milliseconds patience_at_the_end(1000);

// Nothing ends a device that draws. What is taken apart would give back the handler of Ctrl-C, and
// the second one would end the program by its signal.
[[noreturn]] void leave_all_as_it_is() {
  remove_unfinished_files();
  ::_exit(0);
}

// Once the server is gone that heard it, Ctrl-C would end the program before it could tell what
// went wrong.
struct DeafAtTheEnd {
  ~DeafAtTheEnd() {
    std::signal(SIGINT, SIG_IGN);
    std::signal(SIGTERM, SIG_IGN);
  }
};

// A scene that is looked at in a browser (docs/view.md).
struct LiveView {
  LiveView(SceneWithSnapshot source, const ViewOptions& options, std::vector<std::string>& notes)
      : token(view::make_token()),
        pages(std::move(source), {options.device, {}, {}}, notes),
        server(options.address, options.port,
               view::AccessRules(token, options.address, options.framed_in), pages) {}
  // What is drawn at the end is still sent by the server.
  ~LiveView() { pages.stop(); }
  LiveView(const LiveView&) = delete;
  LiveView& operator=(const LiveView&) = delete;

  std::string token;
  view::DrawLoop pages;
  DeafAtTheEnd deaf;
  view::PageServer server;
};

// With the token that lets one see the page.
std::string address_of(const LiveView& view, const std::string& bound_to) {
  const bool is_version_6 = bound_to.find(':') != std::string::npos;
  const std::string host = is_version_6 ? "[" + bound_to + "]" : bound_to;
  return fmt::format("http://{}:{}/{}/", host, view.server.port(), view.token);
}

bool is_own_address(const std::string& address) {
  return address.rfind("127.", 0) == 0 || address == "::1";
}

}  // namespace

int run_view(const ViewOptions& options, Console& console) {
  if (!is_own_address(options.address)) {
    console.note("--bind " + options.address +
                 ": others on the network reach the page, and what it sends is not encrypted; "
                 "ssh -L is the safe way from another machine");
  }
  console.status("reading");
  SceneWithSnapshot source = open_scene(options.scene, settings_of(options));
  std::vector<std::string> notes = source.notes;
  const std::vector<std::string>& of_snapshot = source.snapshot->info().notes;
  notes.insert(notes.end(), of_snapshot.begin(), of_snapshot.end());
  LiveView view(std::move(source), options, notes);
  console.note_each_once(notes);
  console.done("the page is at the address below until Ctrl-C");
  std::cout << address_of(view, options.address) << std::endl;
  if (!std::cout) {
    throw DataError(
        "standard output could not be written, where the page's address stands: is the disk full?");
  }
  view.server.run();
  view.pages.stop_within(patience_at_the_end);
  leave_all_as_it_is();
}

}  // namespace splotchcl::cli
