#pragma once

#include <cstddef>
#include <type_traits>

// The structures that host and kernels share, byte for byte, in a namespace of their own.
// What a variant of the kernels adds to Splat and TileSplat is not seen here: Variant
// knows their sizes.
namespace splotchcl::shared {
#include "kernels/common/splat.h"
// The others use what stands there.
#include "kernels/bin/bin.h"
#include "kernels/certify/certify.h"
#include "kernels/composite/composite.h"
#include "kernels/interpolate/interpolate.h"
#include "kernels/project/project.h"
#include "kernels/resolve/resolve.h"
#include "kernels/scan/scan.h"
#include "kernels/sort/sort.h"

// Every member has 4 bytes, so no compiler has a reason to pad.
template <class Shared, std::size_t words>
constexpr bool has_words = sizeof(Shared) == 4 * words && alignof(Shared) == 4 &&
                           (std::is_trivially_copyable_v<Shared> &&
                            std::is_standard_layout_v<Shared>);

static_assert(has_words<FloatPair, 2>);
static_assert(has_words<Grid, 20>);
static_assert(has_words<GridBlurs, 11>);
static_assert(has_words<BlurWeights, 34>);
static_assert(has_words<BlurStripsParameters, 143>);
static_assert(has_words<Stencil, 98>);
static_assert(has_words<MemoryRange, 3>);
static_assert(has_words<WidthAlongX, 2>);
static_assert(has_words<Tilt, 4>);
static_assert(has_words<ExtendedTilt, 6>);
static_assert(has_words<CubeFace, 7>);
static_assert(has_words<OwnColor, 3>);
static_assert(has_words<Splat, 7>);
static_assert(has_words<ExtendedSplat, 20>);
static_assert(has_words<ComponentColors, 10>);
static_assert(has_words<DepthKeyParameters, 22>);
static_assert(has_words<ProjectLaunch, 17>);
static_assert(has_words<ProjectParameters<float>, 167>);
static_assert(has_words<BlockBox, 8>);
static_assert(has_words<BlockCounts, 4>);
static_assert(has_words<KeyBins, 2>);
static_assert(has_words<SharpParameters, 41>);
static_assert(has_words<InterpolateParameters, 10>);
static_assert(has_words<PathParameters, 32>);
static_assert(has_words<SortParameters, 4>);
static_assert(has_words<KeyBits, 2>);
static_assert(has_words<GroupSortParameters, 5>);
static_assert(has_words<KeyRange, 4>);
static_assert(has_words<ScanParameters, 2>);
static_assert(has_words<BinParameters, 26>);
static_assert(has_words<SplatTiles, 4>);
static_assert(has_words<GroupBinParameters, 27>);
static_assert(has_words<Segment, 4>);
static_assert(has_words<CompositeParameters, 16>);
static_assert(has_words<CloudEntry, 16>);
static_assert(has_words<CloudSplat, 7>);
static_assert(has_words<DirectionCone, 5>);
static_assert(has_words<BehindParameters, 4>);
static_assert(has_words<OctaveCells, 2>);
static_assert(has_words<CertifyParameters, 99>);
static_assert(has_words<BlurParameters, 72>);
static_assert(has_words<RefineParameters, 7 + REFINEMENT_TAPS>);
static_assert(has_words<ResolveParameters, 14>);
}  // namespace splotchcl::shared
