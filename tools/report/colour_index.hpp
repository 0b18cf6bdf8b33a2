// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <vector>

#include "common/picture/rgb_image.hpp"

namespace adit {

/// An image by a palette.
struct IndexedImage {
  std::vector<RgbImage::Pixel> palette;  ///< 256 colours at most
  std::vector<std::uint8_t> indices;     ///< of each pixel
};

/// Exact where the palette holds all colours; otherwise those that share their highest bits become
/// one, their mean.
IndexedImage indexed_image(const RgbImage& image);

}  // namespace adit
