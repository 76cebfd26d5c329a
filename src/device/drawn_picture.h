#pragma once

#include <vector>

#include "certificate/certificate.h"
#include "splotchcl/frame.h"
#include "splotchcl/frame_check.h"
#include "splotchcl/image.h"

namespace splotchcl {

// A picture and how well it keeps its promise.
struct DrawnPicture {
  Image image;
  Certificate certificate;
};

// Puts a part that was drawn by itself in its place.
void paste(const DrawnPicture& part, const Rectangle& at, DrawnPicture& whole);

// The largest of these that the picture has: the worst block that kept the promise at first may
// have been drawn again with others.
ErrorParts worst_within(const std::vector<ErrorParts>& candidates, double error_of_promise);

}  // namespace splotchcl
