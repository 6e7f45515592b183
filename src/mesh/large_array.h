// An array of plain data for millions of entries: not initialised, aligned to cache lines, on huge pages
// where the system has them (a third of the time of a naive array is page faults and misses of the
// address cache), and growing without holding two whole copies.
#pragma once

#include <algorithm>
#include <cstddef>
#include <cstring>
#include <type_traits>
#include <utility>
#include <vector>

namespace holdfast {

/// Memory aligned to cache lines, and to huge pages where it is large.
[[nodiscard]] void* allocate_large(std::size_t bytes);
void free_large(void* block, std::size_t bytes);
/// Asks the system to back a large block by huge pages; a hint, without effect elsewhere.
void advise_huge_pages(void* block, std::size_t bytes);
/// Asks the system for the memory of a block at once, which several threads may do for parts of it; a hint.
void populate(void* block, std::size_t bytes);
/// Gives the memory of whole pages back before the block itself is freed; they must not be read again.
void give_back(void* block, std::size_t bytes);

template <class T>
class LargeArray {
  static_assert(std::is_trivially_copyable_v<T> && alignof(T) <= 64);

 public:
  LargeArray() = default;
  explicit LargeArray(std::size_t size) { resize(size); }
  LargeArray(const LargeArray&) = delete;
  LargeArray& operator=(const LargeArray&) = delete;
  ~LargeArray() { clear(); }

  [[nodiscard]] std::size_t size() const { return size_; }
  [[nodiscard]] std::size_t capacity() const { return capacity_; }
  [[nodiscard]] T* data() { return data_; }
  [[nodiscard]] const T* data() const { return data_; }
  T& operator[](std::size_t i) { return data_[i]; }
  const T& operator[](std::size_t i) const { return data_[i]; }
  [[nodiscard]] const T* begin() const { return data_; }
  [[nodiscard]] const T* end() const { return data_ + size_; }

  /// New entries are not initialised. Memory is taken from the system only when entries come to use it.
  void resize(std::size_t size) {
    reserve(size);
    size_ = size;
  }

  void reserve(std::size_t capacity) {
    if (capacity <= capacity_) return;
    T* fresh = static_cast<T*>(allocate_large(capacity * sizeof(T)));
    // Block by block, each given back once copied.
    constexpr std::size_t kBlock = (std::size_t{1} << 21) / sizeof(T);
    for (std::size_t first = 0; first < size_; first += kBlock) {
      const std::size_t count = std::min(kBlock, size_ - first);
      std::memcpy(static_cast<void*>(fresh + first), data_ + first, count * sizeof(T));
      if (count == kBlock) give_back(data_ + first, count * sizeof(T));
    }
    if (data_ != nullptr) free_large(data_, capacity_ * sizeof(T));
    data_ = fresh;
    capacity_ = capacity;
  }

  void clear() {
    if (data_ != nullptr) free_large(data_, capacity_ * sizeof(T));
    data_ = nullptr;
    size_ = capacity_ = 0;
  }

 private:
  T* data_ = nullptr;
  std::size_t size_ = 0;
  std::size_t capacity_ = 0;
};

/// The same memory for a standard container.
template <class T>
struct LargeAllocator {
  using value_type = T;

  LargeAllocator() = default;
  template <class U>
  LargeAllocator(const LargeAllocator<U>&) {}  // NOLINT(google-explicit-constructor): as the standard asks
  [[nodiscard]] T* allocate(std::size_t count) { return static_cast<T*>(allocate_large(count * sizeof(T))); }
  void deallocate(T* block, std::size_t count) { free_large(block, count * sizeof(T)); }
  friend bool operator==(const LargeAllocator&, const LargeAllocator&) { return true; }
};

template <class T>
using LargeVector = std::vector<T, LargeAllocator<T>>;

}  // namespace holdfast
