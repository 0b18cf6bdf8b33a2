// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "sim/live/world_choice.hpp"

namespace adit::test {

/// One of the random mines that missions are counted over: 40 to 100 m of drift, all topologies,
/// sound ones and ruins. The same number gives the same mine.
WorldChoice mission_mine(int number);

}  // namespace adit::test
