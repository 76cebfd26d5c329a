#include "pictures/other_scenes.h"

#include "finish/cross_fade.h"
#include "splotchcl/load.h"

namespace splotchcl {

void OtherScenes::decide(const Scene& scene) {
  const CrossFade& fade = scene.finish.cross_fade;
  if (fade.scene.empty() || fade.amount == 0) return;
  OtherScene& other = by_file_[fade.scene];
  if (other.decided) return;
  const Scene open = *cross_fade_scene(scene);
  std::vector<std::string> ignored;  // told when it is drawn
  other.decided = fixed_scene(splotchcl::decide(open, *other.snapshots.at(open), ignored));
}

std::vector<Picture> OtherScenes::draw(const std::string& file, Scene other, const Rectangle& crop,
                                       const DrawFrame& draw, std::vector<std::string>& notes) {
  OtherScene& known = by_file_[file];
  if (known.decided) other.components = known.decided->components;
  const std::shared_ptr<const Snapshot> snapshot = known.snapshots.at(other);
  Frame frame = load_frame(other, *snapshot, notes);
  frame.crop = crop;
  return draw_pictures(other, frame, snapshot->info(), draw, notes);
}

}  // namespace splotchcl
