#include <algorithm>
#include <cmath>
#include <cstdio>
#include <exception>
#include <iterator>
#include <memory>
#include <new>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "ranks/exchange.h"
#include "scene/constants.h"
#include "splotchcl/array_snapshot.h"
#include "splotchcl/communicator.h"
#include "splotchcl/error.h"
#include "splotchcl/frame_drawer.h"
#include "splotchcl/image_file.h"
#include "splotchcl/load.h"
#include "splotchcl/picture.h"
#include "splotchcl/scene_file.h"
#include "splotchcl/splotchcl_c.h"
#include "splotchcl/spread_snapshot.h"

struct splotchcl_scene {
  splotchcl::Scene scene;
};

struct splotchcl_ranks {
  std::shared_ptr<splotchcl::Communicator> communicator;
};

struct splotchcl_particles {
  splotchcl::ArraySnapshot arrays;
  // Of the ranks that they were last drawn with.
  mutable std::optional<splotchcl::SpreadSnapshot> of_all_ranks;
  mutable std::shared_ptr<splotchcl::Communicator> ranks;
};

struct splotchcl_renderer {
  splotchcl::FrameDrawer drawer;
  std::shared_ptr<splotchcl::Communicator> ranks;  // null: one process
  std::string notes;
};

namespace {

constexpr int done = 0, failed = 1, called_wrong = 2;

// What a compiler says has several lines.
int report(splotchcl_error* error, int code, const char* message) {
  if (error == nullptr) return code;
  error->code = code;
  std::snprintf(error->message, sizeof error->message, "%s", message);
  std::replace(std::begin(error->message), std::end(error->message), '\n', ' ');
  return code;
}

// Runs `work`; what it throws becomes a code and a message: nothing is thrown into C.
template <typename Work>
int guarded(splotchcl_error* error, Work&& work) noexcept {
  try {
    work();
    return report(error, done, "");
  } catch (const splotchcl::FailedElsewhere& elsewhere) {
    return report(error, elsewhere.is_usage() ? called_wrong : failed, "");
  } catch (const splotchcl::UsageError& failure) {
    return report(error, called_wrong, failure.what());
  } catch (const std::bad_alloc&) {
    return report(error, failed, "out of memory; fewer particles or a smaller picture need less");
  } catch (const std::exception& failure) {
    return report(error, failed, failure.what());
  } catch (...) {
    return report(error, failed, "an unknown failure; please report it");
  }
}

template <typename Object, typename Make>
Object* made(splotchcl_error* error, Make&& make) noexcept {
  std::unique_ptr<Object> object;
  guarded(error, [&] { object = make(); });
  return object.release();
}

template <typename Pointer>
Pointer require(Pointer pointer, const char* what) {
  if (pointer != nullptr) return pointer;
  throw splotchcl::UsageError(std::string(what) + " is a null pointer");
}

// The arrays as they are now: what an earlier picture found from them may be out of date.
const splotchcl::ArraySnapshot& arrays_now(const splotchcl_particles* particles) {
  const splotchcl::ArraySnapshot& arrays = require(particles, "the particles")->arrays;
  arrays.changed();
  return arrays;
}

// Those of all ranks. Collective; without ranks those of this process.
const splotchcl::Snapshot& arrays_of_all(const splotchcl_particles* particles,
                                         const std::shared_ptr<splotchcl::Communicator>& ranks) {
  if (!ranks) return arrays_now(particles);
  if (particles->ranks == ranks && particles->of_all_ranks) {
    particles->of_all_ranks->changed();
  } else {
    particles->of_all_ranks.reset();
    particles->of_all_ranks.emplace(particles->arrays, ranks);
    particles->ranks = ranks;
  }
  return *particles->of_all_ranks;
}

std::vector<splotchcl::PictureSize> sizes_of(const splotchcl_scene* scene) {
  const splotchcl::ImageSettings& image = require(scene, "the scene")->scene.image;
  return splotchcl::picture_sizes(scene->scene, image.width, image.height);
}

// Memory of the caller's for every picture.
void check_images(const std::vector<splotchcl::PictureSize>& sizes, float* const* images,
                  const std::size_t* capacities, std::size_t count) {
  if (count != sizes.size()) {
    throw splotchcl::UsageError("memory for " + std::to_string(count) +
                                " images, but the scene has " + std::to_string(sizes.size()) +
                                " pictures; see splotchcl_scene_picture_count");
  }
  require(images, "the array of images");
  require(capacities, "the array of capacities");
  for (std::size_t i = 0; i < count; ++i) {
    require(images[i], "an image");
    const std::size_t needed =
        4 * static_cast<std::size_t>(sizes[i].width) * static_cast<std::size_t>(sizes[i].height);
    if (capacities[i] >= needed) continue;
    throw splotchcl::UsageError(
        "image " + std::to_string(i) + " has room for " + std::to_string(capacities[i]) +
        " floats, expected " + std::to_string(needed) + " for " + std::to_string(sizes[i].width) +
        "x" + std::to_string(sizes[i].height) + " pixels; see splotchcl_scene_picture_size");
  }
}

// A scene whose particles are the caller's needs no file of them.
const char* const no_snapshot = "snapshot=\"arrays\"";

}  // namespace

