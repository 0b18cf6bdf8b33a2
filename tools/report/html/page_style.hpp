// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

namespace adit {

/// CSS of the page of a mission, but for that of its map: for screens light and dark, wide and
/// narrow, and for paper.
const char* page_style();

/// What the page does beside being read: folds open before printing, and where a link leads to.
const char* page_script();

}  // namespace adit
