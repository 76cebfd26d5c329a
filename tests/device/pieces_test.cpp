// Pieces of work that come with several work-items each (kernels/common/pieces.cl).
#include <gtest/gtest.h>

#include <cstdint>
#include <vector>

#include "device/opencl/launch.h"
#include "device/stages.h"

namespace splotchcl::test {
namespace {

constexpr const char* kernel = R"(
__kernel void count_pieces(const uint pieces, __global uint* times) {
  const uint piece = piece_of_item(pieces);
  if (piece == NO_PIECE) return;
  atomic_inc(times + piece);
}
)";

class Pieces : public StageTest {};

TEST_F(Pieces, AreDoneOnceEach) {
  const Program program = device().programs.get({"kernels/common/pieces.cl", "", "", kernel});
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
  const Program program = device().programs.get({"kernels/common/pieces.cl", "", "", kernel});
  const auto times = device().pool.upload(std::vector<std::uint32_t>(1, 0), "times");
  Launch(device(), "test", program.create_kernel("count_pieces"))
      .value(0u)
      .arg(times)
      .run_pieces(0);
  EXPECT_EQ(device().pool.download(times, 1), std::vector<std::uint32_t>(1, 0));
}

}  // namespace
}  // namespace splotchcl::test
