#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <vector>

#include "scene/projection.h"
#include "splotchcl/frame.h"
#include "tree/error_cells.h"
#include "tree/tree_parts.h"

namespace splotchcl {

enum class NodeFate : std::uint8_t { unseen, open, weighed };

// What a node would err by if it were drawn, and where. Unset at first, as there are many.
struct WeighedNode {
  float error2;    // squared, added up over pixels
  float largest2;  // squared, in one pixel
  float light;
  std::uint32_t cell;  // of its scale
  std::uint8_t scale;
  NodeFate fate;
  std::uint8_t children;
  bool is_beside;  // the picture, and counts in the nearest cell
  std::array<float, 3> color;
};

// Looks at nodes as a frame shows them.
class NodeWeigher {
 public:
  // Only what may be seen in the regions counts, or what lies in them. Nodes across the faces of a
  // periodic box are opened, or lie where their centroid does. All have to stay.
  NodeWeigher(const Frame& frame, const std::vector<Rectangle>& regions, const ErrorCells& cells,
              bool has_to_lie_there, bool opens_across_faces)
      : frame_(frame),
        regions_(regions),
        cells_(cells),
        has_to_lie_there_(has_to_lie_there),
        opens_across_faces_(opens_across_faces) {}

  WeighedNode weigh(const TreePart& part, const TreeItem& item, std::size_t level) const;

 private:
  bool is_near(const Vec3& from, double reach, double widest) const;
  bool is_behind(const Vec3& from, double reach) const;
  bool is_at_limit(double depth, double reach) const;
  bool is_beyond_limits(double depth) const;
  std::optional<double> limit_before() const;
  bool is_unseen(const Projected& at, double reach, double widest) const;
  bool is_along_cells(const TreePart& part, const Vec3& offset, double pixels_per_length,
                      double reach) const;
  void weigh_error(const TreePart& part, const TreeItem& item, std::size_t level,
                   const Projected& at, WeighedNode& weighed) const;

  const Frame& frame_;
  const std::vector<Rectangle>& regions_;
  const ErrorCells& cells_;
  bool has_to_lie_there_, opens_across_faces_;
};

}  // namespace splotchcl
