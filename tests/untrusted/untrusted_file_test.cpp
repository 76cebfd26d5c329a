// Files that may be anything are read in a child process: whatever they do to a library, what comes
// back is nothing or an error.
#include "splotchcl/untrusted_file.h"

#include <gtest/gtest.h>

#include <fstream>
#include <string>

#include "damaged_hdf5.h"
#include "formats/hdf5/snapshot_hdf5_writer.h"
#include "splotchcl/error.h"
#include "splotchcl/image_file.h"
#include "temporary_folder.h"

namespace splotchcl::test {
namespace {

class UntrustedFile : public ::testing::Test {
 protected:
  void SetUp() override { write_hdf5(folder_ / "whole.hdf5", small_snapshot()); }
  TemporaryFolder folder_;
};

TEST_F(UntrustedFile, ThatIsWholePasses) {
  EXPECT_NO_THROW(check_untrusted_snapshot(folder_ / "whole.hdf5"));
  write_image(folder_ / "whole.png", Image(4, 3));
  EXPECT_NO_THROW(check_untrusted_image(folder_ / "whole.png"));
}

TEST_F(UntrustedFile, ThatIsNotThereIsAnError) {
  EXPECT_THROW(check_untrusted_snapshot(folder_ / "none.hdf5"), DataError);
  EXPECT_THROW(check_untrusted_image(folder_ / "none.png"), DataError);
}

TEST_F(UntrustedFile, HasColumnsAsOpenedFilesHave) {
  SnapshotOptions options;
  options.columns = {"x", "y", "z"};
  EXPECT_THROW(check_untrusted_snapshot(folder_ / "whole.hdf5", options), UsageError);
}

// Some of them make HDF5 crash.
TEST_F(UntrustedFile, ThatIsDamagedPassesOrIsAnErrorAndNothingElse) {
  DamagedHdf5 damaged(read_text(folder_ / "whole.hdf5"), 1);
  int errors = 0;
  for (int i = 0; i < 60; ++i) {
    std::ofstream(folder_ / "damaged.hdf5", std::ios::binary) << damaged.next();
    try {
      check_untrusted_snapshot(folder_ / "damaged.hdf5");
    } catch (const DataError&) {
      ++errors;
    }
  }
  EXPECT_GE(errors, 10);
}

TEST_F(UntrustedFile, ThatIsHalfAPictureIsAnError) {
  write_image(folder_ / "half.png", Image(50, 50));
  std::filesystem::resize_file(folder_ / "half.png",
                               std::filesystem::file_size(folder_ / "half.png") / 2);
  EXPECT_THROW(check_untrusted_image(folder_ / "half.png"), DataError);
}

}  // namespace
}  // namespace splotchcl::test
