// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>

#include "common/picture/rgb_image.hpp"

namespace adit {

inline constexpr Colour kPaper = rgb(0xe8e5df);
inline constexpr Colour kOpen = rgb(0xffffff);
inline constexpr Colour kWall = rgb(0x1f242b);
inline constexpr Colour kInk = rgb(0x33373d);
inline constexpr Colour kDegenerate = rgb(0xf5b301, 0.55);
inline constexpr Colour kDoubtful = rgb(0xe0218a, 0.6);
inline constexpr Colour kStart = rgb(0x2a9d5c);
inline constexpr Colour kEnd = rgb(0xc8324a);
inline constexpr Colour kGraph = rgb(0x33373d);
inline constexpr Colour kLoopClosure = rgb(0x2fa32a);
inline constexpr Colour kRevoked = rgb(0xf07800);
inline constexpr Colour kScanMark = rgb(0x22262b);
inline constexpr Colour kJunctionMark = rgb(0x2f7fd6);
inline constexpr Colour kDeadEndMark = rgb(0x8a5a2b);
inline constexpr Colour kBlockedMark = rgb(0x6b5b95);
inline constexpr Colour kOpenMark = rgb(0xc8102e);
inline constexpr Colour kAppearedMark = rgb(0xd81b1b);
inline constexpr Colour kVanishedMark = rgb(0x1f6fd0);
inline constexpr Colour kDiffersMark = rgb(0xe08a00);
inline constexpr Colour kRim = rgb(0xffffff, 0.85);  // rim of lines over walls

/// Colours from the start of a path to its end; darker than the ground and lighter than the walls.
inline constexpr std::array<Colour, 4> kAlongPath = {rgb(0x1a9a8f), rgb(0x2f6fc1), rgb(0x8a4bc0),
                                                     rgb(0xe0483e)};

inline Colour blend(const Colour& a, const Colour& b, double share) {
  return {std::lerp(a.red, b.red, share), std::lerp(a.green, b.green, share),
          std::lerp(a.blue, b.blue, share)};
}

inline RgbImage::Pixel rgb_pixel(const Colour& colour) {
  const auto byte = [](double share) {
    return static_cast<std::uint8_t>(std::lround(255.0 * share));
  };
  return {byte(colour.red), byte(colour.green), byte(colour.blue)};
}

/// The colour of a path at a share of its length, 0 to 1.
inline Colour along_path(double share) {
  const double place = std::clamp(share, 0.0, 1.0) * (kAlongPath.size() - 1);
  const auto i = std::min(static_cast<std::size_t>(place), kAlongPath.size() - 2);
  return blend(kAlongPath[i], kAlongPath[i + 1], place - static_cast<double>(i));
}

}  // namespace adit
