#include "original_drawing.h"

#include "testing.h"

namespace splotchcl::test {
namespace {

constexpr double pi = 3.14159265358979323846;

struct Vector {
  double x, y, z;
};
Vector minus(const double* a, const double* b) {
  return {a[0] - b[0], a[1] - b[1], a[2] - b[2]};
}
Vector cross(const Vector& a, const Vector& b) {
  return {a.y * b.z - a.z * b.y, a.z * b.x - a.x * b.z, a.x * b.y - a.y * b.x};
}
double dot(const Vector& a, const Vector& b) {
  return a.x * b.x + a.y * b.y + a.z * b.z;
}
Vector unit(const Vector& a) {
  const double length = std::sqrt(dot(a, a));
  return {a.x / length, a.y / length, a.z / length};
}

double palette_at(const std::vector<double>& knots, double place, std::size_t channel) {
  const std::size_t last = knots.size() / 3 - 1;
  const double at = place * static_cast<double>(last);
  const std::size_t below = std::min(static_cast<std::size_t>(at), last);
  const std::size_t above = std::min(below + 1, last);
  const double part = at - static_cast<double>(below);
  return ((1 - part) * knots[3 * below + channel] + part * knots[3 * above + channel]) / 255;
}

}  // namespace

std::vector<std::uint8_t> draw_as_original(const OriginalPicture& p,
                                           std::vector<OriginalParticle> particles) {
  const Vector view = minus(p.lookat, p.camera);
  const Vector forward = unit(view);
  const Vector sky = {p.sky[0], p.sky[1], p.sky[2]};
  const Vector right = unit(cross(forward, sky));
  const Vector up = cross(right, forward);
  const double lookat_distance = std::sqrt(dot(view, view));
  const auto depth = [&](const OriginalParticle& particle) {
    const double at[3] = {particle.x, particle.y, particle.z};
    return dot(minus(at, p.camera), forward);
  };
  // Far to near.
  std::stable_sort(
      particles.begin(), particles.end(),
      [&](const OriginalParticle& a, const OriginalParticle& b) { return depth(a) > depth(b); });
  const auto pixels = static_cast<std::size_t>(p.xres) * static_cast<std::size_t>(p.yres);
  std::vector<double> sum(3 * pixels, 0.0);
  for (const OriginalParticle& particle : particles) {
    const double z = depth(particle);
    if (z <= 0) continue;
    const double at[3] = {particle.x, particle.y, particle.z};
    const Vector d = minus(at, p.camera);
    const double scale =
        0.5 * p.xres / std::tan(0.5 * p.fov * pi / 180) / (p.is_flat ? lookat_distance : z);
    const double r = 2 * particle.h * scale * p.size_fac * p.smooth_factor;
    const double drawn = std::sqrt(r * r + p.minrad_pix * p.minrad_pix);
    const double sigma = 0.5 * std::pow(pi, -1.0 / 6) * drawn;
    const double end = 0.75 * drawn;
    double intensity = particle.intensity;
    intensity *= 0.5 * 0.5 * std::pow(pi, -5.0 / 6) / (particle.h * p.size_fac);
    intensity /= drawn / r;
    const double x = 0.5 * p.xres + scale * dot(d, right);
    const double y = 0.5 * p.yres + scale * dot(d, up);
    for (int row = 0; row < p.yres; ++row) {
      for (int column = 0; column < p.xres; ++column) {
        const double squared = std::pow(column - x, 2) + std::pow(row - y, 2);
        if (squared > end * end) continue;
        const std::size_t pixel = static_cast<std::size_t>(row) * static_cast<std::size_t>(p.xres) +
                                  static_cast<std::size_t>(column);
        for (std::size_t channel = 0; channel < 3; ++channel) {
          const double e =
              palette_at(p.palette, particle.color, channel) * intensity * p.brightness;
          const double att = e * std::exp(-squared / (sigma * sigma));
          double& value = sum[3 * pixel + channel];
          if (p.a_eq_e) {
            value += att;
          } else {
            value += (1 - std::exp(-att)) * (e / (e + p.gray_absorption) - value);
          }
        }
      }
    }
  }
  std::vector<std::uint8_t> bytes;
  for (const double value : sum) {
    const double shown = p.a_eq_e ? 1 - std::exp(-value) : value;
    bytes.push_back(static_cast<std::uint8_t>(std::clamp(256 * shown, 0.0, 255.0)));
  }
  return bytes;
}

}  // namespace splotchcl::test
