#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "finish/overlay.h"
#include "splotchcl/error.h"

namespace splotchcl::test {
namespace {

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
  try {
    layout.place(Anchor::top, 1700, 20, "finish.title");
    FAIL() << "expected it to be refused";
  } catch (const UsageError& error) {
    EXPECT_THAT(error.what(), ::testing::HasSubstr("finish.title: takes 1700 x 20 pixels"));
  }
}

TEST(Layout, RefusesToPutOneThingUponAnother) {
  Layout layout(1600, 1000);
  layout.place(Anchor::bottom_right, 300, 400, "finish.inset");
  try {
    layout.place(Anchor::right, 100, 400, "finish.color_bar");
    FAIL() << "expected it to be refused";
  } catch (const UsageError& error) {
    EXPECT_THAT(error.what(),
                ::testing::HasSubstr("finish.color_bar: would lie upon finish.inset"));
  }
}

}  // namespace
}  // namespace splotchcl::test
