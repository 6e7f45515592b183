// The contents of the handles of the C interface.
#pragma once

#include <atomic>
#include <memory>
#include <vector>

#include "holdfast/arrays.h"
#include "holdfast/c.h"
#include "holdfast/holdfast.h"

struct holdfast_cancel {
  holdfast::CancelToken token;
};

/// The arrays are the caller's, converted copies of these, or those of a file.
struct holdfast_surface {
  holdfast::Arrays arrays;
  holdfast::Surface owned;
  bool is_owned = false;
  [[nodiscard]] holdfast::Complex view() const { return is_owned ? owned.view() : arrays.view(); }
};

struct holdfast_volume {
  explicit holdfast_volume(holdfast::Volume&& volume) : mesh(std::move(volume)) {}
  holdfast::Volume mesh;
  std::atomic<std::size_t> owners = 1;
};

struct holdfast_defects {
  std::vector<holdfast::Defect> list;
};

struct VolumeOwner {
  void operator()(holdfast_volume* volume) const { holdfast_volume_free(volume); }
};

/// The volume is separate, so that it may outlive the rest.
struct holdfast_result {
  holdfast::Result rest;
  holdfast_defects defects;
  std::unique_ptr<holdfast_volume, VolumeOwner> volume;
};
