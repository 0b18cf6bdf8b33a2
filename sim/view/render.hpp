// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <functional>
#include <span>

#include <Eigen/Core>

#include "common/picture/rgb_image.hpp"
#include "sim/mesh/triangle_mesh.hpp"

namespace adit {

/// Red, green and blue as linear light: 0 is black, 1 the white of the picture, more is cut off.
using Rgb = Eigen::Vector3f;

/// A colour that is written as on the web, as linear light.
Rgb linear(unsigned hex);

/// As a pixel, with the transfer curve of sRGB taken as a power of 2.2.
RgbImage::Pixel to_pixel(const Rgb& light);

/// How many samples a pixel has, side by side among those of its row.
inline constexpr int kSamplesPerPixel = 4;

/// Gives the light at samples of one row of pixels, (u, v) as in Camera.
using RowPainter =
    std::function<void(std::span<const Eigen::Vector2d> samples, std::span<Rgb> light)>;

/// The mean of 2 × 2 samples for each pixel.
RgbImage render(int width, int height, const RowPainter& paint);

/// The colour of a part in white light, without grain.
Rgb plain_colour(const Part& part);

/// The colour at a place of it. Rock, floor and timber have a grain, fixed in the world.
Rgb colour_at(const Part& part, const Eigen::Vector3f& p_world);

}  // namespace adit
