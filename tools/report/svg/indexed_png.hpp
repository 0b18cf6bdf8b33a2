// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "common/picture/rgb_image.hpp"

namespace adit {

/// The bytes of a PNG file with a palette, a byte or less for each pixel: a third or less of what
/// true colour takes. More than 256 colours are brought down to that, the like by their mean.
/// `clear` is a colour that lets through what is behind the image. The same image gives the same
/// bytes with the same zlib.
std::vector<std::uint8_t> indexed_png(const RgbImage& image,
                                      const std::optional<RgbImage::Pixel>& clear = std::nullopt);

/// Bytes in a page itself, RFC 2397: "data:image/png;base64,…".
std::string data_uri(const std::string& media_type, std::span<const std::uint8_t> bytes);

}  // namespace adit
