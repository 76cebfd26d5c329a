#include <fmt/format.h>

#include "cli/commands.h"
#include "common/output_files.h"
#include "common/unfinished_file.h"
#include "open_scene/input_files.h"
#include "splotchcl/error.h"
#include "splotchcl/open_scene.h"
#include "splotchcl/par_file.h"
#include "splotchcl/scene_file.h"

namespace splotchcl::cli {

int run_convert(const ConvertOptions& options, Console& console) {
  if (!is_par_file(options.par)) {
    throw UsageError(options.par.string() +
                     ": its name does not end in .par, expected a parameter file of the original "
                     "Splotch; of a snapshot, render --explain prints a scene file");
  }
  if (options.output.extension() != ".toml") {
    throw UsageError(options.output.string() +
                     ": its name does not end in .toml, expected the name of a scene file");
  }
  check_output_path(options.output);
  std::vector<std::string> notes;
  const Scene scene = read_par_file(options.par, options.settings, notes);
  check_outputs({{options.output, "--output"}}, [&] {
    InputFiles named;  // none of which need be there yet
    named.add(options.par);
    named.add_named_files(scene);
    return named.all();
  });
  for (const std::string& note : notes)
    console.note(note);
  const std::string text =
      fmt::format("# From {}.\n{}", options.par.filename().string(),
                  format_scene(with_paths_from(scene, options.output.parent_path())));
  UnfinishedFile file(options.output);
  file.write(text.data(), text.size());
  file.finish();
  return 0;
}

}  // namespace splotchcl::cli
