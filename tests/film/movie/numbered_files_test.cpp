#include "film/movie/numbered_files.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "splotchcl/error.h"

namespace splotchcl {
namespace {

std::string file_at(const std::string& pattern, int number) {
  return NumberedFiles::require(pattern, "--output").at(number).string();
}

TEST(NumberedFiles, HaveTheNumberAsPrintfWritesIt) {
  EXPECT_EQ(file_at("turn_%d.png", 7), "turn_7.png");
  EXPECT_EQ(file_at("turn_%04d.png", 7), "turn_0007.png");
  EXPECT_EQ(file_at("turn_%3d.png", 7), "turn_  7.png");
  EXPECT_EQ(file_at("turn_%02d.png", 1234), "turn_1234.png");
}

TEST(NumberedFiles, KeepTheirFolder) {
  EXPECT_EQ(file_at("a/100%/t%d.png", 3), "a/100%/t3.png");
}

TEST(NumberedFiles, NeedOneNumberInTheName) {
  for (const char* const pattern : {"turn.png", "turn_%s.png", "%d_%d.png", "turn_%", "%04x.png",
                                    "turn_%d/frame.png", "turn_%0000000d.png", "100%_%d.png", ""}) {
    EXPECT_FALSE(NumberedFiles::find(pattern)) << pattern;
    EXPECT_THROW(NumberedFiles::require(pattern, "--output"), UsageError) << pattern;
  }
}

}  // namespace
}  // namespace splotchcl
