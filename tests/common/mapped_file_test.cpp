#include "common/mapped_file.h"

#include <gtest/gtest.h>

#include "splotchcl/error.h"

namespace splotchcl {
namespace {

TEST(MappedFile, RefusesAMissingFileByName) {
  try {
    MappedFile::open("no/such/file");
    FAIL() << "a missing file was opened";
  } catch (const DataError& error) {
    EXPECT_NE(std::string(error.what()).find("no/such/file"), std::string::npos);
  }
}

TEST(MappedFile, RefusesAFolder) {
  EXPECT_THROW(MappedFile::open("."), DataError);
}

}  // namespace
}  // namespace splotchcl
