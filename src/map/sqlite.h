// SPDX-FileCopyrightText: 2026 The Plumbline authors
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <sqlite3.h>

#include <cstddef>
#include <cstdint>
#include <map>
#include <memory>
#include <optional>
#include <string>

namespace plumb::sqlite {

// Bytes to bind; not owned, and alive until the statement has run.
struct Blob {
  const void* data = nullptr;
  std::size_t size = 0;
};

enum class Access {
  kWrite,          // Makes the file if it is absent.
  kRead,           // Beside others that may write, in a folder that can be written.
  kReadProtected,  // The same in one that cannot: where there is a log, with its index.
  kReadFrozen      // Nobody writes, and there is no log.
};

class Database;

// A prepared statement. Parameters count from 1, columns from 0.
class Statement {
 public:
  Statement(Database* database, const std::string& sql);
  ~Statement() { sqlite3_finalize(statement_); }
  Statement(const Statement&) = delete;
  Statement& operator=(const Statement&) = delete;

  // Binds all parameters in order and runs a statement that gives no rows.
  template <typename... Values>
  void Run(const Values&... values) {
    Start(values...);
    while (Step()) {
    }
  }

  // Binds all parameters in order; Step then gives the rows.
  template <typename... Values>
  void Start(const Values&... values) {
    Reset();
    int index = 0;
    (Bind(++index, values), ...);
  }

  // True while there is a row.
  bool Step();

  bool IsNull(int column) const { return sqlite3_column_type(statement_, column) == SQLITE_NULL; }
  std::int64_t Int(int column) const { return sqlite3_column_int64(statement_, column); }
  double Double(int column) const { return sqlite3_column_double(statement_, column); }
  std::string Text(int column) const;
  Blob Bytes(int column) const;  // Valid until the next Step, Start or Run.
  std::optional<double> OptionalDouble(int column) const;

 private:
  void Reset();
  void Bind(int index, std::int64_t value);
  void Bind(int index, std::uint64_t value) { Bind(index, static_cast<std::int64_t>(value)); }
  void Bind(int index, int value) { Bind(index, std::int64_t{value}); }
  void Bind(int index, std::uint32_t value) { Bind(index, std::int64_t{value}); }
  void Bind(int index, double value);
  void Bind(int index, float value) { Bind(index, static_cast<double>(value)); }
  void Bind(int index, const std::string& value);
  void Bind(int index, const char* value) { Bind(index, std::string(value)); }
  void Bind(int index, const Blob& value);
  template <typename Value>
  void Bind(int index, const std::optional<Value>& value) {
    if (value) Bind(index, *value);  // Parameters are null after Reset.
  }

  Database* database_;
  sqlite3_stmt* statement_ = nullptr;
};

// A connection. Every failure throws std::runtime_error that names the file, the cause and
// the cure. Not thread-safe.
class Database {
 public:
  Database(const std::string& path, Access access);

  const std::string& path() const { return path_; }

  // One or several statements without parameters or rows.
  void Execute(const std::string& sql);

  // The statement for `sql`, prepared once and kept.
  Statement& Prepared(const std::string& sql);

  // The first column of the first row; nothing without a row.
  std::optional<std::int64_t> QueryInt(const std::string& sql);

  [[noreturn]] void Fail(int code);

 private:
  friend class Statement;
  struct Closer {
    void operator()(sqlite3* handle) const { sqlite3_close_v2(handle); }
  };

  std::string path_;
  std::unique_ptr<sqlite3, Closer> handle_;
  std::map<std::string, std::unique_ptr<Statement>> prepared_;
};

// All or nothing: rolled back unless committed.
class Transaction {
 public:
  explicit Transaction(Database* database, const char* begin = "BEGIN IMMEDIATE")
      : database_(database) {
    database_->Execute(begin);
  }
  ~Transaction();
  Transaction(const Transaction&) = delete;
  Transaction& operator=(const Transaction&) = delete;

  void Commit();

 private:
  Database* database_;
  bool committed_ = false;
};

// One moment of the database for all reads of a scope, whatever others write meanwhile.
class ReadTransaction : private Transaction {
 public:
  explicit ReadTransaction(Database* database) : Transaction(database, "BEGIN DEFERRED") {}
};

}  // namespace plumb::sqlite
