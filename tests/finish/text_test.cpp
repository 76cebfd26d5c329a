#include "image/text.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <numeric>

#include "finish/overlay.h"
#include "paths.h"
#include "splotchcl/error.h"

namespace splotchcl::test {
namespace {

using ::testing::HasSubstr;

const Font& font() {
  static const Font font("DejaVuSans");
  return font;
}

double ink(const TextMask& mask) {
  return std::accumulate(mask.coverage.begin(), mask.coverage.end(), 0.0);
}

// Ink within the columns and rows of the text's box.
double ink_in_box(const TextMask& mask) {
  double sum = 0;
  for (int y = -mask.top; y < -mask.top + mask.box_height; ++y) {
    for (int x = -mask.left; x < -mask.left + mask.box_width; ++x)
      sum += static_cast<double>(mask.coverage[static_cast<std::size_t>(y * mask.width + x)]);
  }
  return sum;
}

std::string refusal(const std::string& name) {
  try {
    const Font refused(name);
  } catch (const UsageError& error) {
    return error.what();
  }
  return "not refused";
}

TEST(Text, OfCapitalsLiesInItsBox) {
  const TextMask mask = font().draw("HELM", 40);
  EXPECT_GT(ink(mask), 100);
  EXPECT_NEAR(ink_in_box(mask), ink(mask), 0.02 * ink(mask));
}

TEST(Text, IsAntiAliased) {
  const TextMask mask = font().draw("O", 30);
  EXPECT_TRUE(std::any_of(mask.coverage.begin(), mask.coverage.end(),
                          [](float c) { return c > 0.2F && c < 0.8F; }));
  EXPECT_EQ(*std::max_element(mask.coverage.begin(), mask.coverage.end()), 1.0F);
}

TEST(Text, GrowsWithItsSize) {
  const TextMask small = font().draw("HE", 20), large = font().draw("HE", 40);
  EXPECT_NEAR(large.box_height, 2 * small.box_height, 2);
  EXPECT_NEAR(large.box_width, 2 * small.box_width, 2);
  EXPECT_NEAR(ink(large), 4 * ink(small), 0.1 * ink(large));
}

TEST(Text, OfSeveralLinesStandsBelowEachOther) {
  const TextMask one = font().draw("HE", 20), two = font().draw("HE\nHE", 20);
  EXPECT_EQ(two.box_width, one.box_width);
  EXPECT_GT(two.box_height, one.box_height + 20);
  EXPECT_NEAR(ink(two), 2 * ink(one), 1);
}

TEST(Text, TakesLettersBeyondAscii) {
  EXPECT_GT(ink(font().draw("é ρ ⊙ 10⁻⁴ ×", 20)), 0);
}

TEST(Text, TurnedHasItsBoxTurned) {
  const TextMask mask = font().draw("HELM", 40), upright = turned(mask);
  EXPECT_EQ(upright.box_width, mask.box_height);
  EXPECT_EQ(upright.box_height, mask.box_width);
  EXPECT_NEAR(ink_in_box(upright), ink_in_box(mask), 1e-3 * ink(mask));
}

TEST(Text, WithLettersThatTheFontDoesNotHaveIsRefused) {
  try {
    font().draw("銀河", 20);
    FAIL() << "expected it to be refused";
  } catch (const UsageError& error) {
    EXPECT_THAT(error.what(), HasSubstr("U+9280"));
  }
}

TEST(Text, ThatIsNotUtf8IsRefused) {
  EXPECT_THROW(font().draw("\xff\xfe", 20), UsageError);
}

TEST(Fonts, ThatAreNotInstalledAreRefusedWithWhatToInstall) {
  EXPECT_THAT(refusal("NoSuchFontAnywhere"), HasSubstr("apt-get install fonts-dejavu-core"));
  EXPECT_THAT(refusal("folder/missing.ttf"), HasSubstr("folder/missing.ttf"));
}

TEST(Fonts, AreFoundByTheirNameInAnyCase) {
  EXPECT_EQ(refusal("dejavusans-bold"), "not refused");
}

TEST(Fonts, ThatAreNoFontsAreRefused) {
  EXPECT_THAT(refusal(source_folder() / "README.md"), HasSubstr("README.md"));
}

}  // namespace
}  // namespace splotchcl::test
