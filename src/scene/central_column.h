#pragma once

#include "scene/particle_rules.h"
