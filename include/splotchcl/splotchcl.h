#ifndef SPLOTCHCL_SPLOTCHCL_H
#define SPLOTCHCL_SPLOTCHCL_H

/* Draws a simulation's own arrays, in its own process: the library call for C, and for every
 * language that can call C. C++ programs have more at hand in the other headers.
 *
 * A scene says what to draw and how, in the words of docs/scene.md; its key `snapshot` is not
 * needed, since particles come from memory. No function but splotchcl_scene_from_file and
 * splotchcl_write_image touches a file, unless the scene itself names one (a palette, a
 * background, another snapshot).
 *
 * Functions that can fail take a last argument `error`, which may be null. Those that return an
 * int return 0, 1 (the data or the device failed) or 2 (the call or the scene is wrong), those
 * that return a pointer null. Nothing is kept behind the caller's back: objects may be used from
 * any thread, each from one at a time. Free functions take null.
 */

#include <stddef.h>
#include <stdint.h>

#ifdef __cplusplus
extern "C" {
#endif

/* One line that says what was found, what was expected and what to do. */
typedef struct splotchcl_error {
  int code; /* 0: no error */
  char message[1020];
} splotchcl_error;

typedef struct splotchcl_scene splotchcl_scene;
typedef struct splotchcl_particles splotchcl_particles;
typedef struct splotchcl_renderer splotchcl_renderer;

const char* splotchcl_version(void);

/* A scene file's text, or the file. */
splotchcl_scene* splotchcl_scene_from_text(const char* toml, splotchcl_error* error);
splotchcl_scene* splotchcl_scene_from_file(const char* path, splotchcl_error* error);
/* "key=value", as on the command line: "camera.position=[1,2,3]". On an error the scene stays
 * as it was. */
int splotchcl_scene_set(splotchcl_scene* scene, const char* key_and_value, splotchcl_error* error);
/* What a scene draws is one picture, or more of them (two eyes, six faces of a cube). */
size_t splotchcl_scene_picture_count(const splotchcl_scene* scene);
int splotchcl_scene_picture_size(const splotchcl_scene* scene, size_t picture, int* width,
                                 int* height, splotchcl_error* error);
/* Decides from these particles whatever the scene leaves to the data (camera, ranges,
 * brightness), and keeps it, so that the pictures of a film do not flicker. */
int splotchcl_scene_decide(splotchcl_scene* scene, const splotchcl_particles* particles,
                           splotchcl_error* error);
void splotchcl_scene_free(splotchcl_scene* scene);

/* Particles are the caller's arrays. */
splotchcl_particles* splotchcl_particles_new(void);
/* `type` is 0 gas, 1 halo, 2 disk, 3 bulge, 4 stars, 5 boundary; `field` is "position", "mass",
 * "density", "smoothing_length" or any other name that the scene asks for. Positions have 3
 * values per particle, x y z of one after those of another; other fields 1 or 3.
 * Floats are borrowed until they are replaced or the particles freed, and read anew for each
 * picture. Doubles are copied. */
int splotchcl_particles_set_floats(splotchcl_particles* particles, int type, const char* field,
                                   const float* values, uint64_t count, int values_per_particle,
                                   splotchcl_error* error);
int splotchcl_particles_set_doubles(splotchcl_particles* particles, int type, const char* field,
                                    const double* values, uint64_t count, int values_per_particle,
                                    splotchcl_error* error);
/* The same mass for all of a type. */
int splotchcl_particles_set_mass(splotchcl_particles* particles, int type, double mass,
                                 splotchcl_error* error);
/* Forgets a type's fields. Needed before its number of particles changes. */
void splotchcl_particles_clear(splotchcl_particles* particles, int type);
/* The side of a periodic box. */
void splotchcl_particles_set_box_size(splotchcl_particles* particles, double size);
void splotchcl_particles_free(splotchcl_particles* particles);

/* `device` is a part of an OpenCL device's name; null: a GPU, else the processor. Keeps compiled
 * kernels and buffers from picture to picture. */
splotchcl_renderer* splotchcl_renderer_new(const char* device, splotchcl_error* error);
/* Lines about the last pictures that their user should know; valid until the next are drawn. */
const char* splotchcl_renderer_notes(const splotchcl_renderer* renderer);
void splotchcl_renderer_free(splotchcl_renderer* renderer);

/* Draws every picture of the scene. images[i] takes 4 * width * height floats of picture i: rows
 * from the top, red, green, blue (linear light, 1 is white) and alpha. `count` is the number of
 * images. */
int splotchcl_draw(splotchcl_renderer* renderer, const splotchcl_scene* scene,
                   const splotchcl_particles* particles, float* const* images, size_t count,
                   splotchcl_error* error);

/* Stores a picture; the path's ending chooses the format, and formats of 8 bits hold
 * value^(1/gamma). */
int splotchcl_write_image(const char* path, const float* rgba, int width, int height, double gamma,
                          splotchcl_error* error);

#ifdef __cplusplus
}
#endif

#endif
