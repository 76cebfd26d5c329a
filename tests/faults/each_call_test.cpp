// Every command while one call of the system fails, whichever: it ends in time, with one line and
// exit code 1 or as if nothing had been, nothing is half written, and the next run is whole.
#include "cli/program.h"
#include "faults/counted_calls.h"
#include "faults/files_in.h"
#include "testing.h"

namespace splotchcl::test {
namespace {

struct Command {
  std::string name, line;
  std::string kept;      // what there may be beside the outputs when it has failed begins so
  std::string fault_in;  // whose calls fail, as SPLOTCHCL_FAULT_IN has it
};

void PrintTo(const Command& command, std::ostream* out) {
  *out << command.name;
}

const std::string film =
    "movie h --size 32x24 --set path.orbit.degrees=10 --set movie.frames=2 -o ";
const std::string few = "--disk-stars 50 --bulge-stars 50 --clusters 1 --cluster-stars 10";

// A signal is lost where the pipe by which it is told of cannot be written to: hence several.
constexpr const char* look_at_a_page = R"(
"$splotchcl" view h --size 32x24 > address & view=$!
for i in $(seq 3000); do [ -s address ] && break; [ -e /proc/$view/exe ] || break; sleep 0.01; done
address=$(cat address)
if [ -n "$address" ]; then
  host=${address#http://}; host=${host%%/*}
  (exec 3<> "/dev/tcp/${host%:*}/${host##*:}" &&
    printf 'GET /%s HTTP/1.1\r\nHost: %s\r\nConnection: close\r\n\r\n' "${address#http://*/}" "$host" >&3 &&
    timeout 10 cat <&3 > page) 2> /dev/null
  for i in 1 2 3 4 5; do kill -INT $view 2> /dev/null || break; sleep 0.5; done
fi
wait $view; code=$?
rm -f address page
exit $code
)";

std::vector<Command> commands() {
  return {
      {"render", "\"$splotchcl\" render h -o a.png --size 64x48", "", ""},
      {"render_with_smoothing_lengths",
       "\"$splotchcl\" render t.txt -o a.exr --size 32x24 --cache-smoothing-lengths",
       "t.txt.type0.smoothing_lengths", ""},
      {"render_that_compiles",
       "rm -rf cache; SPLOTCHCL_CACHE=$PWD/cache \"$splotchcl\" render h -o a.png --size 16x12; "
       "code=$?; rm -rf cache; exit $code",
       "", ""},
      {"render_whose_compilers_fail",
       "rm -rf cache; SPLOTCHCL_CACHE=$PWD/cache \"$splotchcl\" render h -o a.png --size 16x12; "
       "code=$?; rm -rf cache; exit $code",
       "", "children"},
      {"map", "\"$splotchcl\" map h -o m.fits --size 32x32", "", ""},
      {"movie", "\"$splotchcl\" " + film + "f.mp4", "f.mp4.frames/", ""},
      {"movie_of_images", "\"$splotchcl\" " + film + "f%d.png", "f%d.png.movie.txt", ""},
      {"publish", "\"$splotchcl\" publish h -o p.html --size 16x12 --splats 50", "", ""},
      {"index", "\"$splotchcl\" index h", "", ""},
      {"tree", "\"$splotchcl\" tree h", "", ""},
      {"galaxy", "\"$splotchcl\" galaxy spot.png -o g.hdf5 " + few, "", ""},
      {"generate", "\"$splotchcl\" generate halo -o g --particles 1000", "", ""},
      {"view", look_at_a_page, "", ""},
  };
}

// Of what is told the errors, not the notes.
bool is_one_error(const std::string& told) {
  std::istringstream lines(told);
  int errors = 0;
  for (std::string line; std::getline(lines, line);) {
    if (line.rfind("splotchcl: note: ", 0) != 0) ++errors;
  }
  return errors == 1;
}

bool begins_with(const std::string& text, const std::string& begin) {
  return !begin.empty() && text.compare(0, begin.size(), begin) == 0;
}
bool ends_with(const std::string& text, const std::string& end) {
  return text.size() >= end.size() && text.compare(text.size() - end.size(), end.size(), end) == 0;
}

class EachCall : public ::testing::TestWithParam<Command> {
 protected:
  void SetUp() override {
    SKIP_WITHOUT_DEVICE();
    const bool is_film = GetParam().name == "movie";
    if (is_film && run_in(inputs_, "command -v ffmpeg").exit_code != 0) GTEST_SKIP() << "no ffmpeg";
    splotchcl_in(inputs_, "generate halo -o h --particles 1000");
    splotchcl_in(inputs_, "render h -o spot.png --size 32x24");
    std::ofstream table(inputs_ / "t.txt");
    table << "x y z\n";
    for (int i = 0; i < 300; ++i)
      table << i % 7 << ' ' << i % 11 << ' ' << i % 13 << '\n';
    table.close();
    std::ofstream(inputs_ / "command") << GetParam().line;
    start_anew();
    before_ = files_in(folder_.path());
  }

  void start_anew() const {
    std::filesystem::remove_all(folder_.path());
    // With their times, which an index keeps.
    run_in(inputs_, "cp -a . '" + folder_.path().string() + "'");
  }
  ProgramResult run(const std::string& environment) const {
    return run_in(folder_, environment + " timeout 60 bash command");
  }

