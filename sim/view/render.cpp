// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#include "sim/view/render.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <vector>

#include <Eigen/Geometry>

#include "sim/noise/smooth_noise.hpp"

namespace adit {
namespace {

constexpr float kGamma = 2.2F;
constexpr std::array<std::array<double, 2>, kSamplesPerPixel> kOffsets = {
    {{0.25, 0.25}, {0.75, 0.25}, {0.25, 0.75}, {0.75, 0.75}}};

std::uint8_t to_byte(float light) {
  const float shown = std::pow(std::clamp(light, 0.0F, 1.0F), 1.0F / kGamma);
  return static_cast<std::uint8_t>(std::lround(255.0F * shown));
}

}  // namespace

Rgb linear(unsigned hex) {
  const Rgb shown(static_cast<float>(hex >> 16U & 0xffU), static_cast<float>(hex >> 8U & 0xffU),
                  static_cast<float>(hex & 0xffU));
  return (shown / 255.0F).array().pow(kGamma);
}

RgbImage::Pixel to_pixel(const Rgb& light) {
  return {to_byte(light.x()), to_byte(light.y()), to_byte(light.z())};
}

RgbImage render(int width, int height, const RowPainter& paint) {
  RgbImage image(width, height);
  const auto count = static_cast<std::size_t>(width) * kSamplesPerPixel;
  std::vector<Eigen::Vector2d> samples(count);
  std::vector<Rgb> light(count);
  for (int row = 0; row < height; ++row) {
    for (std::size_t i = 0; i < count; ++i) {
      const auto& [du, dv] = kOffsets[i % kSamplesPerPixel];
      const std::size_t column = i / kSamplesPerPixel;
      samples[i] = {static_cast<double>(column) + du, row + dv};
    }
    paint(samples, light);
    for (int column = 0; column < width; ++column) {
      const Rgb* first = light.data() + static_cast<std::ptrdiff_t>(column) * kSamplesPerPixel;
      const Rgb sum = first[0] + first[1] + first[2] + first[3];
      image.at(column, row) = to_pixel(sum / kSamplesPerPixel);
    }
  }
  return image;
}

namespace {

/// Noise from 0 to 1 with a correlation length of one unit.
float noise(const Eigen::Vector3f& p) {
  const SmoothNoise between_ones(1);
  return 0.5F + 0.5F * static_cast<float>(between_ones.in_space(p.cast<double>()));
}

/// Factor of about 1 by which the colour of natural materials varies. Rotated, so that the lattice
/// of the noise is not visible on walls and floors.
float grain(const Eigen::Vector3f& p_world) {
  static const Eigen::Matrix3f kAskew =
      Eigen::AngleAxisf(0.9F, Eigen::Vector3f(0.5F, 0.6F, 0.62F).normalized()).toRotationMatrix();
  const Eigen::Vector3f p = kAskew * p_world;
  return 0.62F + 0.26F * noise(1.7F * p) + 0.26F * noise(7.0F * p) + 0.24F * noise(29.0F * p);
}

}  // namespace

Rgb plain_colour(const Part& part) {
  switch (part.kind) {
    case PartKind::kFloor:
      return part.material == Material::kMud ? linear(0x5b4a36) : linear(0xa89a86);
    case PartKind::kRoof:
      return linear(0x8c8880);
    case PartKind::kWall:
      return linear(0x98928a);
    case PartKind::kRail:
      return linear(0x6f7f90);
    case PartKind::kSleeper:
      return linear(0x6b4d33);
    case PartKind::kPost:
      return linear(0xc2924f);
    case PartKind::kCrib:
      return linear(0xb5813f);
    case PartKind::kRubble:
      return linear(0x85858a);
    case PartKind::kBeam:
      return linear(0xa4672c);
    case PartKind::kCable:
      return linear(0xb9c6d6);
    case PartKind::kCar:
      return linear(0x9b4a33);
    case PartKind::kWater:
      return linear(0x3f7fb5);
    case PartKind::kOther:
      break;
  }
  return linear(0x9a948b);
}

Rgb colour_at(const Part& part, const Eigen::Vector3f& p_world) {
  Rgb plain = plain_colour(part);
  switch (part.material) {
    case Material::kRock:
    case Material::kMud:
      return grain(p_world) * plain;
    case Material::kTimber:
      return (0.75F + 0.5F * noise(Eigen::Vector3f(
                                 p_world.cwiseProduct(Eigen::Vector3f(23.0F, 23.0F, 7.0F))))) *
             plain;
    case Material::kSteel:
    case Material::kWater:
    case Material::kMirror:
      break;
  }
  return plain;
}

}  // namespace adit
