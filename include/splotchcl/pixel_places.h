#pragma once

namespace splotchcl {

// Which pixels of a scene's views a picture shows: what follows from a pixel's place is the same in
// a crop as in the whole, and in each of several views that lie beside each other.
struct PixelPlaces {
  int left = 0, top = 0;      // of each view's first pixel in the view's whole picture
  int width = 0, height = 0;  // of a view in this picture; 0: the picture is one view
};

}  // namespace splotchcl
