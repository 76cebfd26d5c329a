#include "scene_file/key_builder.h"

namespace splotchcl::scene_file {

Keys stereo_keys() {
  Range angle = more_than(0);
  angle.at_most = 45;
  return {
      key("stereo.angle", number(angle), &Stereo::angle_degrees,
          {"Two pictures, one for each eye, are drawn where there is a `[stereo]`. The eyes are "
           "this angle times the distance from `camera.position` to `camera.look_at` apart.",
           "degrees"}),
      key("stereo.mode",
          choice<StereoMode>({{"off_axis", StereoMode::off_axis},
                              {"parallel", StereoMode::parallel},
                              {"toe_in", StereoMode::toe_in}}),
          &Stereo::mode,
          {"`off_axis`: parallel view directions, the pictures shifted so that what lies at the "
           "look-at distance is at the same place in both. `parallel`: not shifted, as headsets "
           "expect it of 360 degrees. `toe_in`: each eye looks at `camera.look_at`; needs a "
           "perspective or orthographic camera, and is the only one for the latter."}),
      key("stereo.eyes",
          choice<StereoEyes>(
              {{"right_shifted", StereoEyes::right_shifted}, {"centered", StereoEyes::centered}}),
          &Stereo::eyes,
          {"`right_shifted`: the left eye is at `camera.position`. `centered`: each eye is half a "
           "step to its side of it."}),
      key("stereo.layout",
          choice<StereoLayout>({{"files", StereoLayout::files},
                                {"side_by_side", StereoLayout::side_by_side},
                                {"top_bottom", StereoLayout::top_bottom},
                                {"anaglyph", StereoLayout::anaglyph},
                                {"anaglyph_half_color", StereoLayout::anaglyph_half_color},
                                {"anaglyph_gray", StereoLayout::anaglyph_gray}}),
          &Stereo::layout,
          {"`files`: two files whose names end in _left and _right. `side_by_side` and "
           "`top_bottom`: "
           "one picture, left eye left or on top, twice as large as `image.size`. The others are "
           "for "
           "glasses of red (left) and cyan; see projections.md."}),
  };
}

}  // namespace splotchcl::scene_file
