// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#include "tools/database/database.hpp"

#include <fmt/format.h>
#include <sqlite3.h>

#include "common/files/file_error.hpp"

namespace adit {
namespace {

constexpr int kBusyTimeoutMs = 10'000;

/// The path as an URI that tells SQLite to create no files beside it.
std::string immutable_uri(const std::filesystem::path& path) {
  std::string uri = "file:";
  for (const char c : std::filesystem::absolute(path).string()) {
    if (c == '%' || c == '?' || c == '#') {
      uri += fmt::format("%{:02X}", static_cast<unsigned>(c));
    } else {
      uri += c;
    }
  }
  return uri + "?immutable=1";
}

[[noreturn]] void fail_of(sqlite3* database) {
  const char* const path = sqlite3_db_filename(database, "main");
  throw FileError(
      fmt::format("{}: {}", path && *path ? path : "database", sqlite3_errmsg(database)));
}

}  // namespace

void SqlStatement::End::operator()(sqlite3_stmt* statement) const { sqlite3_finalize(statement); }

void SqlStatement::fail() const { fail_of(sqlite3_db_handle(statement_.get())); }

void SqlStatement::check(int code) const {
  if (code != SQLITE_OK) fail();
}

void SqlStatement::bind(int parameter, const std::string& value) {
  check(sqlite3_bind_text(statement_.get(), parameter + 1, value.data(),
                          static_cast<int>(value.size()), SQLITE_TRANSIENT));
}

void SqlStatement::bind(int parameter, std::int64_t value) {
  check(sqlite3_bind_int64(statement_.get(), parameter + 1, value));
}

void SqlStatement::bind(int parameter, double value) {
  check(sqlite3_bind_double(statement_.get(), parameter + 1, value));
}

void SqlStatement::bind_null(int parameter) {
  check(sqlite3_bind_null(statement_.get(), parameter + 1));
}

bool SqlStatement::step() {
  const int code = sqlite3_step(statement_.get());
  if (code != SQLITE_ROW && code != SQLITE_DONE) fail();
  return code == SQLITE_ROW;
}

void SqlStatement::reset() {
  sqlite3_reset(statement_.get());
  sqlite3_clear_bindings(statement_.get());
}

int SqlStatement::columns() const { return sqlite3_column_count(statement_.get()); }

std::string SqlStatement::column_name(int column) const {
  return sqlite3_column_name(statement_.get(), column);
}

bool SqlStatement::is_null(int column) const {
  return sqlite3_column_type(statement_.get(), column) == SQLITE_NULL;
}

bool SqlStatement::is_number(int column) const {
  const int type = sqlite3_column_type(statement_.get(), column);
  return type == SQLITE_INTEGER || type == SQLITE_FLOAT;
}

std::string SqlStatement::text(int column) const {
  const auto* const value = sqlite3_column_text(statement_.get(), column);
  return value ? reinterpret_cast<const char*>(value) : "";
}

std::span<const std::uint8_t> SqlStatement::bytes(int column) const {
  const auto* const value =
      static_cast<const std::uint8_t*>(sqlite3_column_blob(statement_.get(), column));
  if (value == nullptr) return {};
  return {value, static_cast<std::size_t>(sqlite3_column_bytes(statement_.get(), column))};
}

std::int64_t SqlStatement::integer(int column) const {
  return sqlite3_column_int64(statement_.get(), column);
}

double SqlStatement::number(int column) const {
  return sqlite3_column_double(statement_.get(), column);
}

std::optional<bool> SqlStatement::truth(int column) const {
  if (is_null(column)) return std::nullopt;
  return number(column) != 0.0;
}

void Database::End::operator()(sqlite3* database) const { sqlite3_close_v2(database); }

Database::Database(const std::filesystem::path& path, Mode mode) {
  sqlite3* database = nullptr;
  const int flags =
      mode == Mode::kWrite ? SQLITE_OPEN_READWRITE | SQLITE_OPEN_CREATE : SQLITE_OPEN_READONLY;
  const bool finished = mode == Mode::kReadFinished;
  const std::string name = finished ? immutable_uri(path) : path.string();
  const int code =
      sqlite3_open_v2(name.c_str(), &database, finished ? flags | SQLITE_OPEN_URI : flags, nullptr);
  database_.reset(database);
  if (code != SQLITE_OK) {
    throw FileError(fmt::format("{}: {}", path.string(),
                                database ? sqlite3_errmsg(database) : sqlite3_errstr(code)));
  }
  sqlite3_busy_timeout(database, kBusyTimeoutMs);
  // A text in double quotes that names no column is a string: outcome == "home".
  sqlite3_db_config(database, SQLITE_DBCONFIG_DQS_DML, 1, nullptr);
  if (mode == Mode::kWrite) execute("PRAGMA journal_mode = WAL; PRAGMA synchronous = NORMAL");
}

void Database::execute(const std::string& sql) {
  if (sqlite3_exec(database_.get(), sql.c_str(), nullptr, nullptr, nullptr) != SQLITE_OK)
    fail_of(database_.get());
}

SqlStatement Database::prepare(const std::string& sql) {
  sqlite3_stmt* statement = nullptr;
  if (sqlite3_prepare_v2(database_.get(), sql.c_str(), static_cast<int>(sql.size()), &statement,
                         nullptr) != SQLITE_OK) {
    fail_of(database_.get());
  }
  return SqlStatement(statement);
}

SqlTransaction::SqlTransaction(Database& database) : database_(database) {
  database_.execute("BEGIN IMMEDIATE");
}

SqlTransaction::~SqlTransaction() {
  if (committed_) return;
  try {
    database_.execute("ROLLBACK");
  } catch (const FileError&) {  // the database does it when it is opened again
  }
}

void SqlTransaction::commit() {
  database_.execute("COMMIT");
  committed_ = true;
}

}  // namespace adit
