// Stars on their orbits in a disk, spread over the ranks of MPI by where they are, draw themselves
// as they go. Each rank has a sector of the disk and gives stars that leave it to the next one: the
// numbers of particles change from picture to picture, and no rank ever has them all.
//   mpirun -n 3 in_situ_mpi_cpp [FOLDER]     writes disk_0.png, disk_1.png, ... on rank 0
#include <mpi.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdio>
#include <exception>
#include <filesystem>
#include <random>
#include <string>
#include <vector>

#include "splotchcl/array_snapshot.h"
#include "splotchcl/frame_drawer.h"
#include "splotchcl/load.h"
#include "splotchcl/mpi_communicator.h"
#include "splotchcl/scene_file.h"
#include "splotchcl/spread_snapshot.h"

namespace {

constexpr double two_pi = 6.283185307179586;
constexpr int stars_in_all = 30000, pictures = 3, steps_per_picture = 10;

// The range of speeds and the brightness follow from the stars of all ranks.
const char* const scene_text = R"(
snapshot = "memory"
[image]
size = [480, 270]
gamma = 2
[camera]
position = [0, -3, 2]
look_at = [0, 0, 0]
sky = [0, 0, 1]
field_of_view = 45
[[component]]
types = ["stars"]
size = { fixed = 0.03 }
color = { field = "speed" }
palette = "temperature"
absorption = 0.4
)";

struct Star {
  float position[3], speed;
  double radius, angle, height;
};

void place(Star& star) {
  star.position[0] = static_cast<float>(star.radius * std::cos(star.angle));
  star.position[1] = static_cast<float>(star.radius * std::sin(star.angle));
  star.position[2] = static_cast<float>(star.height);
  star.speed = static_cast<float>(std::sqrt(star.radius / (0.1 + star.radius)));
}

// Which rank has the sector that the star is in.
int rank_of(const Star& star, int ranks) {
  const double part = star.angle / two_pi - std::floor(star.angle / two_pi);
  return std::min(ranks - 1, static_cast<int>(part * ranks));
}

// Every rank makes the same disk and keeps its sector.
std::vector<Star> make_sector(int rank, int ranks) {
  std::mt19937 engine(1);
  const auto uniform = [&engine] { return static_cast<double>(engine()) / 4294967296.0; };
  std::vector<Star> stars;
  for (int i = 0; i < stars_in_all; ++i) {
    Star star = {};
    star.radius = 0.1 - 0.5 * std::log(1 - 0.95 * uniform());
    // Two arms.
    star.angle = two_pi * uniform() + 0.6 * std::sin(2 * std::log(star.radius));
    star.height = 0.1 * (uniform() - 0.5);
    place(star);
    if (rank_of(star, ranks) == rank) stars.push_back(star);
  }
  return stars;
}

void step(std::vector<Star>& stars) {
  for (Star& star : stars) {
    star.angle += 0.02 * static_cast<double>(star.speed) / star.radius;
    place(star);
  }
}

// Those that have left the sector go to the rank that has theirs.
void exchange(std::vector<Star>& stars, int ranks) {
  std::vector<std::vector<Star>> leaving(static_cast<std::size_t>(ranks));
  for (const Star& star : stars)
    leaving[static_cast<std::size_t>(rank_of(star, ranks))].push_back(star);
  std::vector<int> sent, received(static_cast<std::size_t>(ranks)), from, to;
  std::vector<Star> out;
  for (const std::vector<Star>& part : leaving) {
    to.push_back(static_cast<int>(out.size() * sizeof(Star)));
    sent.push_back(static_cast<int>(part.size() * sizeof(Star)));
    out.insert(out.end(), part.begin(), part.end());
  }
  MPI_Alltoall(sent.data(), 1, MPI_INT, received.data(), 1, MPI_INT, MPI_COMM_WORLD);
  int bytes = 0;
  for (const int count : received) {
    from.push_back(bytes);
    bytes += count;
  }
  stars.resize(static_cast<std::size_t>(bytes) / sizeof(Star));
  MPI_Alltoallv(out.data(), sent.data(), to.data(), MPI_BYTE, stars.data(), received.data(),
                from.data(), MPI_BYTE, MPI_COMM_WORLD);
}

// What the pictures show, as arrays: floats are borrowed until the next step.
struct Arrays {
  std::vector<float> position, speed;

  void set(const std::vector<Star>& stars, splotchcl::ArraySnapshot& snapshot) {
    position.clear();
    speed.clear();
    for (const Star& star : stars) {
      position.insert(position.end(), star.position, star.position + 3);
      speed.push_back(star.speed);
    }
    snapshot.clear(4);
    snapshot.set_field(4, "position", position.data(), stars.size(), 3);
    snapshot.set_field(4, "speed", speed.data(), stars.size());
  }
};

void run(const std::filesystem::path& folder, int rank, int ranks) {
  std::vector<Star> stars = make_sector(rank, ranks);
  Arrays arrays;
  splotchcl::ArraySnapshot own("disk");
  arrays.set(stars, own);

  splotchcl::FrameDrawerOptions options;
  options.ranks = splotchcl::ranks_of(MPI_COMM_WORLD);
  splotchcl::FrameDrawer drawer(options);
  splotchcl::SpreadSnapshot all(own, options.ranks);
  splotchcl::Scene scene = splotchcl::parse_scene(scene_text, "disk");
  std::vector<std::string> notes;

  for (int picture = 0; picture < pictures; ++picture) {
    for (int i = 0; i < steps_per_picture; ++i)
      step(stars);
    exchange(stars, ranks);
    arrays.set(stars, own);
    all.changed();
    // What the first picture chooses from the data, such as its exposure, holds for all.
    if (picture == 0) scene = splotchcl::fixed_scene(splotchcl::decide(scene, all, notes));
    const splotchcl::DrawnFrame drawn = drawer.draw(scene, all);
    if (rank > 0) continue;
    const auto path = folder / ("disk_" + std::to_string(picture) + ".png");
    splotchcl::write_pictures(path, drawn.pictures, splotchcl::image_file_options(scene));
    std::printf("%s\n", path.c_str());
  }
}

}  // namespace

int main(int argc, char** argv) {
  int provided = 0, rank = 0, ranks = 1;
  MPI_Init_thread(&argc, &argv, MPI_THREAD_FUNNELED, &provided);
  MPI_Comm_rank(MPI_COMM_WORLD, &rank);
  MPI_Comm_size(MPI_COMM_WORLD, &ranks);
  try {
    run(argc > 1 ? argv[1] : ".", rank, ranks);
  } catch (const splotchcl::FailedElsewhere&) {
    // Another rank tells.
    MPI_Finalize();
    return 1;
  } catch (const std::exception& error) {
    std::fprintf(stderr, "in_situ_mpi: %s\n", error.what());
    // A failure that the ranks have agreed upon ends them all; of any other they do not know.
    if (dynamic_cast<const splotchcl::AgreedFailure*>(&error) == nullptr)
      MPI_Abort(MPI_COMM_WORLD, 1);
    MPI_Finalize();
    return 1;
  }
  MPI_Finalize();
  return 0;
}
