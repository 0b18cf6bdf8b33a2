// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <algorithm>
#include <cstddef>
#include <initializer_list>
#include <vector>

namespace adit {

/// Baud rates in the order in which a device is searched: the one of the configuration first, then
/// those that are usual, again and again.
class BaudSearch {
 public:
  BaudSearch(int preferred, std::initializer_list<int> usual) : bauds_{preferred} {
    for (const int baud : usual) {
      if (std::ranges::find(bauds_, baud) == bauds_.end()) bauds_.push_back(baud);
    }
  }

  [[nodiscard]] int current() const { return bauds_[index_]; }

  /// The next one. True if all were tried since the device was last received.
  bool advance() {
    index_ = (index_ + 1) % bauds_.size();
    ++tried_;
    return tried_ >= bauds_.size();
  }

  /// The device was received at the current rate.
  void found() { tried_ = 0; }

 private:
  std::vector<int> bauds_;
  std::size_t index_ = 0;
  std::size_t tried_ = 0;
};

}  // namespace adit
