// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "procs/mapping/mapping.hpp"
#include "tools/eval/path_error.hpp"

namespace adit::test {

/// The map as a mapping would begin with it, that has the default configuration, but for what is
/// unfinished.
MapGraph restore_graph(const StoredMap& stored);

/// Of the positions of the local maps.
PathError error_of(const StoredMap& stored, const MapGraph& graph, const Trajectory& truth);

/// How many closures hold a session to an earlier one.
int loop_closures_between_sessions(const StoredMap& stored, const MapGraph& graph);

}  // namespace adit::test
