// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <optional>
#include <string>

#include "sim/world/world_description.hpp"

namespace adit {

/// Parameters of a tunnel with one narrow stretch, to test on.
struct NarrowTunnelParams {
  enum class Shape {
    kStraight,
    kBent,    ///< by 30° with a radius of 20 m
    kNecked,  ///< 0.3 m wider, but for a neck of 4 m
  };

  double width_m = 1.5;  ///< where it is narrowest, 1.2 to 3, without relief
  Shape shape = Shape::kStraight;
};

/// The parameters in a name `narrow:METRES`, followed by any of `,straight`, `,bent` and `,necked`:
/// `narrow:1.5,bent`. Empty for a name that does not begin with `narrow:`. Throws
/// std::runtime_error for one that does and is not valid.
std::optional<NarrowTunnelParams> parse_narrow_tunnel(const std::string& name);

/// A level tunnel from an entrance at 0: 12 m long and 3 m wide, then narrow over 15 m, then 10 m
/// long and 3 m wide again. `seed` is that of its reliefs.
WorldDescription narrow_tunnel(const NarrowTunnelParams& params, int seed);

}  // namespace adit
