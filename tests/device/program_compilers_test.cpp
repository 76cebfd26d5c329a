// Programs that another process compiles: here the other process is a pretence.
#include <future>
#include <mutex>
#include <thread>

#include "device/opencl/device_traits.h"
#include "device/opencl/program_cache.h"
#include "device/pictures.h"
#include "splotchcl/program_compiler.h"
#include "testing.h"

namespace splotchcl::test {
namespace {

using Binaries = std::map<std::string, std::string>;  // by source

// Answers with what is there, and writes down what was asked for.
struct Pretence {
  Binaries binaries;
  std::vector<ProgramToCompile> asked;
  int started = 0;

  StartCompiler start() {
    class Compiler : public ProgramCompiler {
     public:
      explicit Compiler(Pretence& pretence) : pretence_(pretence) {}
      std::string compile(const ProgramToCompile& program) override {
        const std::lock_guard lock(pretence_.mutex);
        pretence_.asked.push_back(program);
        const auto found = pretence_.binaries.find(program.source);
        return found == pretence_.binaries.end() ? std::string() : found->second;
      }

     private:
      Pretence& pretence_;
    };
    return [this]() -> std::unique_ptr<ProgramCompiler> {
      ++started;
      return std::make_unique<Compiler>(*this);
    };
  }

  std::mutex mutex;
};

class ProgramCompilers : public ::testing::Test {
 protected:
  void SetUp() override {
    DeviceContext device(choose_device(""));
    if (!quirks_of(device.device).shares_binaries || device.device.compute_units() < 2 ||
        std::thread::hardware_concurrency() < 2)
      GTEST_SKIP() << "only through PoCL, on several cores";
  }
  void TearDown() override { ::unsetenv("SPLOTCHCL_CACHE"); }

  static Frame small_frame() {
    return frame_of(40, 30, {component_of({{0, 0, 1, 1, 1}, {3, 2, 1, 9, 1}}, two_colors())});
  }
  // With no program compiled before, kept in this folder.
  static Image draw(const std::string& cache, const StartCompiler& start) {
    ::setenv("SPLOTCHCL_CACHE", cache.c_str(), 1);
    RendererOptions options;
    options.start_compiler = start;
    return Renderer(options).render(small_frame());
  }
  Image draw_in_new_folder(const StartCompiler& start) {
    return draw((folder_ / std::to_string(++folders_)).string(), start);
  }
  Image draw_alone() { return draw_in_new_folder({}); }

  splotchcl::test::TemporaryFolder folder_;
  int folders_ = 0;
};

TEST_F(ProgramCompilers, CompileProgramsOfTheSameBits) {
  Pretence pretence;
  draw_in_new_folder(pretence.start());  // to know the programs
  for (const ProgramToCompile& program : std::vector(pretence.asked))
    pretence.binaries[program.source] = LocalCompiler().compile(program);
  ASSERT_FALSE(pretence.binaries.empty());
  pretence.asked.clear();
  EXPECT_EQ(draw_in_new_folder(pretence.start()).pixels, draw_alone().pixels);
  EXPECT_FALSE(pretence.asked.empty());
}

TEST_F(ProgramCompilers, ThatFailAreDoneWithout) {
  Pretence pretence;
  EXPECT_EQ(draw_in_new_folder(pretence.start()).pixels, draw_alone().pixels);
  EXPECT_EQ(pretence.asked.size(), static_cast<std::size_t>(pretence.started));
}

TEST_F(ProgramCompilers, ThatAnswerWithNonsenseAreDoneWithout) {
  class Nonsense : public ProgramCompiler {
    std::string compile(const ProgramToCompile&) override { return "nonsense"; }
  };
  EXPECT_EQ(draw_in_new_folder([] { return std::make_unique<Nonsense>(); }).pixels,
            draw_alone().pixels);
}

TEST_F(ProgramCompilers, ThatThrowAreDoneWithout) {
  class Thrower : public ProgramCompiler {
    std::string compile(const ProgramToCompile&) override { throw std::runtime_error("thrown"); }
  };
  EXPECT_EQ(draw_in_new_folder([] { return std::make_unique<Thrower>(); }).pixels,
            draw_alone().pixels);
}

TEST_F(ProgramCompilers, ThatCannotBeStartedAreDoneWithout) {
  EXPECT_EQ(draw_in_new_folder([] { return nullptr; }).pixels, draw_alone().pixels);
}

TEST_F(ProgramCompilers, AreNotStartedWhereNothingIsKept) {
  Pretence pretence;
  draw("", pretence.start());
  EXPECT_EQ(pretence.started, 0);
}

TEST_F(ProgramCompilers, AreNotStartedForProgramsOfEarlierRuns) {
  const std::string cache = (folder_ / "kept").string();
  draw(cache, {});
  Pretence pretence;
  draw(cache, pretence.start());
  EXPECT_EQ(pretence.started, 0);
}

TEST_F(ProgramCompilers, HaveTheirProgramsKept) {
  const std::string cache = (folder_ / "kept").string();
  Pretence pretence;
  draw_in_new_folder(pretence.start());
  for (const ProgramToCompile& program : std::vector(pretence.asked))
    pretence.binaries[program.source] = LocalCompiler().compile(program);
  draw(cache, pretence.start());
  Pretence later;
  draw(cache, later.start());
  EXPECT_EQ(later.started, 0);
}

TEST(LocalCompiler, GivesNothingForADeviceThatIsNotThere) {
  EXPECT_EQ(LocalCompiler().compile({"no such device", "", "__kernel void nothing() {}"}), "");
}

TEST(LocalCompiler, GivesNothingForWhatIsNoProgram) {
  DeviceContext device(choose_device(""));
  EXPECT_EQ(LocalCompiler().compile({full_name_of(device.device), "", "no program"}), "");
}

TEST(SharedWork, IsDoneOnce) {
  std::vector<int> done(100, 0);
  std::mutex mutex;
  const auto count = [&](std::size_t item) {
    const std::lock_guard lock(mutex);
    ++done[item];
    return true;
  };
  share_work(100, count, {count, count});
  EXPECT_EQ(done, std::vector(100, 1));
}

TEST(SharedWork, OfOneThatGivesUpIsThatOneItem) {
  std::mutex mutex;
  std::vector<std::size_t> done, left;
  share_work(100,
             [&](std::size_t item) {
               const std::lock_guard lock(mutex);
               done.push_back(item);
             },
             {[&](std::size_t item) {
               const std::lock_guard lock(mutex);
               left.push_back(item);
               return false;
             }});
  EXPECT_LE(left.size(), 1U);
  EXPECT_EQ(done.size() + left.size(), 100U);
}

TEST(SharedWork, EndsWithTheExceptionOfTheCaller) {
  // The helper waits at its first item, or it might do all of them before the caller takes one.
  std::promise<void> taken_by_caller;
  const std::shared_future<void> caller_has_one = taken_by_caller.get_future().share();
  EXPECT_THROW(share_work(5,
                          [&](std::size_t) {
                            taken_by_caller.set_value();
                            throw std::runtime_error("here");
                          },
                          {[caller_has_one](std::size_t) {
                            caller_has_one.wait();
                            return true;
                          }}),
               std::runtime_error);
}

}  // namespace
}  // namespace splotchcl::test
