#ifndef SPLOTCHCL_SPLOTCHCL_C_H
#define SPLOTCHCL_SPLOTCHCL_C_H

/* Draws a simulation's own arrays, in its own process: the library call for C, and for every
 * language that can call C. C++ programs have more at hand in the other headers.
 *
 * A scene says what to draw and how, in the words of docs/scene.md; its key `snapshot` is not
 * needed, since particles come from memory. No function but splotchcl_scene_from_file and
 * splotchcl_write_image touches a file, unless the scene itself names one (a palette, a
 * background, another snapshot). A snapshot that it names is mapped: once another program makes
 * that file shorter, reading it raises SIGBUS. The library leaves signals to the program, which
 * ends by it unless it has a handler.
 *
 * Functions that can fail take a last argument `error`, which may be null; after a success its
 * code is 0 and its message empty. Those that return an int return 0, 1 (the data or the device
 * failed) or 2 (the call or the scene is wrong), those that return a pointer null. A null pointer
 * where something is needed is a wrong call, and so are values that cannot be: what can be seen to
 * be wrong is refused with code 2, and changes nothing. Nothing is kept behind the caller's back:
 * objects may be used from any thread, each from one at a time. Free functions take null.
 *
 * Texts are UTF-8 and end with a zero byte. Lengths, masses and other values are in whatever
 * units the caller's arrays have; the scene's camera is in the same unit of length.
 */

#include <stddef.h>
#include <stdint.h>

