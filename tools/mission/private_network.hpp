// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <sys/types.h>

namespace adit {

/// Takes this process, and all that it starts, onto a network of its own that has multicast on its
/// loopback and nothing else: LCM there hears nobody else, and nobody else hears it. False where
/// the system does not allow that; nothing has changed then. To be called before there are threads.
/// Throws std::system_error where the new network cannot be set up.
bool enter_private_network();

/// Joins the network of another process of the same user. Throws std::runtime_error.
void enter_network_of(pid_t pid);

}  // namespace adit
