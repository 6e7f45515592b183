// The frame of every function of the C interface: no exception leaves it, and each becomes a status with a
// text.
#pragma once

#include <exception>
#include <new>
#include <stdexcept>
#include <string_view>

#include "holdfast/c.h"
#include "holdfast/io.h"
#include "holdfast/limits.h"

namespace holdfast::c {

/// Copies as much of `text` as fits. Allocates no memory.
template <std::size_t room>
void copy_text(char (&to)[room], std::string_view text) noexcept {
  const std::size_t size = text.copy(to, room - 1);
  to[size] = '\0';
}

inline holdfast_status fail(holdfast_error* error, holdfast_status status,
                            std::string_view message) noexcept {
  if (error != nullptr) copy_text(error->message, message);
  return status;
}

inline holdfast_status status_of(Outcome outcome) noexcept {
  switch (outcome) {
    case Outcome::done:
      return HOLDFAST_OK;
    case Outcome::invalid_input:
      return HOLDFAST_INVALID_INPUT;
    case Outcome::time_limit:
      return HOLDFAST_TIME_LIMIT;
    case Outcome::memory_limit:
      return HOLDFAST_MEMORY_LIMIT;
    case Outcome::cancelled:
      return HOLDFAST_CANCELLED;
    case Outcome::not_representable:
      return HOLDFAST_NOT_REPRESENTABLE;
  }
  return HOLDFAST_INTERNAL_ERROR;
}

/// Runs `work`, which returns a status.
template <class Work>
holdfast_status guarded(holdfast_error* error, Work&& work) noexcept {
  if (error != nullptr) *error = {};
  try {
    return work();
  } catch (const Interrupted& interrupted) {
    return fail(error, status_of(interrupted.outcome()), interrupted.what());
  } catch (const FileError& file) {
    if (error != nullptr) {
      copy_text(error->path, file.path().native());
      copy_text(error->where, file.where());
    }
    return fail(error, HOLDFAST_FILE_ERROR, file.what());
  } catch (const std::invalid_argument& wrong) {
    return fail(error, HOLDFAST_BAD_ARGUMENT, wrong.what());
  } catch (const std::length_error& large) {
    return fail(error, HOLDFAST_TOO_LARGE, large.what());
  } catch (const std::bad_alloc&) {
    return fail(error, HOLDFAST_OUT_OF_MEMORY, "out of memory");
  } catch (const std::exception& other) {
    return fail(error, HOLDFAST_INTERNAL_ERROR, other.what());
  } catch (...) {
    return fail(error, HOLDFAST_INTERNAL_ERROR, "an unknown exception");
  }
}

/// Throws std::invalid_argument if the pointer is null.
inline void require(const void* pointer, const char* what) {
  if (pointer == nullptr) throw std::invalid_argument(what);
}

}  // namespace holdfast::c
