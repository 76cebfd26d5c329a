#include <hpdf.h>

#include <algorithm>
#include <cmath>

#include "image/text.h"
#include "map/sheet.h"
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

}  // namespace splotchcl
