#include "film/path_plot/path_plot.h"

#include <algorithm>
#include <array>
#include <boost/qvm/operations.hpp>
#include <boost/qvm/vec_operations.hpp>
#include <cmath>
#include <cstddef>

#include "film/path_plot/plot_panel.h"
#include "scene/statistics.h"

namespace splotchcl {
namespace {

constexpr int side = 800;  // of a panel, in pixels
constexpr int left_margin = 90, top_margin = 24, bottom_margin = 86;
constexpr std::size_t dense_cells_shown = 8;
constexpr std::size_t frames_with_view = 8;
constexpr std::size_t dots = 60;

constexpr Light particle_light = {0.55F, 0.65F, 0.8F};
constexpr Light outline_light = {0.3F, 0.36F, 0.45F};
constexpr Light object_light = {0.95F, 0.75F, 0.3F};
constexpr Light look_light = {0.9F, 0.9F, 0.9F};
constexpr Light sky_light = {0.35F, 0.9F, 0.4F};
constexpr Light right_light = {1.0F, 0.6F, 0.25F};
constexpr Light view_light = {0.5F, 0.5F, 0.55F};
constexpr Light eye_light = {0.95F, 0.4F, 0.95F};

// From blue at the first frame to red at the last.
Light time_light(double t) {
  const auto f = static_cast<float>(t);
  return {0.25F + 0.75F * f, 0.45F - 0.15F * f, 1 - 0.8F * f};
}

double part_of(std::size_t frame, std::size_t count) {
  return count > 1 ? static_cast<double>(frame) / static_cast<double>(count - 1) : 0;
}

// A choice of frames, with the first and the last among them.
std::vector<std::size_t> some_frames(std::size_t count, std::size_t wanted) {
  std::vector<std::size_t> frames;
  if (count <= wanted) wanted = count;
  for (std::size_t i = 0; i < wanted; ++i) {
    const double part = wanted > 1 ? static_cast<double>(i) / static_cast<double>(wanted - 1) : 0;
    frames.push_back(static_cast<std::size_t>(std::lround(part * static_cast<double>(count - 1))));
  }
  return frames;
}

struct Bounds {
  std::array<ValueRange, 3> axes;
  Vec3 center() const {
    Vec3 middle;
    for (std::size_t axis = 0; axis < 3; ++axis)
      middle.a[axis] = 0.5 * (axes[axis].minimum + axes[axis].maximum);
    return middle;
  }
  double size() const {
    double largest = 0;
    for (const ValueRange& range : axes)
      largest = std::max(largest, range.maximum - range.minimum);
    return largest;
  }
  void include(const Vec3& point) {
    for (std::size_t axis = 0; axis < 3; ++axis) {
      axes[axis].minimum = std::min(axes[axis].minimum, point.a[axis]);
      axes[axis].maximum = std::max(axes[axis].maximum, point.a[axis]);
    }
  }
};

// A header may name a box that has nothing to do with the particles.
bool fill_box(const Bounds& bulk, const BoxSides& box) {
  for (std::size_t axis = 0; axis < 3; ++axis) {
    const ValueRange& range = bulk.axes[axis];
    if (range.minimum < 0 || range.maximum > box[axis]) return false;
    if (range.maximum - range.minimum <= 0.7 * box[axis]) return false;
  }
  return true;
}

// The periodic box, or the bulk of the particles.
Bounds outline_of(const PathPlot& plot) {
  Bounds bounds;
  for (std::size_t axis = 0; axis < 3; ++axis) {
    if (plot.particles.empty()) {
      const double at = plot.look_at.front().a[axis];
      bounds.axes[axis] = {at, at};
      continue;
    }
    std::vector<double> values;
    for (const Vec3& particle : plot.particles)
      values.push_back(particle.a[axis]);
    bounds.axes[axis].minimum = percentile(values, 0.01);
    bounds.axes[axis].maximum = percentile(values, 0.99);
  }
  if (plot.box_size && fill_box(bounds, *plot.box_size)) {
    for (std::size_t axis = 0; axis < 3; ++axis)
      bounds.axes[axis] = {0, (*plot.box_size)[axis]};
  }
  return bounds;
}

void draw_particles(PlotPanel& panel, const PathPlot& plot) {
  std::vector<std::size_t> counts(static_cast<std::size_t>(side) * side);
  const PlotPoint origin = panel.corner();
  const auto cell = [&](const PlotPoint& p) -> std::size_t* {
    const double x = p.x - origin.x, y = p.y - origin.y;
    if (!(x >= 0 && x < side && y >= 0 && y < side)) return nullptr;
    return &counts[static_cast<std::size_t>(y) * side + static_cast<std::size_t>(x)];
  };
  std::size_t largest = 1;
  for (const Vec3& particle : plot.particles) {
    if (std::size_t* const count = cell(panel.place(particle)))
      largest = std::max(largest, ++*count);
  }
  // As many particles as a pixel may hold span powers of ten; the plot's lines must stay visible.
  constexpr double faintest = 0.2, brightest = 0.9;
  for (std::size_t i = 0; i < static_cast<std::size_t>(side) * side; ++i) {
    if (counts[i] == 0) continue;
    const double share =
        std::log1p(static_cast<double>(counts[i])) / std::log1p(static_cast<double>(largest));
    const auto factor = static_cast<float>(faintest + (brightest - faintest) * share);
    const PlotPoint at = {origin.x + static_cast<double>(i % side) + 0.5,
                          origin.y + static_cast<double>(i / side) + 0.5};
    panel.add_light(
        at, {factor * particle_light[0], factor * particle_light[1], factor * particle_light[2]});
  }
}

void draw_outline(PlotPanel& panel, const Bounds& bounds) {
  const Vec3 low = {{bounds.axes[0].minimum, bounds.axes[1].minimum, bounds.axes[2].minimum}};
  const Vec3 high = {{bounds.axes[0].maximum, bounds.axes[1].maximum, bounds.axes[2].maximum}};
  const PlotPoint a = panel.place(low), b = panel.place(high);
  panel.line(a, {b.x, a.y}, 1.5, outline_light);
  panel.line({b.x, a.y}, b, 1.5, outline_light);
  panel.line(b, {a.x, b.y}, 1.5, outline_light);
  panel.line({a.x, b.y}, a, 1.5, outline_light);
}

void draw_objects(PlotPanel& panel, const std::vector<DenseCell>& objects, const Font& font) {
  for (std::size_t i = 0; i < objects.size(); ++i) {
    const PlotPoint at = panel.place(objects[i].center);
    const double radius = std::max(6.0, 0.7 * objects[i].size * panel.pixels_per_length());
    panel.ring(at, radius, 1.5, object_light);
    panel.label({at.x + 0.7 * radius, at.y - 0.4 * radius}, std::to_string(i + 1), font, 14,
                object_light);
  }
}

// What a camera sees: the edges of its view, seen in this projection.
void draw_view(PlotPanel& panel, const PathPlot& plot, std::size_t frame, double length) {
  const CameraFrame& camera = plot.cameras[frame];
  const PlotPoint eye = panel.place(camera.position);
  const double angle = std::min(plot.half_angles[frame], 1.3);
  for (const double sign : {-1.0, 1.0}) {
    const Vec3 edge = camera.position + length * (std::cos(angle) * camera.forward +
                                                  sign * std::sin(angle) * camera.right);
    panel.line(eye, panel.place(edge), 1.5, view_light);
  }
  panel.line(eye, panel.place(plot.look_at[frame]), 1, look_light, 0.35F);
  const Vec3 sky = boost::qvm::normalized(plot.sky[frame]);
  panel.arrow(eye, panel.place(camera.position + 0.5 * length * sky), 1.8, sky_light);
  panel.arrow(eye, panel.place(camera.position + 0.5 * length * camera.right), 1.8, right_light);
  if (plot.second_eyes.empty()) return;
  const SecondEye& other = plot.second_eyes[frame];
  for (const Vec3& edge : {other.left, other.right})
    panel.line(panel.place(other.position), panel.place(other.position + length * edge), 1.5,
               eye_light, 0.8F);
}

void draw_camera(PlotPanel& panel, const PathPlot& plot, double length, const Font& font) {
  const std::size_t count = plot.cameras.size();
  for (std::size_t i = 0; i + 1 < count; ++i) {
    panel.line(panel.place(plot.look_at[i]), panel.place(plot.look_at[i + 1]), 1.2, look_light,
               0.6F);
    panel.line(panel.place(plot.cameras[i].position), panel.place(plot.cameras[i + 1].position), 2,
               time_light(part_of(i, count)));
  }
  for (const std::size_t i : some_frames(count, frames_with_view))
    draw_view(panel, plot, i, length);
  for (const std::size_t i : some_frames(count, dots)) {
    const PlotPoint eye = panel.place(plot.cameras[i].position);
    if (!plot.second_eyes.empty()) {
      const PlotPoint other = panel.place(plot.second_eyes[i].position);
      panel.line(eye, other, 1, eye_light, 0.7F);
      panel.ring(other, 4, 1.5, eye_light);
    }
    panel.disc(eye, 3.5, time_light(part_of(i, count)));
    const PlotPoint look = panel.place(plot.look_at[i]);
    panel.line({look.x - 4, look.y - 4}, {look.x + 4, look.y + 4}, 1.5, look_light);
    panel.line({look.x - 4, look.y + 4}, {look.x + 4, look.y - 4}, 1.5, look_light);
  }
  const std::size_t last = count - 1;
  panel.label(panel.place(plot.cameras[0].position), "0", font, 16, time_light(0));
  if (last > 0) {
    panel.label(panel.place(plot.cameras[last].position), std::to_string(last), font, 16,
                time_light(1));
  }
}

void draw_legend(Image& image, const PathPlot& plot, const Font& font) {
  Canvas canvas(image, {0, 0, image.width, image.height});
  struct Entry {
    std::string text;
    Light light;
  };
  std::vector<Entry> entries = {{"camera, first frame", time_light(0)},
                                {"camera, last frame", time_light(1)},
                                {"look-at point", look_light},
                                {"sky", sky_light},
                                {"right", right_light},
                                {"view", view_light},
                                {"densest places", object_light}};
  if (!plot.second_eyes.empty()) entries.push_back({"second eye and its view", eye_light});
  double x = left_margin;
  const double y = image.height - 30.0;
  for (const Entry& entry : entries) {
    canvas.fill({x, y + 2, x + 26, y + 8}, entry.light);
    const TextMask mask = font.draw(entry.text, 17);
    canvas.stamp(mask, static_cast<int>(x + 34) + mask.left,
                 static_cast<int>(y + 5 - 0.5 * mask.box_height) + mask.top, text_light);
    x += 34 + mask.box_width + 34;
  }
}

}  // namespace

Image draw_path_plot(const PathPlot& plot) {
  const Font font("DejaVuSans");
  Image image(2 * (left_margin + side) + 30, top_margin + side + bottom_margin);
  for (std::size_t i = 0; i < image.pixels.size(); ++i)
    image.pixels[i] = i % 4 == 3 ? 1.0F : 0.03F;
  const Bounds outline = outline_of(plot);
  Bounds shown = outline;
  for (std::size_t i = 0; i < plot.cameras.size(); ++i) {
    shown.include(plot.cameras[i].position);
    shown.include(plot.look_at[i]);
  }
  for (const SecondEye& eye : plot.second_eyes)
    shown.include(eye.position);
  const double size = shown.size() > 0 ? 1.16 * shown.size() : 1;
  const std::vector<DenseCell> objects = densest_cells(plot.particles, dense_cells_shown);
  for (std::size_t vertical = 1; vertical < 3; ++vertical) {
    const int x = left_margin + static_cast<int>(vertical - 1) * (left_margin + side);
    PlotPanel panel(image, {x, top_margin, side, side}, 0, vertical, shown.center(), side / size);
    draw_particles(panel, plot);
    draw_outline(panel, outline);
    draw_objects(panel, objects, font);
    draw_camera(panel, plot, 0.12 * size, font);
    panel.axes(font);
  }
  draw_legend(image, plot, font);
  return image;
}

namespace {

constexpr int cells = 24;   // a side
constexpr int around = 27;  // a cell and its neighbours
constexpr int itself = 13;  // of those the middle one

// Of the densest cell's particles. Wherever there are a few, chance makes peaks of them; groups of
// a hundredth of a cluster's mass are still worth a circle.
constexpr double least_part = 0.01;

using Cell = std::array<int, 3>;

Cell neighbor(const Cell& cell, int n) {
  return {cell[0] + n % 3 - 1, cell[1] + n / 3 % 3 - 1, cell[2] + n / 9 - 1};
}

// The cube that holds the bulk of the particles, how many of them its cells hold, and where.
class Grid {
 public:
  explicit Grid(const std::vector<Vec3>& particles)
      : counts_(cells * cells * cells), sums_(counts_.size(), Vec3{{0, 0, 0}}) {
    double side = 0;
    for (std::size_t axis = 0; axis < 3; ++axis) {
      std::vector<double> values;
      for (const Vec3& particle : particles)
        values.push_back(particle.a[axis]);
      const double low = percentile(values, 0.005), high = percentile(values, 0.995);
      corner_.a[axis] = 0.5 * (low + high);
      side = std::max(side, high - low);
    }
    size_ = side > 0 ? side / cells : 1;
    for (double& edge : corner_.a)
      edge -= 0.5 * cells * size_;
    for (const Vec3& particle : particles)
      add(particle);
  }

