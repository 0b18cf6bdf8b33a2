// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#include "common/picture/cloud_picture.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "common/picture/palette.hpp"

namespace adit {
namespace {

const Eigen::Vector3d kEye{-0.6, 0.0, 1.1};  // p_level [m]
constexpr double kDown = 0.06;               // pitch of the view [rad]
constexpr double kWide = 0.85;               // tangent of half the field of view
constexpr double kNearM = 0.5;
constexpr double kFadeM = 14.0;       // distance at which the brightness of a point is 1/e
constexpr double kPointM = 0.035;     // width of a point
constexpr double kColourLowM = -0.2;  // range of heights of the colour scale
constexpr double kColourHighM = 2.2;
constexpr Colour kDark = rgb(0x14171c);
constexpr Colour kGroundColour = rgb(0xd9c7a0);

Colour colour_of(double z_m, double depth_m) {
  const double share = (z_m - kColourLowM) / (kColourHighM - kColourLowM);
  const Colour bright = blend(blend(kGroundColour, kOpen, 0.1), along_path(share),
                              std::clamp(3.0 * share - 0.4, 0.0, 0.85));
  return blend(kDark, bright, std::exp(-depth_m / kFadeM));
}

/// An image with a depth buffer.
class DepthImage {
 public:
  DepthImage(int width, int height)
      : image_(width, height),
        depth_(image_.pixels.size(), std::numeric_limits<double>::infinity()),
        pixels_per_tangent_(width / (2.0 * kWide)) {
    std::fill(image_.pixels.begin(), image_.pixels.end(), rgb_pixel(kDark));
  }

  void draw(const Eigen::Vector3d& p_level) {
    const Eigen::Vector3d ray = p_level - kEye;
    const double depth = std::cos(kDown) * ray.x() - std::sin(kDown) * ray.z();
    if (!(depth > kNearM)) return;
    const double up = std::sin(kDown) * ray.x() + std::cos(kDown) * ray.z();
    const double x = image_.width / 2.0 - ray.y() / depth * pixels_per_tangent_;
    const double y = image_.height / 2.0 - up / depth * pixels_per_tangent_;
    const double half = std::clamp(kPointM / depth * pixels_per_tangent_, 1.0, 5.0) / 2.0;
    fill(x, y, half, depth, rgb_pixel(colour_of(p_level.z(), depth)));
  }

  [[nodiscard]] const RgbImage& image() const { return image_; }

 private:
  void fill(double x, double y, double half, double depth, const RgbImage::Pixel& colour) {
    if (!(x > -half && y > -half && x < image_.width + half && y < image_.height + half)) return;
    const auto from = [](double at) { return std::max(static_cast<int>(std::lround(at)), 0); };
    const int right = std::min(static_cast<int>(std::lround(x + half)), image_.width);
    const int low = std::min(static_cast<int>(std::lround(y + half)), image_.height);
    for (int v = from(y - half); v < low; ++v) {
      for (int u = from(x - half); u < right; ++u) {
        double& nearest =
            depth_[static_cast<std::size_t>(v) * static_cast<std::size_t>(image_.width) +
                   static_cast<std::size_t>(u)];
        if (depth >= nearest) continue;
        nearest = depth;
        image_.at(u, v) = colour;
      }
    }
  }

  RgbImage image_;
  std::vector<double> depth_;
  double pixels_per_tangent_;
};

}  // namespace

RgbImage cloud_image(const Cloud& cloud, int width, int height) {
  DepthImage view(width, height);
  for (const CloudLine& line : cloud.lines) {
    for (const Eigen::Vector3f& p : line.points) view.draw(p.cast<double>());
  }
  return view.image();
}

}  // namespace adit
