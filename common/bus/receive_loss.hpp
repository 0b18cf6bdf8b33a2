// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

namespace adit {

/// For tests: which share of the datagrams each process is to lose that comes to its socket, as a
/// bad network would, by the environment variable ADIT_RECEIVE_LOSS; 0 without it. Throws
/// std::invalid_argument where that is no share.
double receive_loss_share();

}  // namespace adit
