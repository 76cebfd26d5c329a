#include "fuzz/fuzz.h"
#include "splotchcl/scene_file.h"

// The first line is a setting, the rest a scene file. A scene that is read must come back the
// same from what is written of it.
void splotchcl::fuzz::fuzz_scene(const std::uint8_t* data, std::size_t size) {
  using namespace splotchcl;
  const std::string input(reinterpret_cast<const char*>(data), size);
  const std::size_t end = input.find('\n');
  const std::string setting = end == std::string::npos ? "" : input.substr(0, end);
  const std::string text = end == std::string::npos ? input : input.substr(end + 1);
  try {
    const Scene scene = parse_scene(
        text, "fuzz", setting.empty() ? std::vector<std::string>() : std::vector{setting});
    const std::string written = format_scene(scene);
    try {
      if (format_scene(parse_scene(written, "written")) != written) std::abort();
    } catch (const Error& error) {
      std::fprintf(stderr, "%s\n%s\n", error.what(), written.c_str());
      std::abort();
    }
  } catch (const Error&) {
    // refused
  }
}
