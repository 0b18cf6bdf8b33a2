// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>
#include <string_view>

namespace adit {

/// 128 random bits, in hexadecimal digits. Throws std::runtime_error.
std::string random_secret();

/// In a time that does not depend on where they differ.
bool secrets_are_equal(std::string_view a, std::string_view b);

}  // namespace adit
