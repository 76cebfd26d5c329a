#pragma once

namespace splotchcl {

// The way from one view to another that moves and scales at once, so that what is seen changes as
// evenly and as little as it can (van Wijk & Nuij, IEEE InfoVis 2003): it moves while much is in
// view. Where nothing is to be moved, the shown length changes by the same factor in equal times.
class ZoomCurve {
 public:
  struct View {
    double part = 0;   // of the way that the view's middle has gone, 0 to 1
    double width = 0;  // the shown length
  };

  // Widths above 0; the distance between the two views' middles.
  ZoomCurve(double first_width, double last_width, double distance);

  // At this part of the whole curve, from 0 to 1.
  View at(double fraction) const;

 private:
  double first_width_, last_width_, distance_;
  double first_ = 0, length_ = 0;  // of the curve
};

}  // namespace splotchcl
