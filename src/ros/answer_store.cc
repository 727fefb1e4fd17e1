// SPDX-FileCopyrightText: 2026 The Plumbline authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "ros/answer_store.h"

#include <ros/serialization.h>

#include <cstdint>
#include <filesystem>
#include <stdexcept>

namespace plumb::ros_adapter {
namespace {

using Answer = plumbline::MarkerDetectionArray;

std::string Definition() { return ros::message_traits::MD5Sum<Answer>::value(); }

// Throws ros::serialization::StreamOverrunException if the bytes are too few.
Answer Deserialize(const sqlite::Blob& bytes) {
  // IStream takes no pointer to const, but does not write.
  auto* data = static_cast<std::uint8_t*>(const_cast<void*>(bytes.data));
  ros::serialization::IStream stream(data, static_cast<std::uint32_t>(bytes.size));
  Answer answer;
  ros::serialization::deserialize(stream, answer);
  return answer;
}

std::unique_ptr<sqlite::Database> Open(const std::string& session_folder) {
  std::error_code error;
  std::filesystem::create_directories(session_folder, error);
  if (error) {
    throw std::runtime_error(session_folder + ": cannot be made: " + error.message() +
                             "; make its folder writable, or name another session");
  }
  return std::make_unique<sqlite::Database>(session_folder + "/markers.db", sqlite::Access::kWrite);
}

}  // namespace

AnswerStore::AnswerStore(const std::string& session_folder) : database_(Open(session_folder)) {
  database_->Execute(
      "PRAGMA journal_mode = WAL; CREATE TABLE IF NOT EXISTS answers ("
      "photo INTEGER PRIMARY KEY, "  // Photo.sequence
      "definition TEXT NOT NULL, "   // MD5 of MarkerDetectionArray.msg
      "message BLOB NOT NULL)");     // As it goes over the wire.
}

std::vector<Answer> AnswerStore::Load() {
  std::vector<Answer> answers;
  sqlite::Statement& select =
      database_->Prepared("SELECT message FROM answers WHERE definition = ? ORDER BY photo");
  select.Start(Definition());
  while (select.Step()) {
    try {
      answers.push_back(Deserialize(select.Bytes(0)));
    } catch (const ros::serialization::StreamOverrunException&) {
      throw std::runtime_error(database_->path() +
                               ": an answer is cut short; move the file away, the photos are "
                               "searched again then");
    }
  }
  return answers;
}

void AnswerStore::Save(const Answer& answer) {
  const ros::SerializedMessage message = ros::serialization::serializeMessage(answer);
  // The message's own bytes come after their number.
  const sqlite::Blob bytes = {message.message_start, message.num_bytes - sizeof(std::uint32_t)};
  database_
      ->Prepared("INSERT OR REPLACE INTO answers (photo, definition, message) VALUES (?, ?, ?)")
      .Run(answer.sequence, Definition(), bytes);
}

}  // namespace plumb::ros_adapter
