#include "finish/placeholders.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "splotchcl/error.h"

namespace splotchcl::test {
namespace {

using ::testing::HasSubstr;

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

}  // namespace
}  // namespace splotchcl::test
