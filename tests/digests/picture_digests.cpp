// Prints a digest of the float pixels of many pictures, a line each, so that two versions of
// the program can be compared bit for bit on one machine (scripts/digests).
// usage: picture_digests [--scene NAME FILE KEY=VALUE... ]...
// Without scenes: 200 random scenes, both shapes, tolerances from 1e-2 to 0.
#include <cstdio>

#include "frames/random_frames.h"
#include "splotchcl/load.h"
#include "splotchcl/picture.h"
#include "splotchcl/renderer.h"
#include "splotchcl/scene_file.h"
#include "splotchcl/snapshot.h"
#include "splotchcl/snapshot_file.h"
#include "testing.h"

namespace splotchcl::test {
namespace {

// FNV-1a over the bits of all pixels.
std::uint64_t digest_of(const Image& image) {
  std::uint64_t hash = 14695981039346656037ULL;
  for (const float pixel : image.pixels) {
    std::uint32_t bits = 0;
    std::memcpy(&bits, &pixel, sizeof(bits));
    hash = (hash ^ bits) * 1099511628211ULL;
  }
  return hash;
}

class Digests {
 public:
  void add(const std::string& name, const Frame& frame, bool rows, bool groups) {
    if (rows) print(name + " rows", rows_.render(frame));
    if (groups) print(name + " groups", groups_.render(frame));
  }

 private:
  static void print(const std::string& name, const Image& image) {
    std::printf("%s %dx%d %016llx\n", name.c_str(), image.width, image.height,
                static_cast<unsigned long long>(digest_of(image)));
    std::fflush(stdout);
  }

  Renderer rows_{{"", CompositeShape::rows}}, groups_{{"", CompositeShape::groups}};
};

void add_random_scenes(Digests& digests) {
  constexpr double tolerances[] = {1e-2, 1e-3, 1e-4, 1e-5, 0};
  for (std::uint64_t seed = 1; seed <= 160; ++seed) {
    Frame frame = SceneMaker(seed).make();
    frame.tolerance = tolerances[seed % 5];
    digests.add("random " + std::to_string(seed), frame, seed % 4 != 0, seed % 4 < 2);
  }
  for (std::uint64_t seed = 1; seed <= 40; ++seed) {
    Frame frame = WideSceneMaker(seed).make();
    if (seed % 4 == 0) frame.tolerance = tolerances[seed / 4 % 5];
    digests.add("wide " + std::to_string(seed), frame, seed % 3 != 0, seed % 3 == 0);
  }
}

void add_scene(const std::string& name, const std::string& file,
               const std::vector<std::string>& settings, Digests& digests) {
  const Scene scene = read_scene_file(file, settings);
  const std::unique_ptr<Snapshot> snapshot = open_snapshot_for(scene.snapshot, scene.read);
  std::vector<std::string> notes;
  const Frame frame = load_frame(scene, *snapshot, notes);
  for (const FrameView& view : views_of(scene, frame))
    digests.add(name + view.suffix, view.frame, true, true);
}

void run(const std::vector<std::string>& words) {
  Digests digests;
  if (words.empty()) add_random_scenes(digests);
  for (std::size_t i = 0; i + 2 < words.size();) {
    const std::string& name = words[i + 1];
    const std::string& file = words[i + 2];
    std::vector<std::string> settings;
    for (i += 3; i < words.size() && words[i] != "--scene"; ++i)
      settings.push_back(words[i]);
    add_scene(name, file, settings, digests);
  }
}

}  // namespace
}  // namespace splotchcl::test

int main(int argument_count, char** arguments) {
  try {
    splotchcl::test::run({arguments + 1, arguments + argument_count});
  } catch (const std::exception& error) {
    std::fprintf(stderr, "picture_digests: %s\n", error.what());
    return 1;
  }
}
