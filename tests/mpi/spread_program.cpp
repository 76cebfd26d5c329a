// A simulation whose particles are spread over ranks, for mpirun_test: draws a scene and writes the
// picture's floats.
//   spread_program SCENE OUTPUT [PARTICLES [DEVICE_OF_RANK_1]]
#include <mpi.h>

#include <chrono>
#include <cstdint>
#include <cstdio>
#include <cstdlib>
#include <exception>
#include <fstream>
#include <string>
#include <vector>

#include "splotchcl/array_snapshot.h"
#include "splotchcl/frame_drawer.h"
#include "splotchcl/mpi_communicator.h"
#include "splotchcl/scene_file.h"
#include "splotchcl/spread_snapshot.h"

namespace {

struct Arrays {
  std::vector<float> position, size, energy;
};

// Particle i is the same whoever has it.
Arrays particles(std::size_t begin, std::size_t end) {
  Arrays arrays;
  for (std::size_t i = begin; i < end; ++i) {
    std::uint64_t state = i;
    const auto uniform = [&state] {
      // SplitMix64.
      std::uint64_t bits = state += 0x9e3779b97f4a7c15u;
      bits = (bits ^ bits >> 30) * 0xbf58476d1ce4e5b9u;
      bits = (bits ^ bits >> 27) * 0x94d049bb133111ebu;
      return static_cast<float>((bits ^ bits >> 31) >> 40) / 16777216.0F;
    };
    for (int axis = 0; axis < 3; ++axis)
      arrays.position.push_back(uniform() + uniform() + uniform() - 1.5F);
    arrays.size.push_back(0.02F + 0.03F * uniform());
    arrays.energy.push_back(1 + 1000 * uniform() * uniform());
  }
  return arrays;
}

// The first of several ranks has a tenth of the particles, the last one the rest, others none.
std::size_t begin_of(int rank, int ranks, std::size_t count) {
  if (rank == 0) return 0;
  return rank == ranks ? count : count / 10;
}

void set(int type, const Arrays& arrays, splotchcl::ArraySnapshot& snapshot) {
  const std::size_t count = arrays.size.size();
  snapshot.set_mass(type, 1);
  snapshot.set_field(type, "position", arrays.position.data(), count, 3);
  snapshot.set_field(type, "smoothing_length", arrays.size.data(), count);
  snapshot.set_field(type, "internal_energy", arrays.energy.data(), count);
}

struct Call {
  std::string scene, output, device_of_rank_1;
  std::size_t count = 20000;
};

void draw(const Call& call, int rank, int ranks) {
  const std::size_t gas = call.count, stars = call.count / 4;
  const Arrays of_gas = particles(begin_of(rank, ranks, gas), begin_of(rank + 1, ranks, gas));
  const Arrays of_stars =
      particles(gas + begin_of(rank, ranks, stars), gas + begin_of(rank + 1, ranks, stars));
  splotchcl::ArraySnapshot own;
  set(0, of_gas, own);
  set(4, of_stars, own);
  splotchcl::FrameDrawerOptions options;
  options.ranks = splotchcl::ranks_of(MPI_COMM_WORLD);
  if (rank == 1) options.device = call.device_of_rank_1;
  splotchcl::FrameDrawer drawer(options);
  const splotchcl::SpreadSnapshot all(own, options.ranks);
  const auto start = std::chrono::steady_clock::now();
  const splotchcl::DrawnFrame drawn =
      drawer.draw(splotchcl::read_scene_file(call.scene, {"snapshot=\"memory\""}), all);
  const std::chrono::duration<double> seconds = std::chrono::steady_clock::now() - start;
  if (rank > 0) return;
  std::printf("%.3f seconds\n", seconds.count());
  std::ofstream file(call.output, std::ios::binary);
  const std::vector<float>& pixels = drawn.pictures.front().image.pixels;
  file.write(reinterpret_cast<const char*>(pixels.data()),
             static_cast<std::streamsize>(pixels.size() * sizeof(float)));
}

int run(const Call& call, int rank, int ranks) {
  try {
    draw(call, rank, ranks);
    return 0;
  } catch (const splotchcl::FailedElsewhere&) {
    return 1;
  } catch (const std::exception& error) {
    std::fprintf(stderr, "simulation: %s\n", error.what());
    return 1;
  }
}

}  // namespace

int main(int argc, char** argv) {
  if (argc < 3) return 2;
  MPI_Init(&argc, &argv);
  int rank = 0, ranks = 1;
  MPI_Comm_rank(MPI_COMM_WORLD, &rank);
  MPI_Comm_size(MPI_COMM_WORLD, &ranks);
  Call call = {argv[1], argv[2], argc > 4 ? argv[4] : ""};
  if (argc > 3) call.count = std::strtoul(argv[3], nullptr, 10);
  const int code = run(call, rank, ranks);
  MPI_Finalize();
  return code;
}
