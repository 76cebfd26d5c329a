#pragma once

#include <filesystem>
#include <memory>
#include <string>
#include <vector>

namespace splotchcl {

// Whether a font is named by its file's path: it holds a slash or ends in .ttf, .otf, .ttc.
bool is_font_path(const std::string& font);

// The file of a font that is named by its path, or by its name in one of the folders where
// systems keep fonts. Throws UsageError that says what to install.
std::filesystem::path find_font(const std::string& name);

// How much of each pixel a text covers, 0 to 1, row 0 at the top. The text's box spans from
// the tops of the first line's capitals to the last line's baseline; the mask reaches
// beyond it for accents and descenders.
struct TextMask {
  int width = 0, height = 0;
  std::vector<float> coverage;  // width * height
  int left = 0, top = 0;        // of the mask, from the box's corner
  int box_width = 0, box_height = 0;
};

enum class TextAlignment { left, center, right };

// A font file. Drawn with FreeType, anti-aliased.
class Font {
 public:
  // `name` is a font file, or its name without the ending (DejaVuSans-Bold) in one of the
  // system's or the user's font folders. Throws UsageError that says what to install.
  explicit Font(const std::string& name);

  // UTF-8, lines separated by "\n". The size is that of the em square in pixels; capitals
  // are about 0.7 of it high. Throws UsageError for a letter that the font does not have.
  TextMask draw(const std::string& text, double size_pixels,
                TextAlignment alignment = TextAlignment::left) const;
  bool has(char32_t letter) const;

 private:
  struct Face;
  std::string name_;
  std::shared_ptr<Face> face_;
};

}  // namespace splotchcl