const char* splotchcl_version(void) {
  return SPLOTCHCL_VERSION;
}

splotchcl_scene* splotchcl_scene_from_text(const char* toml, splotchcl_error* error) {
  return made<splotchcl_scene>(error, [&] {
    return std::make_unique<splotchcl_scene>(splotchcl_scene{
        splotchcl::parse_scene(require(toml, "the scene's text"), "scene", {no_snapshot})});
  });
}

splotchcl_scene* splotchcl_scene_from_file(const char* path, splotchcl_error* error) {
  return made<splotchcl_scene>(error, [&] {
    return std::make_unique<splotchcl_scene>(splotchcl_scene{
        splotchcl::read_scene_file(require(path, "the scene's path"), {no_snapshot})});
  });
}

int splotchcl_scene_set(splotchcl_scene* scene, const char* key_and_value, splotchcl_error* error) {
  return guarded(error, [&] {
    splotchcl::Scene& changed = require(scene, "the scene")->scene;
    changed = splotchcl::apply_settings(changed, {require(key_and_value, "the setting")});
  });
}

size_t splotchcl_scene_picture_count(const splotchcl_scene* scene) {
  std::size_t count = 0;
  guarded(nullptr, [&] { count = sizes_of(scene).size(); });
  return count;
}

int splotchcl_scene_picture_size(const splotchcl_scene* scene, size_t picture, int* width,
                                 int* height, splotchcl_error* error) {
  return guarded(error, [&] {
    const auto sizes = sizes_of(scene);
    require(width, "the width");
    require(height, "the height");
    if (picture >= sizes.size()) {
      throw splotchcl::UsageError("picture " + std::to_string(picture) + " of a scene that has " +
                                  std::to_string(sizes.size()) + ", counted from 0");
    }
    *width = sizes[picture].width;
    *height = sizes[picture].height;
  });
}

int splotchcl_scene_decide(splotchcl_scene* scene, const splotchcl_particles* particles,
                           splotchcl_error* error) {
  return guarded(error, [&] {
    std::vector<std::string> notes;
    scene->scene = splotchcl::fixed_scene(
        splotchcl::decide(require(scene, "the scene")->scene, arrays_now(particles), notes));
  });
}

int splotchcl_scene_decide_for_ranks(splotchcl_scene* scene, const splotchcl_particles* particles,
                                     splotchcl_ranks* ranks, splotchcl_error* error) {
  return guarded(error, [&] {
    const auto& communicator = require(ranks, "the object of ranks")->communicator;
    splotchcl::agree(communicator.get(), [&] {
      require(scene, "the scene");
      require(particles, "the particles");
    });
    std::vector<std::string> notes;
    scene->scene = splotchcl::fixed_scene(
        splotchcl::decide(scene->scene, arrays_of_all(particles, communicator), notes));
  });
}

void splotchcl_scene_free(splotchcl_scene* scene) {
  delete scene;
}

splotchcl_particles* splotchcl_particles_new(void) {
  return made<splotchcl_particles>(nullptr, [] { return std::make_unique<splotchcl_particles>(); });
}

int splotchcl_particles_set_floats(splotchcl_particles* particles, int type, const char* field,
                                   const float* values, uint64_t count, int values_per_particle,
                                   splotchcl_error* error) {
  return guarded(error, [&] {
    require(particles, "the particles")
        ->arrays.set_field(type, require(field, "the field's name"), values, count,
                           values_per_particle);
  });
}

int splotchcl_particles_set_doubles(splotchcl_particles* particles, int type, const char* field,
                                    const double* values, uint64_t count, int values_per_particle,
                                    splotchcl_error* error) {
  return guarded(error, [&] {
    require(particles, "the particles")
        ->arrays.set_field(type, require(field, "the field's name"), values, count,
                           values_per_particle);
  });
}

int splotchcl_particles_set_integers(splotchcl_particles* particles, int type, const char* field,
                                     const int64_t* values, uint64_t count,
                                     splotchcl_error* error) {
  return guarded(error, [&] {
    require(particles, "the particles")
        ->arrays.set_field(type, require(field, "the field's name"), values, count);
  });
}

