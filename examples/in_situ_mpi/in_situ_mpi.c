/* A cold ball of particles collapses and draws itself, in C. Each rank of MPI has a part of the
 * particles, the last one the most; all ranks see all positions when they pull at each other.
 *   mpirun -n 3 in_situ_mpi_c [FOLDER]     writes collapse_0.png, collapse_1.png, ... on rank 0 */
#include <math.h>
#include <mpi.h>
#include <splotchcl/splotchcl_mpi.h>
#include <stdio.h>
#include <stdlib.h>

enum { count = 1200, pictures = 3, steps_per_picture = 20 };

static const char* const scene_text =
    "[image]\n"
    "size = [320, 320]\n"
    "gamma = 2\n"
    "[camera]\n"
    "position = [0, 0, -4]\n"
    "look_at = [0, 0, 0]\n"
    "[[component]]\n"
    "types = ['halo']\n"
    "size = { fixed = 0.15 }\n"
    "palette = 'white'\n"
    "brightness = 0.3\n";

/* Positions of all particles; velocities of those of this rank, first to end. */
static double position[3 * count], velocity[3 * count];
static int rank, ranks, first, end;
static int begin_of[1000], values_of[1000];

static int begin_of_rank(int r) {
  return (int)((double)count * r * r / ((double)ranks * ranks));
}

static double uniform(void) {
  return 2.0 * rand() / RAND_MAX - 1;
}

static void make_ball(void) {
  for (int i = 0; i < count; ++i) {
    double* const p = position + 3 * i;
    do {
      for (int axis = 0; axis < 3; ++axis)
        p[axis] = uniform();
    } while (p[0] * p[0] + p[1] * p[1] + p[2] * p[2] > 1);
  }
}

/* All pairs, softened; the whole ball has mass 1. */
static void step(double time) {
  for (int i = first; i < end; ++i) {
    double pull[3] = {0, 0, 0};
    for (int j = 0; j < count; ++j) {
      double d[3], square = 0.01;
      for (int axis = 0; axis < 3; ++axis) {
        d[axis] = position[3 * j + axis] - position[3 * i + axis];
        square += d[axis] * d[axis];
      }
      for (int axis = 0; axis < 3; ++axis)
        pull[axis] += d[axis] / (square * sqrt(square) * count);
    }
    for (int axis = 0; axis < 3; ++axis)
      velocity[3 * i + axis] += time * pull[axis];
  }
  for (int i = 3 * first; i < 3 * end; ++i)
    position[i] += time * velocity[i];
  MPI_Allgatherv(MPI_IN_PLACE, 0, MPI_DATATYPE_NULL, position, values_of, begin_of, MPI_DOUBLE,
                 MPI_COMM_WORLD);
}

/* Of the ranks one has the message: they all end. */
static int fail(const splotchcl_error* error) {
  if (error->message[0]) fprintf(stderr, "in_situ_mpi: %s\n", error->message);
  MPI_Finalize();
  return error->code;
}

int main(int argc, char** argv) {
  MPI_Init(&argc, &argv);
  MPI_Comm_rank(MPI_COMM_WORLD, &rank);
  MPI_Comm_size(MPI_COMM_WORLD, &ranks);
  if (ranks > 1000) MPI_Abort(MPI_COMM_WORLD, 2);
  for (int r = 0; r < ranks; ++r) {
    begin_of[r] = 3 * begin_of_rank(r);
    values_of[r] = 3 * begin_of_rank(r + 1) - begin_of[r];
  }
  first = begin_of_rank(rank);
  end = begin_of_rank(rank + 1);

  const char* const folder = argc > 1 ? argv[1] : ".";
  splotchcl_error error;
  splotchcl_ranks* all = splotchcl_ranks_of(MPI_COMM_WORLD, &error);
  if (!all) return fail(&error);
  splotchcl_renderer* renderer = splotchcl_renderer_new_for_ranks(NULL, all, &error);
  if (!renderer) return fail(&error);
  splotchcl_scene* scene = splotchcl_scene_from_text(scene_text, &error);
  if (!scene) return fail(&error);
  splotchcl_particles* particles = splotchcl_particles_new();
  int width = 0, height = 0;
  if (splotchcl_scene_picture_size(scene, 0, &width, &height, &error)) return fail(&error);
  const size_t floats = 4 * (size_t)width * (size_t)height;
  float* image = rank == 0 ? malloc(sizeof(float) * floats) : NULL;
  if ((rank == 0 && !image) || !particles) MPI_Abort(MPI_COMM_WORLD, 1);

  make_ball();
  for (int picture = 0; picture < pictures; ++picture) {
    for (int i = 0; i < steps_per_picture; ++i)
      step(0.025);
    /* This rank's own particles. */
    if (splotchcl_particles_set_doubles(particles, 1, "position", position + 3 * first,
                                        (uint64_t)(end - first), 3, &error) ||
        splotchcl_particles_set_mass(particles, 1, 1.0 / count, &error)) {
      fprintf(stderr, "in_situ_mpi: %s\n", error.message);
      MPI_Abort(MPI_COMM_WORLD, error.code);
    }
    /* What the first picture chooses from the data, such as its exposure, holds for all. */
    if (picture == 0 && splotchcl_scene_decide_for_ranks(scene, particles, all, &error))
      return fail(&error);
    /* The picture is wanted on rank 0 alone. */
    if (splotchcl_draw(renderer, scene, particles, &image, &floats, rank == 0 ? 1 : 0, &error))
      return fail(&error);
    if (rank > 0) continue;
    char path[1000];
    snprintf(path, sizeof path, "%s/collapse_%d.png", folder, picture);
    if (splotchcl_write_image(path, image, width, height, 2, &error)) {
      fprintf(stderr, "in_situ_mpi: %s\n", error.message);
      MPI_Abort(MPI_COMM_WORLD, error.code);
    }
    printf("%s\n", path);
  }
  free(image);
  splotchcl_particles_free(particles);
  splotchcl_renderer_free(renderer);
  splotchcl_ranks_free(all);
  splotchcl_scene_free(scene);
  MPI_Finalize();
  return 0;
}
