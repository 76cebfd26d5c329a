#include <hpdf.h>

#include <algorithm>
#include <cmath>
#include <memory>

#include "finish/placeholders.h"
#include "image/text.h"
#include "map/figure.h"
#include "splotchcl/error.h"

namespace splotchcl {
namespace {

// Lengths in points, from the lower left corner of the page.
constexpr double map_side = 360, margin = 12, text_size = 10, tick = 4;
constexpr double left_of_map = 64, below_map = 44, bar_gap = 16, bar_width = 14, right_of_bar = 64,
                 above_map = 34;

enum class Align { left, center, right };

class PdfPage {
 public:
  PdfPage(const std::filesystem::path& path, const std::string& font, double width, double height)
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

  void line(double x0, double y0, double x1, double y1) {
    HPDF_Page_MoveTo(page_, static_cast<float>(x0), static_cast<float>(y0));
    HPDF_Page_LineTo(page_, static_cast<float>(x1), static_cast<float>(y1));
  }
  // Draws the lines since the last stroke.
  void stroke(double width, double gray) {
    HPDF_Page_Stroke(page_);
    set_pen(width, gray);
  }
  // For lines that follow.
  void set_pen(double width, double gray) {
    HPDF_Page_SetLineWidth(page_, static_cast<float>(width));
    HPDF_Page_SetGrayStroke(page_, static_cast<float>(gray));
  }
  void frame(double x, double y, double width, double height) {
    HPDF_Page_Rectangle(page_, static_cast<float>(x), static_cast<float>(y),
                        static_cast<float>(width), static_cast<float>(height));
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
  // The baseline begins, has its middle or ends at (x, y); upwards where it is turned. Smaller than
  // `size` where it would be longer than the page otherwise.
  void text(const std::string& words, double x, double y, Align align, bool is_turned = false,
            double size = text_size) {
    HPDF_Page_BeginText(page_);
    HPDF_Page_SetFontAndSize(page_, font_, static_cast<float>(size));
    double width = static_cast<double>(HPDF_Page_TextWidth(page_, words.c_str()));
    const double room =
        static_cast<double>(is_turned ? HPDF_Page_GetHeight(page_) : HPDF_Page_GetWidth(page_)) -
        2 * margin;
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

// Marks along an axis from `first` to `last`, in lengths.
std::vector<Tick> axis_ticks(double center, double half) {
  ScalarMap axis;
  axis.minimum = center - half;
  axis.maximum = center + half;
  return ticks_of(axis, 6, true);
}

class FigurePage {
 public:
  FigurePage(const std::filesystem::path& path, const Figure& figure, const FinishSettings& finish)
      : figure_(figure),
        map_(figure.map),
        width_(map_.width >= map_.height ? map_side : map_side * map_.width / map_.height),
        height_(map_.height >= map_.width ? map_side : map_side * map_.height / map_.width),
        page_(path, finish.font, left_of_map + width_ + bar_gap + bar_width + right_of_bar,
              below_map + height_ + above_map) {}

  void draw_map() {
    page_.picture(figure_.picture(), left_of_map, below_map, width_, height_);
    page_.set_pen(0.6, 1);
    for (const double level : figure_.levels)
      draw_contour(level);
    page_.set_pen(0.8, 0);
    page_.frame(left_of_map, below_map, width_, height_);
  }

  void draw_axes() {
    for (const Tick& mark : axis_ticks(map_.center_right, 0.5 * map_.width * map_.pixel)) {
      const double x = left_of_map + mark.position * width_;
      page_.line(x, below_map, x, below_map - tick);
      page_.stroke(0.8, 0);
      page_.text(mark.label, x, below_map - tick - text_size, Align::center);
    }
    for (const Tick& mark : axis_ticks(map_.center_up, 0.5 * map_.height * map_.pixel)) {
      const double y = below_map + mark.position * height_;
      page_.line(left_of_map, y, left_of_map - tick, y);
      page_.stroke(0.8, 0);
      page_.text(mark.label, left_of_map - tick - 2, y - 0.35 * text_size, Align::right);
    }
    const std::string unit = " [" + map_.length_unit + "]";
    page_.text(map_.right_name + unit, left_of_map + width_ / 2, margin, Align::center);
    page_.text(map_.up_name + unit, margin + 0.8 * text_size, below_map + height_ / 2,
               Align::center, true);
  }

  void draw_bar(const std::string& label) {
    const double left = left_of_map + width_ + bar_gap, right = left + bar_width;
    constexpr int steps = 512;
    Image colors(1, steps);
    for (int i = 0; i < steps; ++i) {
      const auto color = sample_knots(figure_.palette.emission, 1 - (i + 0.5) / steps);
      for (std::size_t c = 0; c < 3; ++c)
        colors.at(0, i)[c] = static_cast<float>(color[c]);
    }
    page_.picture(colors, left, below_map, bar_width, height_);
    page_.frame(left, below_map, bar_width, height_);
    for (const Tick& mark : figure_.colors.ticks(static_cast<int>(height_ / 40), true)) {
      const double y = below_map + mark.position * height_;
      page_.line(right, y, right + (mark.label.empty() ? 0.5 : 1) * tick, y);
      page_.stroke(0.8, 0);
      page_.text(mark.label, right + tick + 2, y - 0.35 * text_size, Align::left);
    }
    page_.text(label, right + right_of_bar - margin, 0.5 * (below_map + height_ + above_map),
               Align::center, true);
  }

  void draw_title(const std::string& words) {
    page_.text(words, left_of_map + width_ / 2, below_map + height_ + margin, Align::center, false,
               1.3 * text_size);
  }

  std::vector<unsigned char> bytes() { return page_.bytes(); }

 private:
  void draw_contour(double level) {
    const double scale = width_ / map_.width;
    const auto pieces = contour_pieces(map_, level);
    for (const auto& [a, b] : pieces)
      page_.line(left_of_map + a[0] * scale, below_map + height_ - a[1] * scale,
                 left_of_map + b[0] * scale, below_map + height_ - b[1] * scale);
    if (!pieces.empty()) page_.stroke(0.6, 1);
  }

  const Figure& figure_;
  const Map& map_;
  double width_, height_;
  PdfPage page_;
};

}  // namespace

std::vector<unsigned char> encode_pdf(const std::filesystem::path& path, const Figure& figure,
                                      const Scene& scene, const SnapshotInfo& snapshot) {
  const FinishSettings& finish = scene.finish;
  FigurePage page(path, figure, finish);
  page.draw_map();
  page.draw_axes();
  const auto& labels = finish.color_bar.labels;
  page.draw_bar(labels.empty() ? figure.label : labels.front());
  if (!finish.title.text.empty()) {
    page.draw_title(replace_placeholders(finish.title.text, snapshot, finish.frame.value_or(0),
                                         "finish.title.text"));
  }
  return page.bytes();
}

}  // namespace splotchcl
