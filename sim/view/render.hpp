// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <functional>
#include <span>

#include <Eigen/Core>

#include "common/picture/rgb_image.hpp"
#include "sim/mesh/triangle_mesh.hpp"

namespace adit {

/// Red, green and blue as linear light: 0 is black, 1 is white, higher values are clipped.
using Rgb = Eigen::Vector3f;

/// Converts an RGB value of 24 bits in sRGB to linear light.
Rgb linear(unsigned hex);

/// Converts linear light to a pixel, with a gamma of 2.2 for sRGB.
RgbImage::Pixel to_pixel(const Rgb& light);

/// Number of samples of a pixel, adjacent in the samples of its row.
inline constexpr int kSamplesPerPixel = 4;

/// Computes the light of the samples of one row of pixels, (u, v) as in Camera.
using RowPainter =
    std::function<void(std::span<const Eigen::Vector2d> samples, std::span<Rgb> light)>;

/// Renders each pixel as the mean of 2 × 2 samples.
RgbImage render(int width, int height, const RowPainter& paint);

/// Colour of a part in white light, without texture.
Rgb plain_colour(const Part& part);

/// Colour at a point of a part. Rock, floor and timber have a texture, fixed in the world.
Rgb colour_at(const Part& part, const Eigen::Vector3f& p_world);

}  // namespace adit
