#pragma once

#include <vector>

#include "splotchcl/scene.h"
#include "splotchcl/snapshot.h"

namespace splotchcl {

// A component as Look::press has it, from what was suggested for its types: hue tells temperature,
// age or density, through palettes of nearly even lightness, and light the column of matter. Limits
// follow from the physics of a field where its unit is known, so that all snapshots of a run have
// the same colors. Few stars, which would be discs that reach from one to the next, are points.
Component in_press_look(Component component, const Snapshot& snapshot);

// Whether there is so much more dark matter than anything else that it shows what the rest lies in.
bool dark_matter_carries_picture(const SnapshotInfo& info);

// Glow, a curve that shows all light, and highlights that end in white.
void finish_for_press(FinishSettings& finish);

}  // namespace splotchcl
