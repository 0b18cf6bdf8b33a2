// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "procs/mapping/mapping.hpp"
#include "tools/eval/path_error.hpp"

namespace adit::test {

/// The map graph that mapping with the default configuration restores from a stored map, without
/// the unfinished part.
MapGraph restore_graph(const StoredMap& stored);

/// Error of the positions of the local maps.
PathError error_of(const StoredMap& stored, const MapGraph& graph, const Trajectory& truth);

/// Number of loop closures between different sessions.
int loop_closures_between_sessions(const StoredMap& stored, const MapGraph& graph);

}  // namespace adit::test
