/* A program of before the C interface had a name of its own. */
#include "old_header_name.h"

#include <splotchcl/splotchcl.h>
#include <string.h>

int draws_with_the_old_header_name(const char* scene_text) {
  splotchcl_error error;
  splotchcl_scene* const scene = splotchcl_scene_from_text(scene_text, &error);
  int width = 0, height = 0;
  if (scene == NULL) return 0;
  if (splotchcl_scene_picture_size(scene, 0, &width, &height, &error) != 0) width = 0;
  splotchcl_scene_free(scene);
  return width > 0 && height > 0 && strlen(error.message) == 0;
}