  // How often each call is made where none fails, after which all outputs are there.
  std::vector<long> count_calls() {
    const auto counts = (inputs_ / "counts").string();
    EXPECT_EQ(run("LD_PRELOAD=" SPLOTCHCL_FAILING_CALLS " SPLOTCHCL_FAULT_COUNTS=" + counts +
                  " SPLOTCHCL_FAULT_IN=" + GetParam().fault_in)
                  .exit_code,
              0);
    whole_ = files_in(folder_.path());
    const std::string bytes = read_text(counts);
    std::filesystem::remove(counts);
    std::vector<long> result(counted_calls.size());
    EXPECT_EQ(bytes.size(), result.size() * sizeof(long));
    if (bytes.size() == result.size() * sizeof(long)) {
      std::memcpy(result.data(), bytes.data(), bytes.size());
    }
    return result;
  }

  // Some of so many: all in long tests, but for allocations, of which there are too many. Of these
  // the last as well, by which outputs are written.
  std::vector<long> chosen(const std::string& call, long count) {
    const bool are_many = call == "malloc";
    const std::size_t most = long_tests() ? (are_many ? 300 : 1000) : (are_many ? 4 : 2);
    std::vector<long> all(static_cast<std::size_t>(count)), some;
    for (long i = 0; i < count; ++i)
      all[static_cast<std::size_t>(i)] = i + 1;
    const std::ptrdiff_t last = long_tests() && are_many ? std::min(50L, count) : 0;
    std::sample(all.begin(), all.end() - last, std::back_inserter(some), most, random_);
    some.insert(some.end(), all.end() - last, all.end());
    return some;
  }

  void fail(const std::string& call, long which) const {
    const std::string fault = call + ":" + std::to_string(which);
    SCOPED_TRACE(fault);
    start_anew();
    const ProgramResult result =
        run("LD_PRELOAD=" SPLOTCHCL_FAILING_CALLS " SPLOTCHCL_FAULT=" + fault +
            " SPLOTCHCL_FAULT_IN=" + GetParam().fault_in);
    const Files after = files_in(folder_.path());
    if (result.exit_code == 0) {
      expect_whole(after, call == "unlink");
    } else {
      EXPECT_EQ(result.exit_code, 1) << result.err;
      EXPECT_TRUE(is_one_error(result.err)) << result.err;
      expect_nothing_half_written(after, call == "unlink");
    }
    if (after != before_ && after != whole_) expect_whole_next_time(call == "unlink");
  }

  // Where nothing can be removed, what is temporary stays until the next run.
  bool is_temporary(const std::string& name) const {
    return ends_with(name, ".part") || begins_with(name, GetParam().kept);
  }

  void expect_whole(const Files& after, bool may_have_temporary) const {
    for (const auto& [name, content] : whole_) {
      const auto found = after.find(name);
      const bool may_be_missing = begins_with(name, GetParam().kept);
      EXPECT_TRUE(found == after.end() ? may_be_missing : found->second == content) << name;
    }
    for (const auto& [name, content] : after) {
      EXPECT_TRUE(whole_.count(name) > 0 || (may_have_temporary && is_temporary(name))) << name;
    }
  }

  void expect_nothing_half_written(const Files& after, bool may_have_temporary) const {
    for (const auto& [name, content] : before_)
      EXPECT_EQ(after.count(name), 1U) << name;
    for (const auto& [name, content] : after) {
      const auto whole = whole_.find(name);
      const bool is_whole = whole != whole_.end() && whole->second == content;
      const bool is_kept = begins_with(name, GetParam().kept) && !ends_with(name, ".part");
      EXPECT_TRUE(is_whole || is_kept || (may_have_temporary && is_temporary(name))) << name;
    }
  }

  // What stays beside kept smoothing lengths goes when they are found anew.
  void expect_whole_next_time(bool may_have_temporary) const {
    const ProgramResult result = run("");
    EXPECT_EQ(result.exit_code, 0) << result.err;
    expect_whole(files_in(folder_.path()), may_have_temporary && !GetParam().kept.empty());
  }

  TemporaryFolder inputs_{"inputs"}, folder_{"run"};
  Files before_, whole_;
  std::mt19937 random_{7};
};

TEST_P(EachCall, ThatFailsLeavesNothingHalfWritten) {
  const std::vector<long> counts = count_calls();
  std::string told;
  for (std::size_t i = 0; i < counts.size(); ++i) {
    const std::vector<long> some = chosen(counted_calls[i], counts[i]);
    for (const long which : some)
      fail(counted_calls[i], which);
    told += " " + std::string(counted_calls[i]) + " " + std::to_string(some.size()) + "/" +
            std::to_string(counts[i]);
  }
  RecordProperty("calls", told);
  std::cout << GetParam().name << ":" << told << '\n';
}

INSTANTIATE_TEST_SUITE_P(OfCommands, EachCall, ::testing::ValuesIn(commands()),
                         [](const auto& command) { return command.param.name; });

}  // namespace
}  // namespace splotchcl::test