  std::size_t count(const Cell& cell) const { return is_inside(cell) ? counts_[index(cell)] : 0; }
  // Ties go to the first cell, so that there is one maximum of equal neighbours.
  bool is_peak(const Cell& cell) const {
    const std::size_t here = count(cell);
    if (here == 0) return false;
    for (int n = 0; n < around; ++n) {
      const std::size_t there = count(neighbor(cell, n));
      if (there > here || (there == here && n < itself)) return false;
    }
    return true;
  }
  // Edges of cells cut through crowds: the middle of one is where its particles are in the mean.
  DenseCell around_peak(const Cell& peak) const {
    using namespace boost::qvm;
    Vec3 sum = {{0, 0, 0}};
    std::size_t particles = 0;
    for (int n = 0; n < around; ++n) {
      const Cell cell = neighbor(peak, n);
      if (!is_inside(cell)) continue;
      sum += sums_[index(cell)];
      particles += counts_[index(cell)];
    }
    return {corner_ + sum / static_cast<double>(particles), size_};
  }

 private:
  static bool is_inside(const Cell& cell) {
    return std::all_of(cell.begin(), cell.end(), [](int i) { return i >= 0 && i < cells; });
  }
  static std::size_t index(const Cell& cell) {
    return static_cast<std::size_t>((cell[2] * cells + cell[1]) * cells + cell[0]);
  }
  void add(const Vec3& particle) {
    using namespace boost::qvm;
    Cell cell;
    for (std::size_t axis = 0; axis < 3; ++axis) {
      const double place = std::floor((particle.a[axis] - corner_.a[axis]) / size_);
      if (!(place >= 0 && place < cells)) return;
      cell[axis] = static_cast<int>(place);
    }
    ++counts_[index(cell)];
    sums_[index(cell)] += particle - corner_;
  }

  Vec3 corner_ = {{0, 0, 0}};
  double size_ = 1;
  std::vector<std::size_t> counts_;
  std::vector<Vec3> sums_;  // of places from the corner
};

}  // namespace

std::vector<DenseCell> densest_cells(const std::vector<Vec3>& particles, std::size_t limit) {
  if (particles.empty()) return {};
  const Grid grid(particles);
  std::vector<Cell> peaks;
  for (int i = 0; i < cells * cells * cells; ++i) {
    const Cell cell = {i % cells, i / cells % cells, i / cells / cells};
    if (grid.is_peak(cell)) peaks.push_back(cell);
  }
  std::stable_sort(peaks.begin(), peaks.end(),
                   [&grid](const auto& a, const auto& b) { return grid.count(a) > grid.count(b); });
  std::vector<DenseCell> result;
  for (std::size_t i = 0; i < std::min(limit, peaks.size()); ++i) {
    const auto count = static_cast<double>(grid.count(peaks[i]));
    if (count < least_part * static_cast<double>(grid.count(peaks[0]))) break;
    result.push_back(grid.around_peak(peaks[i]));
  }
  return result;
}

}  // namespace splotchcl
