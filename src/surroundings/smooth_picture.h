#pragma once

#include <functional>
#include <memory>
#include <vector>

#include "splotchcl/frame.h"

// Pictures of what is smooth: worked out at nodes, pixels so many apart, and interpolated between
// them. How far apart is found by trying: nodes are halved until those between are foretold. They
// begin so close that none can lie beside all that there is.
namespace splotchcl {

struct SmoothPictureSettings {
  int width = 0, height = 0;  // of the whole picture: spacings do not depend on what is drawn of it
  Rectangle crop;             // what is wanted
  bool crop_alone = false;    // but on the crop: its bits are no longer those of the whole picture
  int channels = 0;           // of a pixel
  // No detail is narrower than exp(-x^2 / narrowest^2), in pixels; 0: all pixels are worked out.
  double narrowest = 0;
  // The most that a pixel may err by; `error_of` says by how much it does, from its channels as
  // they are and as they were foretold.
  double allowed = 0;
  std::function<double(const double* exact, const double* foretold)> error_of;
};

// Works out the channels of pixels of row y, in columns `x`, one pixel after the other. They are
// some of many that lie `spacing` pixels apart, also beside the picture; called from several
// threads.
using PixelsFunction =
    std::function<void(const std::vector<int>& x, int y, int spacing, double* channels)>;

// Nodes from which a crop's pixels are interpolated, row by row.
class SmoothPicture {
 public:
  SmoothPicture(const SmoothPictureSettings& settings, const PixelsFunction& pixels);
  SmoothPicture(SmoothPicture&&) noexcept;
  SmoothPicture& operator=(SmoothPicture&&) noexcept;
  ~SmoothPicture();

  // Row y of the crop: for each channel its `crop.width` pixels. Several threads may
  // ask.
  void row(int y, std::vector<double>& channels) const;

 private:
  class Nodes;
  Rectangle crop_;
  std::unique_ptr<const Nodes> nodes_;
};

}  // namespace splotchcl
