// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <filesystem>
#include <memory>
#include <optional>
#include <span>
#include <string>

struct sqlite3;
struct sqlite3_stmt;

namespace adit {

/// A prepared statement of SQL. Parameters and columns count from 0. Throws FileError.
class SqlStatement {
 public:
  void bind(int parameter, const std::string& value);
  void bind(int parameter, std::int64_t value);
  void bind(int parameter, double value);
  void bind_null(int parameter);

  /// The next row; false after the last.
  bool step();
  /// Prepares the statement for other parameters.
  void reset();

  [[nodiscard]] int columns() const;
  [[nodiscard]] std::string column_name(int column) const;
  [[nodiscard]] bool is_null(int column) const;
  [[nodiscard]] bool is_number(int column) const;
  /// The value as text; empty for null.
  [[nodiscard]] std::string text(int column) const;
  /// The value as bytes, valid until the next step; empty for null.
  [[nodiscard]] std::span<const std::uint8_t> bytes(int column) const;
  [[nodiscard]] std::int64_t integer(int column) const;
  [[nodiscard]] double number(int column) const;
  /// Whether the value is true (not zero); nothing for null.
  [[nodiscard]] std::optional<bool> truth(int column) const;

 private:
  friend class Database;
  struct End {
    void operator()(sqlite3_stmt* statement) const;
  };

  explicit SqlStatement(sqlite3_stmt* statement) : statement_(statement) {}
  [[noreturn]] void fail() const;
  void check(int code) const;

  std::unique_ptr<sqlite3_stmt, End> statement_;
};

/// An SQLite database: the only class that knows the library. With a write-ahead log, so that
/// others read while this writes; what is committed survives the end of the process, by a kill
/// too. Throws FileError with the path.
class Database {
 public:
  enum class Mode {
    kWrite,
    kRead,
    kReadFinished  ///< a file that nobody writes, also on a medium that cannot be written
  };

  /// Creates the file for kWrite.
  Database(const std::filesystem::path& path, Mode mode);

  /// Runs statements without results.
  void execute(const std::string& sql);
  /// One statement. Throws FileError with the reason of SQLite.
  SqlStatement prepare(const std::string& sql);

 private:
  struct End {
    void operator()(sqlite3* database) const;
  };

  std::unique_ptr<sqlite3, End> database_;
};

/// Statements of which all take effect, or none if this ends without commit.
class SqlTransaction {
 public:
  explicit SqlTransaction(Database& database);
  ~SqlTransaction();
  SqlTransaction(const SqlTransaction&) = delete;
  SqlTransaction& operator=(const SqlTransaction&) = delete;

  void commit();

 private:
  Database& database_;
  bool committed_ = false;
};

}  // namespace adit
