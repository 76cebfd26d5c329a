#include "pictures/other_scenes.h"

#include <utility>

#include "finish/effects.h"
#include "finish/tone.h"
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

bool OtherScenes::lacks_tone(const Scene& scene) const {
  const std::optional<Scene> other = cross_fade_scene(scene);
  if (!other || !has_open_tone(other->finish)) return false;
  const auto known = by_file_.find(scene.finish.cross_fade.scene);
  return known == by_file_.end() || !known->second.tone;
}

std::vector<Picture> OtherScenes::draw(const std::string& file, Scene other, const Rectangle& crop,
                                       const DrawFrame& draw, PictureLight light,
                                       const KeepsPromise& keeps_promise,
                                       std::vector<std::string>& notes,
                                       const std::vector<Moment>& moments) {
  OtherScene& known = by_file_[file];
  if (known.decided) other.components = known.decided->components;
  std::vector<Moment> of_other;
  for (const Moment& moment : moments) {
    Scene scene = cross_fade_scene(moment.scene).value_or(other);
    scene.components = other.components;
    of_other.push_back({scene, [&known, scene] { return known.snapshots.at(scene); }});
  }
  const bool is_open = has_open_tone(other.finish);
  if (is_open && known.tone) take_tone(*known.tone, other.finish);
  const std::shared_ptr<const Snapshot> snapshot = known.snapshots.at(other);
  Frame frame = load_frame(other, *snapshot, notes);
  OtherScenes none;  // it fades to no third
  frame.crop = crop;
  DrawnPictures drawn = draw_pictures(other, frame, snapshot->info(), draw, notes, none, light,
                                      keeps_promise, of_other);
  if (is_open && !known.tone && !drawn.is_black) known.tone = drawn.finish;
  return std::move(drawn.pictures);
}

}  // namespace splotchcl
