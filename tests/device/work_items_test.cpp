#include "device/opencl/launch.h"
#include "device/stages.h"
#include "testing.h"

namespace splotchcl::test {
namespace {

// Flags of work-items as bits of a word, and words taken apart again.

constexpr std::size_t flags_of_word = 32, words_of_group = 8;

class FlagsTest : public StageTest {
 protected:
  static ProgramSource source(const std::string& kernel) {
    return {"kernels/common/flags.cl", "", "", kernel};
  }
};

TEST_F(FlagsTest, AreBitsOfWhichTheFirstItemsIsTheHighest) {
  constexpr std::size_t items = flags_of_word * words_of_group;
  std::mt19937 random(3);
  std::vector<std::uint32_t> flags(items), expected(words_of_group, 0);
  for (std::size_t i = 0; i < items; ++i) {
    flags[i] = random() % 3 == 0 ? 5 : 0;
    if (flags[i] != 0) expected[i / flags_of_word] |= 0x80000000u >> i % flags_of_word;
  }
  const auto words = device().pool.get<std::uint32_t>(words_of_group, "words");
  const Program program = device().programs.get(source(R"(
__kernel __attribute__((reqd_work_group_size(256, 1, 1))) void flag(
    __global const uint* flags, __global uint* words) {
  __local Flags own[8];
  const uint item = get_local_id(0);
  store_flag(own + item / FLAGS, item % FLAGS, (int)flags[item]);
  barrier(CLK_LOCAL_MEM_FENCE);
  if (item < 8) words[item] = bits_of_flags(own + item);
}
)"));
  Launch(device(), "test", program.create_kernel("flag"))
      .arg(device().pool.upload(flags, "flags"))
      .arg(words)
      .run_groups(1, items);
  EXPECT_EQ(device().pool.download(words, words_of_group), expected);
}

TEST_F(FlagsTest, AreTakenFromTheFirstOn) {
  const auto results = device().pool.get<std::uint32_t>(6, "results");
  const Program program = device().programs.get(source(R"(
__kernel void take(__global uint* results) {
  uint bits = 0x90000001u;
  results[0] = take_first(&bits);
  results[1] = take_first(&bits);
  results[2] = bits;
  results[3] = bits_behind(0x90000001u, 0);
  results[4] = bits_behind(0x90000001u, 2);
  results[5] = bits_behind(0x90000001u, 3);
}
)"));
  Launch(device(), "test", program.create_kernel("take")).arg(results).run_items(1);
  EXPECT_EQ(device().pool.download(results, 6),
            (std::vector<std::uint32_t>{0, 3, 1, 0xffffffffu, 1, 0}));
}

// Pieces of work that come with several work-items each (kernels/common/common.cl).

constexpr const char* kernel = R"(
__kernel void count_pieces(const uint pieces, __global uint* times) {
  const uint piece = piece_of_item(pieces);
  if (piece == NO_PIECE) return;
  atomic_inc(times + piece);
}
)";

class Pieces : public StageTest {};

TEST_F(Pieces, AreDoneOnceEach) {
  const Program program = device().programs.get({"kernels/common/common.cl", "", "", kernel});
  for (const std::uint32_t pieces : {1u, 2u, 3u, 122u, 1023u, 1024u, 1025u, 5000u}) {
    const std::vector<std::uint32_t> none(pieces, 0), once(pieces, 1);
    const auto times = device().pool.upload(none, "times");
    Launch(device(), "test", program.create_kernel("count_pieces"))
        .value(pieces)
        .arg(times)
        .run_pieces(pieces);
    EXPECT_EQ(device().pool.download(times, pieces), once) << pieces;
  }
}

TEST_F(Pieces, MayBeNone) {
  const Program program = device().programs.get({"kernels/common/common.cl", "", "", kernel});
  const auto times = device().pool.upload(std::vector<std::uint32_t>(1, 0), "times");
  Launch(device(), "test", program.create_kernel("count_pieces"))
      .value(0u)
      .arg(times)
      .run_pieces(0);
  EXPECT_EQ(device().pool.download(times, 1), std::vector<std::uint32_t>(1, 0));
}

}  // namespace
}  // namespace splotchcl::test
