#include "map/sheet.h"

#include <hpdf.h>

#include <algorithm>
#include <cmath>

#include "finish/overlay.h"
#include "image/text.h"
#include "map/figure.h"
#include "splotchcl/error.h"

namespace splotchcl {
namespace {

constexpr double room_beside_text = 12;  // on each side

}  // namespace

class PdfSheet::Page {
 public:
  Page(const std::filesystem::path& path, const std::string& font, double width, double height)
      : path_(path), document_(HPDF_New(nullptr, nullptr)) {
    if (!document_) throw DataError(path_.string() + ": there is no memory for it");
    HPDF_SetCompressionMode(document_.get(), HPDF_COMP_ALL);
    HPDF_UseUTFEncodings(document_.get());
    const char* const name =
        HPDF_LoadTTFontFromFile(document_.get(), find_font(font).c_str(), HPDF_TRUE);
    check("the font " + font);
    font_ = HPDF_GetFont(document_.get(), name, "UTF-8");
    page_ = HPDF_AddPage(document_.get());
    HPDF_Page_SetWidth(page_, static_cast<float>(width));
    HPDF_Page_SetHeight(page_, static_cast<float>(height));
    check("a page");
  }

  void lines(const std::vector<SheetLine>& lines, double width, double gray) {
    if (lines.empty()) return;
    HPDF_Page_SetLineWidth(page_, static_cast<float>(width));
    HPDF_Page_SetGrayStroke(page_, static_cast<float>(gray));
    for (const auto& [from, to] : lines) {
      HPDF_Page_MoveTo(page_, static_cast<float>(from[0]), static_cast<float>(from[1]));
      HPDF_Page_LineTo(page_, static_cast<float>(to[0]), static_cast<float>(to[1]));
    }
    HPDF_Page_Stroke(page_);
  }
  void picture(const Image& image, double x, double y, double width, double height) {
    std::vector<HPDF_BYTE> bytes;
    for (std::size_t i = 0; i < image.pixels.size(); ++i) {
      if (i % 4 == 3) continue;
      bytes.push_back(
          static_cast<HPDF_BYTE>(std::lround(255 * std::clamp(image.pixels[i], 0.0F, 1.0F))));
    }
    const HPDF_Image drawn =
        HPDF_LoadRawImageFromMem(document_.get(), bytes.data(), static_cast<HPDF_UINT>(image.width),
                                 static_cast<HPDF_UINT>(image.height), HPDF_CS_DEVICE_RGB, 8);
    HPDF_Page_DrawImage(page_, drawn, static_cast<float>(x), static_cast<float>(y),
                        static_cast<float>(width), static_cast<float>(height));
    check("the picture");
  }
  void text(const std::string& words, double x, double y, Align align, bool is_turned,
            double size) {
    HPDF_Page_BeginText(page_);
    HPDF_Page_SetFontAndSize(page_, font_, static_cast<float>(size));
    double width = static_cast<double>(HPDF_Page_TextWidth(page_, words.c_str()));
    const double room =
        static_cast<double>(is_turned ? HPDF_Page_GetHeight(page_) : HPDF_Page_GetWidth(page_)) -
        2 * room_beside_text;
    if (width > room) {
      HPDF_Page_SetFontAndSize(page_, font_, static_cast<float>(size * room / width));
      width = room;
    }
    const double back = align == Align::left ? 0 : align == Align::center ? width / 2 : width;
    const float px = static_cast<float>(is_turned ? x : x - back);
    const float py = static_cast<float>(is_turned ? y - back : y);
    if (is_turned) {
      HPDF_Page_SetTextMatrix(page_, 0, 1, -1, 0, px, py);
    } else {
      HPDF_Page_SetTextMatrix(page_, 1, 0, 0, 1, px, py);
    }
    HPDF_Page_ShowText(page_, words.c_str());
    HPDF_Page_EndText(page_);
  }

  std::vector<unsigned char> bytes() {
    HPDF_SaveToStream(document_.get());
    check("the page");
    std::vector<unsigned char> all(HPDF_GetStreamSize(document_.get()));
    auto size = static_cast<HPDF_UINT32>(all.size());
    HPDF_ReadFromStream(document_.get(), all.data(), &size);
    if (size != all.size()) throw DataError(path_.string() + ": could not be made");
    return all;
  }

 private:
  // Without a handler the library keeps its first error, and does nothing more.
  void check(const std::string& what) const {
    const auto code = HPDF_GetError(document_.get());
    if (code == HPDF_OK) return;
    throw DataError(path_.string() + ": " + what + " could not be put into a PDF file (libharu " +
                    std::to_string(code) + ")");
  }
  struct Free {
    void operator()(HPDF_Doc document) const { HPDF_Free(document); }
  };

  std::filesystem::path path_;
  std::unique_ptr<std::remove_pointer_t<HPDF_Doc>, Free> document_;
  HPDF_Font font_ = nullptr;
  HPDF_Page page_ = nullptr;
};

PdfSheet::PdfSheet(const std::filesystem::path& path, const std::string& font, double width,
                   double height)
    : page_(std::make_unique<Page>(path, font, width, height)) {}

PdfSheet::~PdfSheet() = default;

void PdfSheet::lines(const std::vector<SheetLine>& lines, double width, double gray) {
  page_->lines(lines, width, gray);
}

void PdfSheet::picture(const Image& image, double x, double y, double width, double height) {
  page_->picture(image, x, y, width, height);
}

void PdfSheet::text(const std::string& words, double x, double y, Align align, bool is_turned,
                    double size) {
  page_->text(words, x, y, align, is_turned, size);
}

std::vector<unsigned char> PdfSheet::bytes() {
  return page_->bytes();
}

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
