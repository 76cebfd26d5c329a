#include "common/file_identity.h"
#include "testing.h"

namespace splotchcl::test {
namespace {

class WatchedFile : public ::testing::Test {
 protected:
  void SetUp() override {
    write("a");
    watched_.add(path_);
  }
  void write(const char* text) const { std::ofstream(path_, std::ios::app) << text; }
  void replace() const {
    std::ofstream(folder_ / "other") << "another file";
    std::filesystem::rename(folder_ / "other", path_);
  }

  TemporaryFolder folder_;
  std::filesystem::path path_ = folder_ / "file";
  WatchedFiles watched_;
};

TEST_F(WatchedFile, ThatStaysIsNoError) {
  EXPECT_NO_THROW(watched_.check());
  EXPECT_NO_THROW(watched_.check_in_place());
  EXPECT_EQ(watched_.unchanged_during([] { return 7; }), 7);
}

TEST_F(WatchedFile, ThatIsWrittenToIsAnError) {
  write("b");
  EXPECT_THROW(watched_.check(), DataError);
  EXPECT_THROW(watched_.check_in_place(), DataError);
}

TEST_F(WatchedFile, WhoseNameIsTakenByAnotherStaysWhatItIsForWhoHasItOpen) {
  replace();
  EXPECT_THROW(watched_.check(), DataError);
  EXPECT_NO_THROW(watched_.check_in_place());
}

TEST_F(WatchedFile, ThatIsWrittenToWhileItIsUsedIsToldOfInPlaceOfWhatFollows) {
  const auto fail = [] { throw DeviceError("counted other particles than before"); };
  EXPECT_THROW(watched_.unchanged_during(fail), DeviceError);
  const auto write_and_fail = [&] {
    write("b");
    fail();
  };
  EXPECT_THAT([&] { watched_.unchanged_during(write_and_fail); },
              ThrowsMessage<DataError>(HasSubstr("changed while it was used")));
}

}  // namespace
}  // namespace splotchcl::test
