/* A cold ball of particles collapses and draws itself, in C.
 *   in_situ_c [FOLDER]     writes collapse_0.png, collapse_1.png, ... */
#include <math.h>
#include <splotchcl/splotchcl_c.h>
#include <stdio.h>
#include <stdlib.h>

enum { count = 1000, pictures = 3, steps_per_picture = 20 };

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

static double position[3 * count], velocity[3 * count];

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
  for (int i = 0; i < count; ++i) {
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
  for (int i = 0; i < 3 * count; ++i)
    position[i] += time * velocity[i];
}

static int fail(const splotchcl_error* error) {
  fprintf(stderr, "in_situ: %s\n", error->message);
  return error->code;
}

int main(int argc, char** argv) {
  const char* const folder = argc > 1 ? argv[1] : ".";
  splotchcl_error error;
  splotchcl_scene* scene = splotchcl_scene_from_text(scene_text, &error);
  if (!scene) return fail(&error);
  splotchcl_renderer* renderer = splotchcl_renderer_new(NULL, &error);
  if (!renderer) return fail(&error);
  splotchcl_particles* particles = splotchcl_particles_new();
  int width = 0, height = 0;
  if (splotchcl_scene_picture_size(scene, 0, &width, &height, &error)) return fail(&error);
  const size_t floats = 4 * (size_t)width * (size_t)height;
  float* image = malloc(sizeof(float) * floats);
  if (!image || !particles) return 1;

  make_ball();
  for (int picture = 0; picture < pictures; ++picture) {
    char path[1000];
    for (int i = 0; i < steps_per_picture; ++i)
      step(0.025);
    if (splotchcl_particles_set_doubles(particles, 1, "position", position, count, 3, &error) ||
        splotchcl_particles_set_mass(particles, 1, 1.0 / count, &error))
      return fail(&error);
    /* What the first picture chooses from the data, such as its exposure, holds for all. */
    if (picture == 0 && splotchcl_scene_decide(scene, particles, &error)) return fail(&error);
    if (splotchcl_draw(renderer, scene, particles, &image, &floats, 1, &error)) return fail(&error);
    snprintf(path, sizeof path, "%s/collapse_%d.png", folder, picture);
    if (splotchcl_write_image(path, image, width, height, 2, &error)) return fail(&error);
    printf("%s\n", path);
  }
  free(image);
  splotchcl_particles_free(particles);
  splotchcl_renderer_free(renderer);
  splotchcl_scene_free(scene);
  return 0;
}
