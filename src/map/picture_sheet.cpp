#include <algorithm>
#include <cmath>

#include "finish/overlay.h"
#include "image/text.h"
#include "map/figure.h"
#include "map/sheet.h"

namespace splotchcl {

void Sheet::frame(double x, double y, double width, double height, double pen) {
  const double right = x + width, top = y + height;
  lines({SheetLine{{{x, y}, {right, y}}}, SheetLine{{{right, y}, {right, top}}},
         SheetLine{{{right, top}, {x, top}}}, SheetLine{{{x, top}, {x, y}}}},
        pen, 0);
}

struct PictureSheet::Drawing {
  Font font;
  Image image;
  double scale, height;

  double down(double y) const { return scale * (height - y); }
};

PictureSheet::PictureSheet(const std::string& font, double width, double height, double scale)
    : drawing_(new Drawing{Font(font),
                           Image(static_cast<int>(std::lround(width * scale)),
                                 static_cast<int>(std::lround(height * scale))),
                           scale, height}) {
  std::fill(drawing_->image.pixels.begin(), drawing_->image.pixels.end(), 1.0F);
}

PictureSheet::~PictureSheet() = default;

const Image& PictureSheet::image() const {
  return drawing_->image;
}

void PictureSheet::lines(const std::vector<SheetLine>& lines, double width, double gray) {
  std::vector<ContourPiece> pieces;
  for (const auto& [from, to] : lines) {
    pieces.push_back({{{drawing_->scale * from[0], drawing_->down(from[1])},
                       {drawing_->scale * to[0], drawing_->down(to[1])}}});
  }
  draw_lines(pieces, width * drawing_->scale, static_cast<float>(gray), drawing_->image);
}

// Each pixel of the sheet has the value of the one that its middle lies in.
void PictureSheet::picture(const Image& picture, double x, double y, double width, double height) {
  Image& sheet = drawing_->image;
  const double left = x * drawing_->scale, top = drawing_->down(y + height);
  const double columns = width * drawing_->scale, rows = height * drawing_->scale;
  const auto first = [](double place) { return static_cast<int>(std::lround(place)); };
  for (int row = std::max(0, first(top)); row < std::min(sheet.height, first(top + rows)); ++row) {
    for (int column = std::max(0, first(left));
         column < std::min(sheet.width, first(left + columns)); ++column) {
      const auto inside = [](double part, int count) {
        return std::clamp(static_cast<int>(part * count), 0, count - 1);
      };
      const float* const from = picture.at(inside((column + 0.5 - left) / columns, picture.width),
                                           inside((row + 0.5 - top) / rows, picture.height));
      std::copy(from, from + 3, sheet.at(column, row));
    }
  }
}

void PictureSheet::text(const std::string& words, double x, double y, Align align, bool is_turned,
                        double size) {
  constexpr double room = 12;  // on each side
  Image& sheet = drawing_->image;
  const double scale = drawing_->scale;
  TextMask mask = drawing_->font.draw(words, size * scale);
  const double longest = (is_turned ? sheet.height : sheet.width) - 2 * room * scale;
  if (mask.box_width > longest)
    mask = drawing_->font.draw(words, size * scale * longest / mask.box_width);
  const double back = (align == Align::left     ? 0
                       : align == Align::center ? 0.5
                                                : 1) *
                      mask.box_width;
  Canvas canvas(sheet, {0, 0, sheet.width, sheet.height});
  const auto whole = [](double place) { return static_cast<int>(std::lround(place)); };
  const double left = scale * x, base = drawing_->down(y);
  if (is_turned) {
    const TextMask up = turned(mask);
    canvas.stamp(up, whole(left - up.box_width) + up.left,
                 whole(base + back - up.box_height) + up.top, {0, 0, 0});
  } else {
    canvas.stamp(mask, whole(left - back) + mask.left, whole(base - mask.box_height) + mask.top,
                 {0, 0, 0});
  }
}

}  // namespace splotchcl