#ifdef __cplusplus
extern "C" {
#endif

/* What went wrong. */
typedef struct splotchcl_error {
  int code;           /* 0: no error; 1 and 2 as above */
  char message[1020]; /* one line: what was found, what was expected, what to do */
} splotchcl_error;

typedef struct splotchcl_scene splotchcl_scene;         /* what to draw and how */
typedef struct splotchcl_particles splotchcl_particles; /* the caller's arrays */
typedef struct splotchcl_renderer splotchcl_renderer;   /* a device */
typedef struct splotchcl_ranks splotchcl_ranks;         /* processes that draw together */

/* Of the library: "0.1.0". */
const char* splotchcl_version(void);

/* A scene from the text of a scene file. Null, with code 2, for text that is no scene: the message
 * has the line, the key and the nearest known one. Paths in it are relative to the current
 * folder. */
splotchcl_scene* splotchcl_scene_from_text(const char* toml, splotchcl_error* error);
/* A scene from a scene file; paths in it are relative to its folder. Code 1 for a file that
 * cannot be read. */
splotchcl_scene* splotchcl_scene_from_file(const char* path, splotchcl_error* error);
/* "key=value", as on the command line: "camera.position=[1,2,3]". On an error the scene stays
 * as it was. */
int splotchcl_scene_set(splotchcl_scene* scene, const char* key_and_value, splotchcl_error* error);
/* What a scene draws is one picture, or more of them (two eyes, six faces of a cube). 0 for
 * null. */
size_t splotchcl_scene_picture_count(const splotchcl_scene* scene);
/* The size in pixels of a picture, counted from 0. */
int splotchcl_scene_picture_size(const splotchcl_scene* scene, size_t picture, int* width,
                                 int* height, splotchcl_error* error);
/* Decides from these particles whatever the scene leaves to the data (camera, ranges,
 * brightness), and keeps it, so that the pictures of a film do not flicker. */
int splotchcl_scene_decide(splotchcl_scene* scene, const splotchcl_particles* particles,
                           splotchcl_error* error);
void splotchcl_scene_free(splotchcl_scene* scene);

/* No particles yet; null where there is no memory. */
splotchcl_particles* splotchcl_particles_new(void);
/* One field of `count` particles of one type.
 * `type` is 0 gas, 1 halo, 2 disk, 3 bulge, 4 stars, 5 boundary, or any other up to 31.
 * `field` is "position", "mass", "density", "smoothing_length" or any other name that the scene
 * asks for. `values` has values_per_particle * count numbers, all of one particle before those
 * of the next: 3 for each of positions (x y z), 1 or 3 of other fields.
 * Floats are borrowed until they are replaced or the particles freed, and read anew for each
 * picture. Doubles are copied, as floats. Integers, 1 for each, are copied: conditions and lists of
 * ids have them exact, all else as floats; those of "id" count as unsigned.
 * A type needs "position"; all fields of a type have the same count. A particle with a value
 * that is not finite, a smoothing length not above 0, or a weight below 0 is left out of
 * pictures. Code 2 for a type, a number of values or a count that cannot be, and for an array that
 * is not aligned. */
int splotchcl_particles_set_floats(splotchcl_particles* particles, int type, const char* field,
                                   const float* values, uint64_t count, int values_per_particle,
                                   splotchcl_error* error);
int splotchcl_particles_set_doubles(splotchcl_particles* particles, int type, const char* field,
                                    const double* values, uint64_t count, int values_per_particle,
                                    splotchcl_error* error);
int splotchcl_particles_set_integers(splotchcl_particles* particles, int type, const char* field,
                                     const int64_t* values, uint64_t count, splotchcl_error* error);
/* The same mass for all of a type, in place of a field "mass": a finite number >= 0. */
int splotchcl_particles_set_mass(splotchcl_particles* particles, int type, double mass,
                                 splotchcl_error* error);
/* Forgets a type's fields. Needed before its number of particles changes. */
int splotchcl_particles_clear(splotchcl_particles* particles, int type, splotchcl_error* error);
/* The side of a periodic box, in the unit of positions: a finite number > 0. 0: there is none. */
int splotchcl_particles_set_box_size(splotchcl_particles* particles, double size,
                                     splotchcl_error* error);
void splotchcl_particles_free(splotchcl_particles* particles);

/* `device` is a part of an OpenCL device's name, in any case of letters; null: a GPU, else the
 * processor. Keeps compiled kernels and buffers from picture to picture. Null, with code 1
 * where there is no device at all, with 2 where none has such a name. */
splotchcl_renderer* splotchcl_renderer_new(const char* device, splotchcl_error* error);
/* What the user should know of the last pictures, a line for each thing, "" for nothing; valid
 * until the next are drawn. */
const char* splotchcl_renderer_notes(const splotchcl_renderer* renderer);
void splotchcl_renderer_free(splotchcl_renderer* renderer);

/* Draws every picture of the scene. images[i] takes 4 * width * height floats of picture i (see
 * splotchcl_scene_picture_size): rows from the top, and for each pixel red, green, blue (linear
 * light, 1 is the display's white, more is kept) and alpha, the opacity from 0 to 1. capacities[i]
 * is the number of floats that images[i] has room for: less than the picture needs is refused, with
 * code 2, before anything is drawn. `count` is the number of images, which must be that of the
 * scene's pictures. On an error no image has been touched. */
int splotchcl_draw(splotchcl_renderer* renderer, const splotchcl_scene* scene,
                   const splotchcl_particles* particles, float* const* images,
                   const size_t* capacities, size_t count, splotchcl_error* error);

/* Stores a picture of 4 * width * height floats as splotchcl_draw makes it. The path's ending
 * chooses the format (png, exr, tif, jpg, ...): formats of 8 bits hold value^(1/gamma), exr and tif
 * linear light. Sides are from 1 to 65536, gamma is a finite number > 0. The file appears under its
 * name only when it is complete. Code 2 for an ending that is not known, 1 for a file that cannot
 * be written. */
int splotchcl_write_image(const char* path, const float* rgba, int width, int height, double gamma,
                          splotchcl_error* error);

/* Ranks: the processes of a simulation that uses MPI draw together, each with its own particles in
 * its own splotchcl_particles. For each type all particles together are those of rank 0, then those
 * of rank 1, and so on; the picture has the bits that one process draws from all arrays put
 * together. All ranks make the same calls, with the same scene. A type has the same fields, and the
 * same mass for all, on all ranks that have particles of it; those that have none need not set
 * them.
 *
 * Where a call fails on one rank it fails on all, with the same code: the first that failed has the
 * message, and that of all others is empty. What fails on one rank while all draw (its device, its
 * memory) ends all processes by MPI_Abort, with one line on standard error. */

/* The ranks of an MPI communicator: splotchcl_ranks_of in splotchcl_mpi.h calls this with the name
 * of the MPI ("openmpi", "mpich") and the address of the MPI_Comm. */
splotchcl_ranks* splotchcl_ranks_new(const char* mpi, const void* communicator,
                                     splotchcl_error* error);
/* After the renderers and particles that were used with them, before MPI_Finalize. */
void splotchcl_ranks_free(splotchcl_ranks* ranks);
/* As splotchcl_renderer_new. Collective. splotchcl_draw with this renderer is collective, too, and
 * draws the particles of all ranks. All of them have the pictures then; those that do not want
 * them, as all but rank 0, give 0 for `count`. */
splotchcl_renderer* splotchcl_renderer_new_for_ranks(const char* device, splotchcl_ranks* ranks,
                                                     splotchcl_error* error);
/* As splotchcl_scene_decide, from the particles of all ranks. Collective. */
int splotchcl_scene_decide_for_ranks(splotchcl_scene* scene, const splotchcl_particles* particles,
                                     splotchcl_ranks* ranks, splotchcl_error* error);

#ifdef __cplusplus
}
#endif

#endif
