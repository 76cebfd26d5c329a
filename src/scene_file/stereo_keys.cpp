#include "scene_file/key_builder.h"

namespace splotchcl::scene_file {

Keys stereo_keys() {
  Range angle = more_than(0);
  angle.at_most = 45;
  return {
      key("stereo.angle", number(angle), &Stereo::angle_degrees,
          {"A `[stereo]` draws two pictures. The eyes are this angle times the look-at distance "
           "apart.",
           "degrees"}),
      key("stereo.mode",
          choice<StereoMode>({{"off_axis", StereoMode::off_axis},
                              {"parallel", StereoMode::parallel},
                              {"toe_in", StereoMode::toe_in}}),
          &Stereo::mode,
          {"`off_axis`: parallel views, shifted to agree at the look-at distance. `parallel`: not "
           "shifted, for headsets. `toe_in`: each eye looks at `look_at`; the only one for "
           "orthographic cameras, and not for wide angles."}),
      key("stereo.eyes",
          choice<StereoEyes>(
              {{"right_shifted", StereoEyes::right_shifted}, {"centered", StereoEyes::centered}}),
          &Stereo::eyes,
          {"`right_shifted`: the left eye is at `camera.position`. `centered`: both are half a "
           "step beside it."}),
      key("stereo.layout",
          choice<StereoLayout>({{"files", StereoLayout::files},
                                {"side_by_side", StereoLayout::side_by_side},
                                {"top_bottom", StereoLayout::top_bottom},
                                {"anaglyph", StereoLayout::anaglyph},
                                {"anaglyph_half_color", StereoLayout::anaglyph_half_color},
                                {"anaglyph_gray", StereoLayout::anaglyph_gray}}),
          &Stereo::layout,
          {"Two files, NAME_left and NAME_right; one picture, left eye left or on top; or one for "
           "glasses of red and cyan. See projections.md."}),
  };
}

}  // namespace splotchcl::scene_file
