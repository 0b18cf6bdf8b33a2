// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "adit/plan_goal_t.hpp"

#include "common/messages/result.hpp"
#include "common/path/planned_path.hpp"

namespace adit {

plan_goal_t to_message(const PlanGoal& goal);

/// Refused: an implausible time, a negative id, an unknown kind, a pose that is not finite, a
/// distance that is not finite or not positive, a route or a track that the kind needs and that is
/// none, or is not finite.
Result<PlanGoal> from_message(const plan_goal_t& message);

}  // namespace adit
