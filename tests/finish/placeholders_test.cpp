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

TEST(Placeholders, WithoutAValueAreRefused) {
  SnapshotInfo without = snapshot();
  without.redshift.reset();
  EXPECT_THAT(refusal("{redshift}", without), HasSubstr("snapshot_006 has no redshift"));
}

}  // namespace
}  // namespace splotchcl::test
