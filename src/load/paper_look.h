#pragma once

#include "splotchcl/scene.h"

namespace splotchcl {

// From a scene in Look::press, before its light is finished: matter is ink, which gives off no
// light and absorbs that of white paper.
void change_to_paper(Scene& scene);

}  // namespace splotchcl
