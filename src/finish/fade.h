#pragma once

#include "splotchcl/finish.h"
#include "splotchcl/image.h"

namespace splotchcl {

// Both mix linear light and alpha, (1 - amount) of the picture and amount of the other.
void mix(Image& image, const Image& other, double amount);  // of the same size
void fade_to_color(Image& image, const FinishSettings& finish, double gamma);

}  // namespace splotchcl
