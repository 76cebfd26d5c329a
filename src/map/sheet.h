#pragma once

#include <array>
#include <filesystem>
#include <memory>
#include <string>
#include <vector>

#include "splotchcl/image.h"

// A sheet to draw figures with axes upon: a page of a PDF file, or a picture.
namespace splotchcl {

enum class Align { left, center, right };

// From one place to another, in points from the lower left corner of the sheet.
using SheetLine = std::array<std::array<double, 2>, 2>;

class Sheet {
 public:
  Sheet() = default;
  virtual ~Sheet() = default;
  Sheet(const Sheet&) = delete;
  Sheet& operator=(const Sheet&) = delete;

  virtual void lines(const std::vector<SheetLine>& lines, double width, double gray) = 0;
  virtual void picture(const Image& image, double x, double y, double width, double height) = 0;
  // The baseline begins, has its middle or ends at (x, y); upwards where it is turned. Smaller than
  // `size` where it would be longer than the sheet otherwise.
  virtual void text(const std::string& words, double x, double y, Align align, bool is_turned,
                    double size) = 0;

  void frame(double x, double y, double width, double height, double pen);
};

// One that ends up as the bytes of a file. `path` is for messages.
class PdfSheet : public Sheet {
 public:
  PdfSheet(const std::filesystem::path& path, const std::string& font, double width, double height);
  ~PdfSheet() override;

  void lines(const std::vector<SheetLine>& lines, double width, double gray) override;
  void picture(const Image& image, double x, double y, double width, double height) override;
  void text(const std::string& words, double x, double y, Align align, bool is_turned,
            double size) override;
  std::vector<unsigned char> bytes();

 private:
  class Page;
  std::unique_ptr<Page> page_;
};

// A white picture, `scale` pixels to a point.
class PictureSheet : public Sheet {
 public:
  PictureSheet(const std::string& font, double width, double height, double scale);
  ~PictureSheet() override;

  void lines(const std::vector<SheetLine>& lines, double width, double gray) override;
  void picture(const Image& image, double x, double y, double width, double height) override;
  void text(const std::string& words, double x, double y, Align align, bool is_turned,
            double size) override;
  const Image& image() const;

 private:
  struct Drawing;
  std::unique_ptr<Drawing> drawing_;
};

}  // namespace splotchcl
