#include "finish/finish_pictures.h"
#include "finish/overlay.h"
#include "finish/ticks.h"
#include "image/text.h"
#include "scene/scalar_map.h"
#include "testing.h"

namespace splotchcl::test {
namespace {

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
  EXPECT_THAT([&] { font().draw("銀河", 20); }, ThrowsMessage<UsageError>(HasSubstr("U+9280")));
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

SnapshotInfo snapshot() {
  SnapshotInfo info;
  info.files = {"folder/snapshot_006"};
  info.time = 0.25;
  info.redshift = 3;
  return info;
}

std::string replaced(const std::string& text, int frame = 7) {
  return replace_placeholders(text, snapshot(), frame, "finish.title.text");
}

std::string refusal(const std::string& text, const SnapshotInfo& info, int frame = 7) {
  try {
    replace_placeholders(text, info, frame, "finish.title.text");
  } catch (const UsageError& error) {
    return error.what();
  }
  return "not refused";
}

TEST(Placeholders, TakeTheSnapshotsValues) {
  EXPECT_EQ(replaced("t = {time}, z = {redshift:.2f}, a = {scale_factor}"),
            "t = 0.25, z = 3.00, a = 0.25");
  EXPECT_EQ(replaced("{snapshot}"), "snapshot_006");
}

TEST(Placeholders, TakeTheNumberOfTheFrame) {
  EXPECT_EQ(replaced("{frame:04} {frame}"), "0007 7");
}

TEST(Placeholders, LeaveOtherTextAndDoubledBraces) {
  EXPECT_EQ(replaced("10% of {{all}} — ρ"), "10% of {all} — ρ");
}

TEST(Placeholders, ThatAreUnknownAreRefusedWithThoseThatExist) {
  const std::string message = refusal("{redshfit}", snapshot());
  EXPECT_THAT(message, HasSubstr("finish.title.text"));
  EXPECT_THAT(message, HasSubstr("{redshfit}"));
  EXPECT_THAT(message, HasSubstr("{redshift}"));
}

TEST(Placeholders, WithAFormatThatDoesNotFitAreRefused) {
  EXPECT_THAT(refusal("{frame:.2f}", snapshot()), HasSubstr("finish.title.text"));
  EXPECT_THAT(refusal("{time", snapshot()), HasSubstr("finish.title.text"));
}

// Each of them once asked for as many letters as it says.
TEST(Placeholders, ThatAskForVeryManyLettersAreRefused) {
  for (const std::string text : {"{time:.999999999f}", "{time:999999999}", "{time:{frame}}",
                                 "{{{time:.1000f}}}", "{snapshot:5000}"}) {
    EXPECT_THAT(refusal(text, snapshot()), HasSubstr("at most 99")) << text;
  }
  EXPECT_EQ(replaced("{{1000000}} {time:8.3f}"), "{1000000}    0.250");
}

TEST(Placeholders, WithoutAValueAreRefused) {
  SnapshotInfo without = snapshot();
  without.redshift.reset();
  EXPECT_THAT(refusal("{redshift}", without), HasSubstr("snapshot_006 has no redshift"));
}

constexpr double margin = 32;  // of a picture whose shorter side has 1000 pixels

TEST(Layout, KeepsAMarginOnEverySide) {
  Layout layout(1600, 1000);
  const Box first = layout.place(Anchor::top_left, 100, 20, "it");
  EXPECT_EQ(first.left, margin);
  EXPECT_EQ(first.top, margin);
  const Box last = layout.place(Anchor::bottom_right, 100, 20, "it");
  EXPECT_EQ(last.right, 1600 - margin);
  EXPECT_EQ(last.bottom, 1000 - margin);
}

TEST(Layout, CentersWhatLiesAtTheMiddleOfASide) {
  Layout layout(1600, 1000);
  const Box top = layout.place(Anchor::top, 100, 20, "it");
  EXPECT_EQ(top.left + top.right, 1600);
  const Box right = layout.place(Anchor::right, 100, 20, "it");
  EXPECT_EQ(right.top + right.bottom, 1000);
}

TEST(Layout, PutsThingsOfOnePlaceBesideEachOther) {
  Layout layout(1600, 1000);
  const Box first = layout.place(Anchor::bottom_left, 100, 20, "it");
  const Box second = layout.place(Anchor::bottom_left, 50, 30, "it");
  EXPECT_LE(second.bottom, first.top);
  const Box one = layout.place(Anchor::right, 100, 20, "it");
  const Box other = layout.place(Anchor::right, 100, 20, "it");
  EXPECT_LE(other.right, one.left);
}

TEST(Layout, RefusesWhatDoesNotFitAndNamesIt) {
  Layout layout(1600, 1000);
  EXPECT_THAT([&] { layout.place(Anchor::top, 1700, 20, "finish.title"); },
              ThrowsMessage<UsageError>(HasSubstr("finish.title: takes 1700 x 20 pixels")));
}

TEST(Layout, RefusesToPutOneThingUponAnother) {
  Layout layout(1600, 1000);
  layout.place(Anchor::bottom_right, 300, 400, "finish.inset");
  EXPECT_THAT(
      [&] { layout.place(Anchor::right, 100, 400, "finish.color_bar"); },
      ThrowsMessage<UsageError>(HasSubstr("finish.color_bar: would lie upon finish.inset")));
}

TEST(Canvas, CoversPartsOfPixelsInPart) {
  Image image(4, 3);
  Canvas canvas(image, {0, 0, 4, 3});
  canvas.fill({0.25, 1, 2.5, 1.5}, {1, 2, 4});
  EXPECT_FLOAT_EQ(image.at(0, 1)[0], 0.375F);
  EXPECT_FLOAT_EQ(image.at(1, 1)[1], 1.0F);
  EXPECT_FLOAT_EQ(image.at(2, 1)[2], 1.0F);
  EXPECT_EQ(image.at(3, 1)[0], 0.0F);
  EXPECT_EQ(image.at(1, 0)[0], 0.0F);
  EXPECT_EQ(image.at(1, 2)[0], 0.0F);
}

TEST(Canvas, LeavesWhatIsNotCovered) {
  Image image = plain_image(2, 1, {1, 1, 1});
  Canvas canvas(image, {0, 0, 2, 1});
  canvas.cover(0, 0, {0, 0, 0}, 0.25F);
  EXPECT_FLOAT_EQ(image.at(0, 0)[0], 0.75F);
  EXPECT_FLOAT_EQ(image.at(0, 0)[3], 0.25F);
  EXPECT_FLOAT_EQ(image.at(1, 0)[0], 1.0F);
}

// A bright spot would outshine letters through any shade.
TEST(Canvas, ShadesLightAboveWhiteAsWhite) {
  Image image = plain_image(2, 1, {9, 0.5F, 1});
  Canvas canvas(image, {0, 0, 2, 1});
  TextMask mask;
  mask.width = 1;
  mask.height = 1;
  mask.coverage = {1};
  canvas.shade(mask, 0, 0, {0, 0, 0}, 0.75F);
  EXPECT_FLOAT_EQ(image.at(0, 0)[0], 0.25F);
  EXPECT_FLOAT_EQ(image.at(0, 0)[1], 0.125F);
  EXPECT_EQ(image.at(1, 0)[0], 9.0F);
}

TEST(Canvas, OfAPartTakesThePartsPixels) {
  Image part(2, 2);
  Canvas canvas(part, {3, 5, 2, 2});
  canvas.fill({0, 0, 4, 6}, {1, 1, 1});
  EXPECT_EQ(part.at(0, 0)[0], 1.0F);
  EXPECT_EQ(part.at(1, 0)[0], 0.0F);
  EXPECT_EQ(part.at(0, 1)[0], 0.0F);
}

std::vector<std::string> labels_of(const ScalarMap& map, int most = 6) {
  std::vector<std::string> labels;
  for (const Tick& tick : ticks_of(map, most, true)) {
    if (!tick.label.empty()) labels.push_back(tick.label);
  }
  return labels;
}

TEST(Ticks, OfALinearAxisHaveRoundSteps) {
  EXPECT_THAT(labels_of({Scaling::linear, 0, 1}),
              ElementsAre("0", "0.2", "0.4", "0.6", "0.8", "1"));
  EXPECT_THAT(labels_of({Scaling::linear, -3.2, 11}), ElementsAre("0", "5", "10"));
}

TEST(Ticks, OfALogarithmicAxisArePowersOfTen) {
  EXPECT_THAT(labels_of({Scaling::log, 3.5, 7.2}), ElementsAre("10⁴", "10⁵", "10⁶", "10⁷"));
  EXPECT_THAT(labels_of({Scaling::log, -1.1, 2}), ElementsAre("0.1", "1", "10", "100"));
}

TEST(Ticks, OfFewDecadesHaveNumbersBetween) {
  EXPECT_THAT(labels_of({Scaling::log, 0, 1}), ElementsAre("1", "2", "5", "10"));
}

TEST(Ticks, OfManyDecadesLeaveSomeOut) {
  EXPECT_LE(labels_of({Scaling::log, -20, 20}).size(), 7U);
  EXPECT_GE(labels_of({Scaling::log, -20, 20}).size(), 4U);
}

TEST(Ticks, OfAnAsinhAxisAreTheSameOnBothSides) {
  EXPECT_THAT(labels_of({Scaling::asinh, std::asinh(-1500.0), std::asinh(1500.0)}, 9),
              ElementsAre("-1000", "-100", "-10", "0", "10", "100", "1000"));
}

TEST(Ticks, StandWhereTheScalingPutsTheirValues) {
  for (const ScalarMap& map :
       {ScalarMap{Scaling::linear, -7, 12.5}, ScalarMap{Scaling::log, -3.3, 5.1},
        ScalarMap{Scaling::log, 0.1, 0.4}, ScalarMap{Scaling::asinh, -2, 9}}) {
    const std::vector<Tick> ticks = ticks_of(map, 6, true);
    ASSERT_GE(ticks.size(), 2U);
    for (const Tick& tick : ticks)
      EXPECT_NEAR(tick.position, normalized(tick.value, map), 1e-9);
  }
}

TEST(Ticks, OfAnAxisWithoutLengthAreOne) {
  EXPECT_THAT(labels_of({Scaling::linear, 4, 4}), ElementsAre("4"));
}

TEST(NumberLabels, AreShort) {
  EXPECT_EQ(number_label(0, true), "0");
  EXPECT_EQ(number_label(2500, true), "2500");
  EXPECT_EQ(number_label(-0.25, true), "-0.25");
  EXPECT_EQ(number_label(3e6, true), "3×10⁶");
  EXPECT_EQ(number_label(1e-12, true), "10⁻¹²");
  EXPECT_EQ(number_label(3e6, false), "3e+06");
}

TEST(RoundNumbers, AreOneTwoOrFiveTimesAPowerOfTen) {
  EXPECT_DOUBLE_EQ(round_below(4.9), 2);
  EXPECT_DOUBLE_EQ(round_below(5), 5);
  EXPECT_DOUBLE_EQ(round_below(0.0173), 0.01);
  EXPECT_DOUBLE_EQ(round_below(1000), 1000);
}

}  // namespace
}  // namespace splotchcl::test
