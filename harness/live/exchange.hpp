// Hands one value back and forth between two threads. Neither ever waits.
#pragma once

#include <atomic>

namespace harness {

/// One thread writes and one reads. The writer gets the value back only when the reader is done with it: so it
/// keeps what it could not hand over, and tells it with the next one.
template <class Value>
class Exchange {
 public:
  /// For the writer: the value to fill, as the reader left it; null while the reader has it.
  Value* to_write() { return is_full_.load(std::memory_order_acquire) ? nullptr : &value_; }
  void publish() { is_full_.store(true, std::memory_order_release); }

  /// For the reader: the value that was published; null if there is none.
  Value* to_read() { return is_full_.load(std::memory_order_acquire) ? &value_ : nullptr; }
  void give_back() { is_full_.store(false, std::memory_order_release); }

 private:
  Value value_;
  std::atomic<bool> is_full_ = false;
};

}  // namespace harness
