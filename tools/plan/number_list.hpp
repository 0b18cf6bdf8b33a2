// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>
#include <string>
#include <vector>

namespace adit {

/// Finite numbers between commas, as a command line has them: "1.5,-2". Throws
/// std::invalid_argument, one line that names the option, where they are not as many as it takes.
std::vector<double> parse_number_list(const std::string& option, const std::string& text,
                                      std::size_t least, std::size_t most);

}  // namespace adit
