// SPDX-FileCopyrightText: 2026 The Plumbline authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "plumbline/common/atomic_file.h"

#include <fcntl.h>
#include <signal.h>
#include <sys/stat.h>
#include <unistd.h>

#include <cerrno>
#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <filesystem>
#include <stdexcept>
#include <system_error>

namespace plumb {
namespace {

constexpr char kTemporaryPrefix[] = ".plumbline-";

[[noreturn]] void Fail(const std::string& path, const char* what, int error) {
  std::string message = path + ": cannot " + what + ": " + std::strerror(error);
  if (error == ENOSPC || error == EDQUOT) message += "; free some space on this disk";
  if (error == EACCES || error == EPERM || error == EROFS) {
    message += "; make it accessible or choose another folder";
  }
  if (error == ENOTDIR) message += "; what stands before it is a file: choose another folder";
  throw std::runtime_error(message);
}

// A file descriptor that closes itself.
class Descriptor {
 public:
  explicit Descriptor(int value) : value_(value) {}
  ~Descriptor() {
    if (value_ >= 0) ::close(value_);
  }
  Descriptor(const Descriptor&) = delete;
  Descriptor& operator=(const Descriptor&) = delete;
  int value() const { return value_; }

 private:
  int value_;
};

// The temporary file: gone at the end unless it was renamed.
class TemporaryFile {
 public:
  explicit TemporaryFile(std::string path)
      : path_(std::move(path)),
        descriptor_(::open(path_.c_str(), O_WRONLY | O_CREAT | O_TRUNC | O_CLOEXEC, 0666)) {}
  ~TemporaryFile() {
    if (!renamed_ && descriptor_.value() >= 0) ::unlink(path_.c_str());
  }
  int descriptor() const { return descriptor_.value(); }

  bool RenameTo(const std::string& path) {
    renamed_ = ::rename(path_.c_str(), path.c_str()) == 0;
    return renamed_;
  }

 private:
  std::string path_;
  Descriptor descriptor_;
  bool renamed_ = false;
};

void WriteAll(int descriptor, const void* data, std::size_t size, const std::string& path) {
  const char* rest = static_cast<const char*>(data);
  while (size > 0) {
    const ssize_t written = ::write(descriptor, rest, size);
    if (written < 0 && errno == EINTR) continue;
    if (written < 0) Fail(path, "write", errno);
    rest += written;
    size -= static_cast<std::size_t>(written);
  }
}

std::filesystem::path FolderOf(const std::filesystem::path& target) {
  return target.has_parent_path() ? target.parent_path() : ".";
}

[[noreturn]] void FailToCreate(const std::string& path, int error) {
  if (error != ENOENT) Fail(path, "create", error);
  throw std::runtime_error(path + ": cannot create: there is no folder " + FolderOf(path).string() +
                           "; make it or choose another");
}

}  // namespace

void RequireWritable(const std::string& path) {
  std::error_code error;
  if (std::filesystem::is_directory(path, error)) {
    throw std::runtime_error(path + ": is a folder; name a file in it");
  }
  if (::access((FolderOf(path) / ".").c_str(), W_OK) != 0) FailToCreate(path, errno);
}

void WriteFileAtomically(const std::string& path, const void* data, std::size_t size) {
  const std::filesystem::path target(path);
  const std::filesystem::path folder = FolderOf(target);
  const std::string temporary_name =
      kTemporaryPrefix + std::to_string(::getpid()) + '-' + target.filename().string();
  TemporaryFile temporary((folder / temporary_name).string());
  if (temporary.descriptor() < 0) FailToCreate(path, errno);
  WriteAll(temporary.descriptor(), data, size, path);
  if (::fsync(temporary.descriptor()) != 0) Fail(path, "write", errno);
  if (!temporary.RenameTo(path)) Fail(path, "rename to", errno);
  const Descriptor directory(::open(folder.c_str(), O_RDONLY | O_DIRECTORY | O_CLOEXEC));
  // Some file systems know no fsync of a folder; the file itself is safe by then.
  if (directory.value() >= 0) ::fsync(directory.value());
}

void WriteFileAtomically(const std::string& path, const std::string& text) {
  WriteFileAtomically(path, text.data(), text.size());
}

std::vector<std::uint8_t> ReadFileBytes(const std::string& path) {
  const Descriptor descriptor(::open(path.c_str(), O_RDONLY | O_CLOEXEC));
  if (descriptor.value() < 0) Fail(path, "open", errno);
  struct stat status = {};
  if (::fstat(descriptor.value(), &status) != 0) Fail(path, "read", errno);
  if (S_ISDIR(status.st_mode)) Fail(path, "read", EISDIR);
  std::vector<std::uint8_t> bytes(static_cast<std::size_t>(status.st_size) + 1);
  std::size_t size = 0;
  while (true) {
    if (size == bytes.size()) bytes.resize(2 * size);  // It grew while it was read.
    const ssize_t count = ::read(descriptor.value(), bytes.data() + size, bytes.size() - size);
    if (count < 0 && errno == EINTR) continue;
    if (count < 0) Fail(path, "read", errno);
    if (count == 0) break;
    size += static_cast<std::size_t>(count);
  }
  bytes.resize(size);
  return bytes;
}

bool IsTemporaryFileName(const std::string& name) { return name.rfind(kTemporaryPrefix, 0) == 0; }

bool IsAbandonedFileName(const std::string& name) {
  if (!IsTemporaryFileName(name)) return false;
  const long process = std::strtol(name.c_str() + sizeof(kTemporaryPrefix) - 1, nullptr, 10);
  return process <= 0 || (::kill(static_cast<pid_t>(process), 0) != 0 && errno == ESRCH);
}

}  // namespace plumb
