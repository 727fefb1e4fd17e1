// SPDX-FileCopyrightText: 2026 The Plumbline authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "map/sqlite.h"

#include <stdexcept>

namespace plumb::sqlite {
namespace {

// Long enough for a writer's checkpoint on a slow card; a lock that lasts longer is no accident.
constexpr int kBusyTimeout_ms = 10000;

const char* CureFor(int code) {
  switch (code & 0xff) {
    case SQLITE_FULL:
      return "free some space on this disk";
    case SQLITE_NOTADB:
    case SQLITE_CORRUPT:
      return "put a copy in its place if there is one; else choose another session folder, or move "
             "the file away, and map the photos anew";
    case SQLITE_READONLY:
    case SQLITE_CANTOPEN:
    case SQLITE_PERM:
      return "make the file and its folder writable, copy the session to where they are, or choose "
             "another session folder";
    case SQLITE_BUSY:
    case SQLITE_LOCKED:
      return "another program uses this session: wait for it or end it";
    case SQLITE_IOERR:
      return "the disk refuses to read or write: check its space, quota and health";
    default:
      return "the file may be damaged: choose another session folder";
  }
}

// https://www.sqlite.org/uri.html
std::string Uri(const std::string& path, Access access) {
  std::string uri = "file:";
  for (const char character : path) {
    switch (character) {
      case '%':
        uri += "%25";
        break;
      case '?':
        uri += "%3f";
        break;
      case '#':
        uri += "%23";
        break;
      default:
        uri += character;
    }
  }
  return uri + (access == Access::kReadFrozen ? "?immutable=1" : "?mode=ro");
}

}  // namespace

Statement::Statement(Database* database, const std::string& sql) : database_(database) {
  const int code = sqlite3_prepare_v2(
      database->handle_.get(), sql.c_str(), static_cast<int>(sql.size()), &statement_, nullptr);
  if (code != SQLITE_OK) database->Fail(code);
}

void Statement::Reset() {
  sqlite3_reset(statement_);  // Repeats the error of the last Step, which was thrown already.
  sqlite3_clear_bindings(statement_);
}

bool Statement::Step() {
  const int code = sqlite3_step(statement_);
  if (code == SQLITE_ROW) return true;
  if (code != SQLITE_DONE) {
    sqlite3_reset(statement_);
    database_->Fail(code);
  }
  sqlite3_reset(statement_);
  return false;
}

void Statement::Bind(int index, std::int64_t value) {
  sqlite3_bind_int64(statement_, index, value);
}

void Statement::Bind(int index, double value) { sqlite3_bind_double(statement_, index, value); }

void Statement::Bind(int index, const std::string& value) {
  sqlite3_bind_text(
      statement_, index, value.data(), static_cast<int>(value.size()), SQLITE_TRANSIENT);
}

void Statement::Bind(int index, const Blob& value) {
  // A null pointer would bind NULL instead of an empty blob.
  const void* data = value.size == 0 ? "" : value.data;
  sqlite3_bind_blob64(statement_, index, data, value.size, SQLITE_STATIC);
}

std::string Statement::Text(int column) const {
  const unsigned char* text = sqlite3_column_text(statement_, column);
  if (text == nullptr) return {};
  return {reinterpret_cast<const char*>(text),
          static_cast<std::size_t>(sqlite3_column_bytes(statement_, column))};
}

Blob Statement::Bytes(int column) const {
  const void* data = sqlite3_column_blob(statement_, column);
  return {data, static_cast<std::size_t>(sqlite3_column_bytes(statement_, column))};
}

std::optional<double> Statement::OptionalDouble(int column) const {
  if (IsNull(column)) return std::nullopt;
  return Double(column);
}

Database::Database(const std::string& path, Access access) : path_(path) {
  sqlite3* handle = nullptr;
  const bool is_uri = access == Access::kReadProtected || access == Access::kReadFrozen;
  const std::string name = is_uri ? Uri(path, access) : path;
  int flags = is_uri ? SQLITE_OPEN_READONLY | SQLITE_OPEN_URI : SQLITE_OPEN_READWRITE;
  if (access == Access::kWrite) flags |= SQLITE_OPEN_CREATE;
  const int code = sqlite3_open_v2(name.c_str(), &handle, flags, nullptr);
  handle_.reset(handle);
  if (code != SQLITE_OK) Fail(code);
  sqlite3_busy_timeout(handle, kBusyTimeout_ms);
  if (access == Access::kRead) Execute("PRAGMA query_only = ON");
}

void Database::Execute(const std::string& sql) {
  const int code = sqlite3_exec(handle_.get(), sql.c_str(), nullptr, nullptr, nullptr);
  if (code != SQLITE_OK) Fail(code);
}

Statement& Database::Prepared(const std::string& sql) {
  std::unique_ptr<Statement>& statement = prepared_[sql];
  if (!statement) statement = std::make_unique<Statement>(this, sql);
  return *statement;
}

std::optional<std::int64_t> Database::QueryInt(const std::string& sql) {
  Statement statement(this, sql);
  if (!statement.Step() || statement.IsNull(0)) return std::nullopt;
  return statement.Int(0);
}

void Database::Fail(int code) {
  const char* cause = handle_ ? sqlite3_errmsg(handle_.get()) : sqlite3_errstr(code);
  throw std::runtime_error(path_ + ": " + cause + "; " + CureFor(code));
}

Transaction::~Transaction() {
  if (committed_) return;
  try {
    database_->Execute("ROLLBACK");
  } catch (const std::exception&) {
    // SQLite has rolled back by itself after a full disk or an input/output error.
  }
}

void Transaction::Commit() {
  database_->Execute("COMMIT");
  committed_ = true;
}

}  // namespace plumb::sqlite
