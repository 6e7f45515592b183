// Memory of one small operation, on the stack as long as it suffices.
#pragma once

#include <algorithm>
#include <array>
#include <cstddef>
#include <functional>
#include <memory>
#include <vector>

namespace holdfast {

/// Hands out pieces of a buffer, and takes none back: what does not fit comes from the heap.
class Scratch {
 public:
  static constexpr std::size_t kBytes = 6144;  // enough for most cavities, and still small on a stack

  Scratch() = default;
  Scratch(const Scratch&) = delete;
  Scratch& operator=(const Scratch&) = delete;

  /// Null where there is no room.
  void* take(std::size_t bytes) {
    constexpr std::size_t kAlign = alignof(std::max_align_t);
    if (bytes > buffer_.size() - used_) return nullptr;
    void* const piece = buffer_.data() + used_;
    used_ += std::min(buffer_.size() - used_, (bytes + kAlign - 1) / kAlign * kAlign);
    return piece;
  }
  [[nodiscard]] bool owns(const void* piece) const {
    return std::less_equal<>()(buffer_.data(), static_cast<const std::byte*>(piece)) &&
           std::less<>()(static_cast<const std::byte*>(piece), buffer_.data() + buffer_.size());
  }

 private:
  alignas(std::max_align_t) std::array<std::byte, kBytes> buffer_;
  std::size_t used_ = 0;
};

template <typename T>
struct ScratchAllocator {
  using value_type = T;

  ScratchAllocator(Scratch& from) : scratch(&from) {}  // NOLINT(google-explicit-constructor): for containers
  template <typename U>
  ScratchAllocator(const ScratchAllocator<U>& other) : scratch(other.scratch) {}  // NOLINT

  T* allocate(std::size_t n) {
    if (void* const piece = n <= Scratch::kBytes / sizeof(T) ? scratch->take(n * sizeof(T)) : nullptr)
      return static_cast<T*>(piece);
    return std::allocator<T>().allocate(n);
  }
  void deallocate(T* piece, std::size_t n) {
    if (!scratch->owns(piece)) std::allocator<T>().deallocate(piece, n);
  }
  friend bool operator==(const ScratchAllocator&, const ScratchAllocator&) = default;

  Scratch* scratch;
};

template <typename T>
using ScratchVector = std::vector<T, ScratchAllocator<T>>;

}  // namespace holdfast
