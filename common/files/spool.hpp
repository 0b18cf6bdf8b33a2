// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <cstring>
#include <filesystem>
#include <iterator>
#include <span>
#include <type_traits>
#include <utility>
#include <vector>

#include "common/files/spool_file.hpp"

namespace adit {

/// A long sequence of records, mostly read in order, in constant memory (SpoolFile). Elements are
/// returned by value; throws FileError if the disk fails.
template <class T>
class Spool {
  static_assert(std::is_trivially_copyable_v<T>);

 public:
  using value_type = T;

  /// In the folder for temporary files, or in `folder`.
  Spool() : Spool(std::filesystem::temp_directory_path()) {}
  explicit Spool(std::filesystem::path folder) : file_(std::move(folder)) {}

  void push_back(const T& value) {
    file_.append({reinterpret_cast<const std::uint8_t*>(&value), sizeof(T)});
  }
  void pop_back() {
    file_.truncate(sizeof(T) * (size() - 1));
    read_.clear();
  }

  [[nodiscard]] std::size_t size() const {
    return static_cast<std::size_t>(file_.size() / sizeof(T));
  }
  [[nodiscard]] bool empty() const { return size() == 0; }

  /// Reading the next element is fast.
  [[nodiscard]] T operator[](std::size_t i) const {
    if (i - first_read_ >= read_.size()) {
      const bool is_next = i == first_read_ + read_.size();
      read(i, is_next ? std::min(kReadAtOnce, size() - i) : 1);
    }
    return read_[i - first_read_];
  }
  [[nodiscard]] T front() const { return (*this)[0]; }
  [[nodiscard]] T back() const { return (*this)[size() - 1]; }

  class Iterator {
   public:
    using iterator_category = std::input_iterator_tag;  // elements are values
    using iterator_concept = std::random_access_iterator_tag;
    using value_type = T;
    using difference_type = std::ptrdiff_t;
    using reference = T;
    using pointer = void;

    Iterator() = default;
    Iterator(const Spool* spool, std::ptrdiff_t i) : spool_(spool), i_(i) {}

    T operator*() const { return (*spool_)[static_cast<std::size_t>(i_)]; }
    T operator[](std::ptrdiff_t n) const { return *(*this + n); }
    Iterator& operator++() { return *this += 1; }
    Iterator& operator--() { return *this += -1; }
    Iterator operator++(int) { return {spool_, i_++}; }
    Iterator operator--(int) { return {spool_, i_--}; }
    Iterator& operator+=(std::ptrdiff_t n) {
      i_ += n;
      return *this;
    }
    Iterator& operator-=(std::ptrdiff_t n) { return *this += -n; }
    friend Iterator operator+(Iterator it, std::ptrdiff_t n) { return it += n; }
    friend Iterator operator+(std::ptrdiff_t n, Iterator it) { return it += n; }
    friend Iterator operator-(Iterator it, std::ptrdiff_t n) { return it -= n; }
    friend std::ptrdiff_t operator-(const Iterator& a, const Iterator& b) { return a.i_ - b.i_; }
    friend bool operator==(const Iterator& a, const Iterator& b) { return a.i_ == b.i_; }
    friend auto operator<=>(const Iterator& a, const Iterator& b) { return a.i_ <=> b.i_; }

   private:
    const Spool* spool_ = nullptr;
    std::ptrdiff_t i_ = 0;
  };

  [[nodiscard]] Iterator begin() const { return {this, 0}; }
  [[nodiscard]] Iterator end() const { return {this, static_cast<std::ptrdiff_t>(size())}; }

 private:
  static constexpr std::size_t kReadAtOnce = std::max<std::size_t>(1, 65536 / sizeof(T));

  void read(std::size_t from, std::size_t count) const {
    read_.resize(count);
    first_read_ = from;
    file_.read(sizeof(T) * from,
               {reinterpret_cast<std::uint8_t*>(read_.data()), sizeof(T) * count});
  }

  SpoolFile file_;
  mutable std::vector<T> read_;  ///< a few elements around the last one that was read
  mutable std::size_t first_read_ = 0;
};

}  // namespace adit
