// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <string>

namespace adit {

/// What LCM's sockets ask the kernel to hold for them: a few messages of 1 MB.
constexpr std::int64_t kReceiveBufferBytes = 4 << 20;

/// The URL with what is not said filled in: an empty one as LCM does it, from LCM_DEFAULT_URL or
/// with its default, and for multicast the size of the receive buffer. Without that size LCM takes
/// net.core.rmem_default, however large net.core.rmem_max may be.
std::string complete_lcm_url(std::string url);

}  // namespace adit
