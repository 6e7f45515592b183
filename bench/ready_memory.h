// Prepares memory for programs that are timed. Virtual machines return free memory to their host within
// seconds, and get it back at a few hundred MB/s: the first program to use it would spend most of its time on
// that.
#pragma once

#include <sys/mman.h>
#include <sys/wait.h>
#include <unistd.h>

#include <cstddef>

/// Takes `bytes` from the system, writes to every page and gives them back; in a process of its own and not a
/// child, so that the peak memory that the system tells of this one and its children stays what it is.
inline void ready_memory(std::size_t bytes) {
  int ends[2];
  if (pipe(ends) != 0) return;
  const pid_t child = fork();
  if (child == 0) {
    if (fork() != 0) _exit(0);
    void* const block = mmap(nullptr, bytes, PROT_READ | PROT_WRITE, MAP_PRIVATE | MAP_ANONYMOUS, -1, 0);
    if (block != MAP_FAILED) {
      madvise(block, bytes, MADV_HUGEPAGE);
      for (std::size_t i = 0; i < bytes; i += 4096) static_cast<volatile char*>(block)[i] = 1;
      munmap(block, bytes);
    }
    _exit(0);
  }
  waitpid(child, nullptr, 0);
  close(ends[1]);
  char end = 0;
  [[maybe_unused]] const auto none = read(ends[0], &end, 1);  // returns when the last writer has ended
  close(ends[0]);
}

inline constexpr std::size_t kReadyMemory = std::size_t{2} << 30;
