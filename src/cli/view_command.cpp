#include "cli/view_command.h"

#include "cli/commands.h"

namespace splotchcl::cli {

void add_view(CLI::App& app, Run& run, Console& console) {
  const auto options = std::make_shared<ViewOptions>();
  CLI::App* const sub =
      add_command<ViewOptions>(app, run, "view", "Explore a scene in a browser", options,
                               [&console](const ViewOptions& o) { return run_view(o, console); });
  sub->add_option("SCENE", options->scene, wrapped("A scene file (.toml, .par) or a snapshot"))
      ->required();
  sub->add_option("--port", options->port, wrapped("Port of the page; 0: any that is free"))
      ->type_name("N")
      ->capture_default_str();
  sub->add_option("--bind", options->address,
                  wrapped("Address to listen on. Any other than this machine's own lets others on "
                          "the network in, who can see the token on its way"))
      ->type_name("ADDRESS")
      ->capture_default_str();
  sub->add_option("--device", options->device,
                  wrapped("Part of an OpenCL device's name; splotchcl devices lists them"))
      ->type_name("NAME");
  sub->add_option("--set", options->settings, wrapped("Set a key of the scene; can be repeated"))
      ->type_name("KEY=VALUE")
      ->allow_extra_args(false);
  sub->add_option("--size", options->size, wrapped("Width and height of the picture, in pixels"))
      ->type_name("WIDTHxHEIGHT");
  sub->footer(
      "Prints the page's address, which holds a secret token, and serves it until Ctrl-C.\n"
      "For a remote machine run splotchcl view FILE --port 8765 there and\n"
      "ssh -L 8765:127.0.0.1:8765 MACHINE here, and open the address printed there.\n"
      "Examples:\n"
      "  splotchcl view snapshot_006\n"
      "  splotchcl view scene.toml --port 8765");
}

}  // namespace splotchcl::cli
