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

/// The bytes of a PNG file with a palette and at most 8 bits per pixel, which is a third or less of
/// the size in true colour. An image of more than 256 colours is quantised: similar colours are
/// replaced by their mean. `transparent` is a colour to be transparent. The result is the same for
/// the same image and zlib.
std::vector<std::uint8_t> indexed_png(
    const RgbImage& image, const std::optional<RgbImage::Pixel>& transparent = std::nullopt);

/// Bytes as a data URI of RFC 2397: "data:image/png;base64,…".
std::string data_uri(const std::string& media_type, std::span<const std::uint8_t> bytes);

}  // namespace adit
