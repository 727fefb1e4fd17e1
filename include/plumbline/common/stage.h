// SPDX-FileCopyrightText: 2026 The Plumbline authors
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <algorithm>
#include <condition_variable>
#include <cstddef>
#include <deque>
#include <exception>
#include <functional>
#include <mutex>
#include <thread>
#include <utility>

#include "plumbline/common/check.h"

namespace plumb {

// What went through a stage. Once it is closed: accepted = processed + items thrown away
// after a failure, which `dropped` counts as well.
struct StageCounters {
  std::size_t accepted = 0;   // Entered the queue.
  std::size_t dropped = 0;    // Offered or accepted, never processed.
  std::size_t processed = 0;  // The function returned.
  std::size_t queue_depth = 0;
  std::size_t max_queue_depth = 0;
};

// The one threaded wrapper: a thread that takes items from a bounded queue, in order, and
// hands each to a function. When the function throws, the thread stops, what is queued is
// dropped, and Close rethrows. Thread-safe, but for Close and the destructor, which the
// function itself must not call.
template <typename Item>
class Stage {
 public:
  // The queue holds at most `capacity` items beside the one being processed.
  Stage(std::size_t capacity, std::function<void(Item)> process)
      : capacity_(capacity), process_(std::move(process)) {
    PLUMB_CHECK_GT(capacity_, std::size_t{0});
    thread_ = std::thread([this] { Run(); });
  }

  // Processes what is queued; a failure that Close was not asked for is lost.
  ~Stage() { Join(); }

  Stage(const Stage&) = delete;
  Stage& operator=(const Stage&) = delete;

  // Waits while the queue is full. False, and a drop, if the stage is closed or has failed.
  bool Push(Item item) {
    std::unique_lock<std::mutex> lock(mutex_);
    has_room_.wait(lock, [this] { return !IsOpen() || queue_.size() < capacity_; });
    return Offer(std::move(item));
  }

  // Never waits. False, and a drop, if the queue is full, the stage closed or failed.
  bool TryPush(Item item) {
    const std::lock_guard<std::mutex> lock(mutex_);
    return Offer(std::move(item));
  }

  // Takes no more items, processes those queued and ends the thread. Rethrows what the
  // function threw, once. May be called again.
  void Close() {
    Join();
    if (const std::exception_ptr failure = std::exchange(failure_, nullptr)) {
      std::rethrow_exception(failure);
    }
  }

  StageCounters counters() const {
    const std::lock_guard<std::mutex> lock(mutex_);
    StageCounters counters = counters_;
    counters.queue_depth = queue_.size();
    return counters;
  }

 private:
  bool IsOpen() const { return !closed_ && !failed_; }

  bool Offer(Item item) {
    if (!IsOpen() || queue_.size() >= capacity_) {
      ++counters_.dropped;
      return false;
    }
    queue_.push_back(std::move(item));
    ++counters_.accepted;
    counters_.max_queue_depth = std::max(counters_.max_queue_depth, queue_.size());
    has_items_.notify_one();
    return true;
  }

  void Join() {
    {
      const std::lock_guard<std::mutex> lock(mutex_);
      closed_ = true;
    }
    has_items_.notify_all();
    has_room_.notify_all();
    if (thread_.joinable()) thread_.join();
  }

  void Run() {
    std::unique_lock<std::mutex> lock(mutex_);
    while (true) {
      has_items_.wait(lock, [this] { return closed_ || !queue_.empty(); });
      if (queue_.empty()) return;
      Item item = std::move(queue_.front());
      queue_.pop_front();
      has_room_.notify_one();
      lock.unlock();
      std::exception_ptr failure;
      try {
        process_(std::move(item));
      } catch (...) {
        failure = std::current_exception();
      }
      lock.lock();
      if (failure) return Fail(failure);
      ++counters_.processed;
    }
  }

  void Fail(const std::exception_ptr& failure) {
    failed_ = true;
    failure_ = failure;
    counters_.dropped += 1 + queue_.size();
    queue_.clear();
    has_room_.notify_all();
  }

  const std::size_t capacity_;
  const std::function<void(Item)> process_;
  mutable std::mutex mutex_;
  std::condition_variable has_items_;
  std::condition_variable has_room_;
  std::deque<Item> queue_;
  StageCounters counters_;
  bool closed_ = false;
  bool failed_ = false;
  std::exception_ptr failure_;
  std::thread thread_;
};

}  // namespace plumb
