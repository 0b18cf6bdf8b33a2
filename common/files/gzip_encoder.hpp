// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <memory>
#include <string>
#include <string_view>

struct z_stream_s;

namespace adit {

/// Compresses bytes that arrive in parts to gzip (RFC 1952). The same bytes give the same result.
class GzipEncoder {
 public:
  GzipEncoder();
  ~GzipEncoder();
  GzipEncoder(const GzipEncoder&) = delete;
  GzipEncoder& operator=(const GzipEncoder&) = delete;

  void add(std::string_view bytes);
  /// Everything that was added, compressed. Nothing may be added afterwards.
  std::string finish();

 private:
  void deflate_all(std::string_view bytes, bool is_last);

  std::unique_ptr<z_stream_s> stream_;
  std::string compressed_;
};

}  // namespace adit