int splotchcl_particles_set_mass(splotchcl_particles* particles, int type, double mass,
                                 splotchcl_error* error) {
  return guarded(error, [&] { require(particles, "the particles")->arrays.set_mass(type, mass); });
}

int splotchcl_particles_clear(splotchcl_particles* particles, int type, splotchcl_error* error) {
  return guarded(error, [&] { require(particles, "the particles")->arrays.clear(type); });
}

int splotchcl_particles_set_box_size(splotchcl_particles* particles, double size,
                                     splotchcl_error* error) {
  return guarded(error, [&] { require(particles, "the particles")->arrays.set_box_size(size); });
}

void splotchcl_particles_free(splotchcl_particles* particles) {
  delete particles;
}

splotchcl_renderer* splotchcl_renderer_new(const char* device, splotchcl_error* error) {
  return made<splotchcl_renderer>(error, [&] {
    splotchcl::FrameDrawerOptions options;
    if (device != nullptr) options.device = device;
    return std::unique_ptr<splotchcl_renderer>(
        new splotchcl_renderer{splotchcl::FrameDrawer(options), nullptr, ""});
  });
}

splotchcl_renderer* splotchcl_renderer_new_for_ranks(const char* device, splotchcl_ranks* ranks,
                                                     splotchcl_error* error) {
  return made<splotchcl_renderer>(error, [&] {
    splotchcl::FrameDrawerOptions options;
    options.ranks = require(ranks, "the object of ranks")->communicator;
    if (device != nullptr) options.device = device;
    return std::unique_ptr<splotchcl_renderer>(
        new splotchcl_renderer{splotchcl::FrameDrawer(options), options.ranks, ""});
  });
}

splotchcl_ranks* splotchcl_ranks_new(const char* mpi, const void* communicator,
                                     splotchcl_error* error) {
  return made<splotchcl_ranks>(error, [&] {
    return std::unique_ptr<splotchcl_ranks>(new splotchcl_ranks{
        splotchcl::ranks_of_mpi(require(mpi, "the name of the MPI"), communicator)});
  });
}

void splotchcl_ranks_free(splotchcl_ranks* ranks) {
  delete ranks;
}

const char* splotchcl_renderer_notes(const splotchcl_renderer* renderer) {
  return renderer == nullptr ? "" : renderer->notes.c_str();
}

void splotchcl_renderer_free(splotchcl_renderer* renderer) {
  delete renderer;
}

int splotchcl_draw(splotchcl_renderer* renderer, const splotchcl_scene* scene,
                   const splotchcl_particles* particles, float* const* images,
                   const size_t* capacities, size_t count, splotchcl_error* error) {
  return guarded(error, [&] {
    const auto& ranks = require(renderer, "the renderer")->ranks;
    splotchcl::agree(ranks.get(), [&] {
      const std::vector<splotchcl::PictureSize> sizes = sizes_of(scene);
      require(particles, "the particles");
      if (!ranks || count > 0) check_images(sizes, images, capacities, count);
    });
    const splotchcl::DrawnFrame drawn =
        renderer->drawer.draw(scene->scene, arrays_of_all(particles, ranks));
    std::string notes;
    for (const std::string& note : drawn.all_notes())
      notes += note + "\n";
    renderer->notes = std::move(notes);
    for (std::size_t i = 0; i < count; ++i) {
      const std::vector<float>& pixels = drawn.pictures.at(i).image.pixels;
      std::copy(pixels.begin(), pixels.end(), images[i]);
    }
  });
}

int splotchcl_write_image(const char* path, const float* rgba, int width, int height, double gamma,
                          splotchcl_error* error) {
  return guarded(error, [&] {
    require(path, "the path");
    require(rgba, "the image");
    if (width < 1 || height < 1 || width > splotchcl::largest_side ||
        height > splotchcl::largest_side) {
      throw splotchcl::UsageError("an image of " + std::to_string(width) + "x" +
                                  std::to_string(height) + " pixels, expected sides from 1 to " +
                                  std::to_string(splotchcl::largest_side));
    }
    if (!std::isfinite(gamma) || !(gamma > 0)) {
      throw splotchcl::UsageError("a gamma of " + std::to_string(gamma) +
                                  ", expected a finite number > 0");
    }
    splotchcl::check_image_path(path);
    splotchcl::Image image(width, height);
    std::copy(rgba, rgba + image.pixels.size(), image.pixels.begin());
    splotchcl::ImageFileOptions options;
    options.gamma = gamma;
    options.dithers = true;
    splotchcl::write_image(path, image, options);
  });
}
