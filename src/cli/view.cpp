#include <unistd.h>

#include <chrono>
#include <iostream>

#include "cli/commands.h"
#include "common/unfinished_file.h"
#include "splotchcl/error.h"
#include "splotchcl/open_scene.h"
#include "splotchcl/snapshot.h"
#include "view/live_view.h"

namespace splotchcl::cli {
namespace {

constexpr std::chrono::milliseconds patience_at_the_end(1000);

// Nothing ends a device that draws. What is taken apart would give back the handler of Ctrl-C, and
// the second one would end the program by its signal.
[[noreturn]] void leave_all_as_it_is() {
  remove_unfinished_files();
  ::_exit(0);
}

bool is_own_address(const std::string& address) {
  return address.rfind("127.", 0) == 0 || address == "::1";
}

std::vector<std::string> settings_of(const ViewOptions& options) {
  std::vector<std::string> settings = options.settings;
  if (options.size) settings.push_back("image.size=" + *options.size);
  return settings;
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
  view::LiveView page(std::move(source), {options.device, {}, options.address, options.port},
                      notes);
  console.note_each_once(notes);
  console.done("the page is at the address below until Ctrl-C");
  std::cout << page.address() << std::endl;
  if (!std::cout) {
    throw DataError(
        "standard output could not be written, where the page's address stands: is the disk full?");
  }
  page.run();
  page.end_within(patience_at_the_end);
  leave_all_as_it_is();
}

}  // namespace splotchcl::cli
