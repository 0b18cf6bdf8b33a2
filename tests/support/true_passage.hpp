// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "common/vehicle/vehicle.hpp"
#include "tests/support/corridor_mine.hpp"

namespace adit {

/// The vehicle with room all round it, and with less in it to spare: what it can do, nobody doubts.
Vehicle with_room(const Vehicle& vehicle, double room_m);

/// How far along its drift the vehicle can be driven forwards in the true mine [m], up to
/// `enough_m`: a search over poses that has nothing in common with the planner, each tried in the
/// mesh. Bends no tighter than 2 m.
double true_passage(const Corridor& corridor, const Vehicle& vehicle, double enough_m);

}  // namespace adit
