#include "device/opencl/binary_cache.h"

#include <unistd.h>

#include <chrono>

#include "testing.h"

namespace splotchcl {
namespace {

namespace fs = std::filesystem;

class BinaryCacheTest : public testing::Test {
 protected:
  void SetUp() override { fs::remove_all(folder_); }
  void TearDown() override { fs::remove_all(folder_); }

  fs::path only_file() const {
    EXPECT_EQ(std::distance(fs::directory_iterator(folder_), fs::directory_iterator()), 1);
    return fs::directory_iterator(folder_)->path();
  }

  const fs::path folder_ = fs::path(testing::TempDir()) / "splotchcl_binaries" / "of_a_test";
  const BinaryCache cache_{folder_};
  const std::string binary_ = std::string("code\0with\nanything", 18);
};

TEST_F(BinaryCacheTest, FindsWhatWasKeptUnderTheSameKeyOnly) {
  EXPECT_FALSE(cache_.find("device\nsource"));
  cache_.keep("device\nsource", binary_);
  EXPECT_EQ(cache_.find("device\nsource"), binary_);
  EXPECT_FALSE(cache_.find("device\nother source"));
}

TEST_F(BinaryCacheTest, LeavesNothingUnfinishedBeside) {
  cache_.keep("key", binary_);
  cache_.keep("key", "newer");
  EXPECT_EQ(only_file().extension(), ".kernels");
  EXPECT_EQ(cache_.find("key"), "newer");
}

TEST_F(BinaryCacheTest, RemovesWhatWasLeftUnfinishedAnHourAgo) {
  cache_.keep("key", binary_);
  const fs::path old = only_file().string() + ".123", young = only_file().string() + ".456",
                 other = folder_ / "other.kernels.123";
  for (const fs::path& file : {old, young, other})
    std::ofstream(file) << "half";
  for (const fs::path& file : {old, other})
    fs::last_write_time(file, fs::file_time_type::clock::now() - std::chrono::hours(2));
  cache_.keep("key", binary_);
  EXPECT_FALSE(fs::exists(old));
  EXPECT_TRUE(fs::exists(young) && fs::exists(other));
}

TEST_F(BinaryCacheTest, IgnoresAFileThatIsCutOrOfAnotherKey) {
  cache_.keep("key", binary_);
  const fs::path file = only_file();
  for (std::uintmax_t size = fs::file_size(file); size > 0; --size) {
    fs::resize_file(file, size - 1);
    EXPECT_FALSE(cache_.find("key")) << "cut to " << size - 1 << " bytes";
  }
  cache_.keep("yek", binary_);
  fs::rename(fs::directory_iterator(folder_)->path() == file
                 ? std::next(fs::directory_iterator(folder_))->path()
                 : fs::directory_iterator(folder_)->path(),
             file);
  EXPECT_FALSE(cache_.find("key"));
}

TEST_F(BinaryCacheTest, ClaimsNoMemoryForAFileThatHasGrown) {
  cache_.keep("key", binary_);
  fs::resize_file(only_file(), std::uintmax_t{1} << 40);
  EXPECT_FALSE(cache_.find("key"));
}

TEST_F(BinaryCacheTest, IgnoresAFileWithAnyByteChanged) {
  cache_.keep("key", binary_);
  const fs::path file = only_file();
  std::string bytes(fs::file_size(file), '\0');
  std::ifstream(file, std::ios::binary)
      .read(bytes.data(), static_cast<std::streamsize>(bytes.size()));
  for (std::size_t i = 0; i < bytes.size(); ++i) {
    std::string flipped = bytes;
    flipped[i] = static_cast<char>(flipped[i] ^ 4);
    std::ofstream(file, std::ios::binary) << flipped;
    EXPECT_FALSE(cache_.find("key")) << "byte " << i;
  }
}

TEST_F(BinaryCacheTest, UsesNoFolderThatSomeoneElseMayHaveMadeSinceItWasMissing) {
  fs::create_directories(folder_);
  fs::permissions(folder_, fs::perms::all);
  cache_.keep("key", binary_);
  EXPECT_TRUE(fs::is_empty(folder_));
  fs::permissions(folder_, fs::perms::owner_all);
  cache_.keep("key", binary_);
  fs::permissions(folder_, fs::perms::all);
  EXPECT_FALSE(cache_.find("key"));
}

TEST_F(BinaryCacheTest, UsesNoFolderThatOthersMayWriteTo) {
  cache_.keep("key", binary_);
  EXPECT_EQ(cache_.note(), "");
  fs::permissions(folder_, fs::perms::group_write, fs::perm_options::add);
  const BinaryCache shared(folder_);
  EXPECT_NE(shared.note().find("may be written to by others"), std::string::npos) << shared.note();
  EXPECT_FALSE(shared.find("key"));
  fs::permissions(folder_, fs::perms::group_write, fs::perm_options::remove);
  EXPECT_EQ(BinaryCache(folder_).find("key"), binary_);
}

TEST_F(BinaryCacheTest, UsesNoFolderOfAnotherUser) {
  cache_.keep("key", binary_);
  if (::chown(folder_.c_str(), 65534, 65534) != 0)
    GTEST_SKIP() << "only root may give folders away";
  const BinaryCache given_away(folder_);
  EXPECT_NE(given_away.note().find("belongs to someone else"), std::string::npos);
  EXPECT_FALSE(given_away.find("key"));
}

TEST_F(BinaryCacheTest, MakesAFolderOfItsUsersOwn) {
  cache_.keep("key", binary_);
  EXPECT_EQ(fs::status(folder_).permissions() & (fs::perms::group_all | fs::perms::others_all),
            fs::perms::none);
}

TEST_F(BinaryCacheTest, WithoutAFolderKeepsNothing) {
  const BinaryCache none(std::nullopt);
  none.keep("key", binary_);
  EXPECT_FALSE(none.find("key"));
}

TEST_F(BinaryCacheTest, LiesWhereTheUserSays) {
  const auto folder_with = [](const char* value) {
    setenv("SPLOTCHCL_CACHE", value, 1);
    const auto folder = BinaryCache::user_folder();
    unsetenv("SPLOTCHCL_CACHE");
    return folder;
  };
  EXPECT_EQ(folder_with("/somewhere"), fs::path("/somewhere"));
  EXPECT_EQ(folder_with(""), std::nullopt);
}

TEST_F(BinaryCacheTest, DoesWithoutAFolderThatCannotBeMade) {
  fs::create_directories(folder_.parent_path());
  std::ofstream(folder_) << "a file";
  cache_.keep("key", binary_);
  EXPECT_FALSE(cache_.find("key"));
}

}  // namespace
}  // namespace splotchcl
