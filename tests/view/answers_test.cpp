#include "view/answers.h"

#include <gtest/gtest.h>

#include "splotchcl/error.h"

namespace splotchcl::view {
namespace {

TEST(ErrorsForAPage, DoNotQuoteFiles) {
  EXPECT_EQ(
      text_for_page(DataError("a/palette.txt:1: found \"password=hunter2\", expected a number")),
      "a/palette.txt:1: found (not shown), expected a number");
  EXPECT_EQ(text_for_page(DataError("t.txt: found 'it's a secret', expected x; the user's file")),
            "t.txt: found (not shown), expected x; the user's file");
  EXPECT_EQ(text_for_page(DataError("t.txt: found \"no end")), "t.txt: found (not shown)");
}

TEST(ErrorsForAPage, RepeatWhatThePageHasSent) {
  EXPECT_EQ(text_for_page(UsageError("palette: found 'secret', expected another")),
            "palette: found 'secret', expected another");
}

}  // namespace
}  // namespace splotchcl::view
