// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>
#include <vector>

#include "common/process_list/process_list.hpp"

namespace adit {

/// What a list that was read again says otherwise than before; names, in the order of the lists.
struct ListChange {
  std::vector<std::string> changed;  ///< in anything: command line, computer, limits
  std::vector<std::string> added;
  std::vector<std::string> gone;
  bool scripts = false;
};

ListChange change_between(const ProcessList& before, const ProcessList& after);

/// For people: a line for each kind of change, or that there is none.
std::string text_of(const ListChange& change);

}  // namespace adit
