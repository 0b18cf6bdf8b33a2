// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "common/exploration/stub.hpp"
#include "common/geometry/pose2.hpp"
#include "procs/exploration/stub_choice.hpp"

namespace adit {

/// Rules that ours is held against. The same offers, pose and target give the same choice.
///   nearest     the nearest stub, chosen anew each time;
///   right_hand  the rightmost of those within 15 m, seen from the body, otherwise the nearest;
///   random      any, by numbers that the ids of the stubs stand for.
/// The last two keep to a `target` while it is on offer, against pacing back and forth. `stubs`
/// are all, by id. Nothing where there is no offer. Throws std::invalid_argument for another rule.
std::optional<int> choose_by(const std::string& rule, const std::vector<StubOffer>& offers,
                             const std::vector<Stub>& stubs, const Pose2& T_map_body, int target);

}  // namespace adit
